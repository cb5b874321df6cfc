#!/usr/bin/env python3
"""Makes tests/data/motions/*.bvh: the same short motion for the skeletons of several families.

usage: tests/animation/make_motions.py

The names are those of the families; offsets and motion are made up here. Figures are given facing +z, y up, in
metres; each family has its own unit, axes, rest pose and order of channels. What every bone points to is set for
each frame, so that all files show the same: the left arm goes up at the side, the right one forwards, the left leg
steps, the trunk leans.
"""
import math
import os

FRAMES, FRAME_TIME = 9, 0.1


def add(a, b): return tuple(x + y for x, y in zip(a, b))
def scale(a, s): return tuple(x * s for x in a)
def sub(a, b): return add(a, scale(b, -1))
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
def unit(a): return scale(a, 1 / math.sqrt(dot(a, a)))
def apply(m, v): return tuple(dot(row, v) for row in m)
def mul(a, b): return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)) for i in range(3))
def transposed(m): return tuple(zip(*m))
IDENTITY = ((1, 0, 0), (0, 1, 0), (0, 0, 1))


def about(axis, degrees):
    a = math.radians(degrees)
    x, y, z = unit(axis)
    c, s, t = math.cos(a), math.sin(a), 1 - math.cos(a)
    return ((t * x * x + c, t * x * y - s * z, t * x * z + s * y), (t * x * y + s * z, t * y * y + c, t * y * z - s * x),
            (t * x * z - s * y, t * y * z + s * x, t * z * z + c))


def between(a, b):
    """The shortest rotation from the direction a to b."""
    a, b = unit(a), unit(b)
    axis = cross(a, b)
    if dot(axis, axis) < 1e-12:
        return IDENTITY if dot(a, b) > 0 else about((0, 0, 1), 180)
    return about(axis, math.degrees(math.atan2(math.sqrt(dot(axis, axis)), dot(a, b))))


def angles(m, order):
    """Degrees of the rotations about the axes in this order, outermost first."""
    x, y, z = "XYZ".index(order[0]), "XYZ".index(order[1]), "XYZ".index(order[2])
    even = (y - x) % 3 == 1
    s = 1 if even else -1
    middle = math.asin(max(-1, min(1, s * m[x][z])))
    first = math.atan2(-s * m[y][z], m[z][z])
    last = math.atan2(-s * m[x][y], m[x][x])
    return [math.degrees(v) for v in (first, middle, last)]


# The rest pose: where bones point, by role. T: arms level; A: half way down.
def rest_directions(pose):
    arm = 0 if pose == "T" else -45
    left = (math.cos(math.radians(arm)), math.sin(math.radians(arm)), 0)
    right = (-left[0], left[1], 0)
    return {"spine": (0, 1, 0), "left_arm": left, "right_arm": right, "left_leg": (0, -1, 0), "right_leg": (0, -1, 0),
            "left_side": (1, 0, 0), "right_side": (-1, 0, 0), "toe": (0, 0, 1)}


# What moves, 0 <= t <= 1, in the frame of a figure that faces +z.
def turned(direction, t, part):
    lean = about((1, 0, 0), 12 * t)
    if part == "left_upper_arm": return about((0, 0, 1), -70 + 130 * t), (1, 0, 0)
    if part == "left_forearm": return about((0, 0, 1), -70 + 150 * t), (1, 0, 0)
    if part == "right_upper_arm": return about((1, 0, 0), -60 * t), (-0.2, -1, 0)
    if part == "right_forearm": return about((1, 0, 0), -100 * t), (-0.2, -1, 0)
    if part == "left_thigh": return about((1, 0, 0), -50 * t), (0, -1, 0)
    if part == "left_shin": return about((1, 0, 0), 10 * t), (0, -1, 0)
    if part in ("right_thigh", "right_shin"): return IDENTITY, (0, -1, 0)
    return lean, direction


class Family:
    def __init__(self, name, joints, unit_m=0.01, pose="T", order="ZXY", axes=IDENTITY, facing=0.0):
        self.name, self.joints, self.unit_m, self.order = name, joints, unit_m, order
        self.axes, self.facing, self.rest = axes, facing, rest_directions(pose)

    def write(self, folder):
        children = {}
        for i, joint in enumerate(self.joints):
            children.setdefault(joint[1], []).append(i)
        index = {joint[0]: i for i, joint in enumerate(self.joints)}
        # The file's axes of the figure's: first turned about the vertical, then as the program has them.
        world = mul(self.axes, about((0, 1, 0), self.facing))
        text, order = ["HIERARCHY"], []

        def offset(direction, length):
            return scale(apply(self.axes, unit(self.rest.get(direction, direction))), length / self.unit_m)

        def line(depth, words):
            text.append("\t" * depth + words)

        def numbers(values):
            return " ".join("%.6g" % (v if abs(v) > 1e-9 else 0) for v in values)

        def hierarchy(i, depth):
            name, parent, direction, length, part = self.joints[i]
            order.append(i)
            line(depth, ("ROOT " if parent is None else "JOINT ") + name)
            line(depth, "{")
            line(depth + 1, "OFFSET " + (numbers((0, 0, 0)) if parent is None else numbers(offset(direction, length))))
            rotations = " ".join(axis + "rotation" for axis in self.order)
            line(depth + 1, "CHANNELS 6 Xposition Yposition Zposition " + rotations if parent is None
                 else "CHANNELS 3 " + rotations)
            for child in children.get(name, []):
                hierarchy(child, depth + 1)
            if name not in children:
                line(depth + 1, "End Site")
                line(depth + 1, "{")
                tip = "toe" if "leg" in str(direction) or direction == "toe" else direction
                line(depth + 2, "OFFSET " + numbers(offset(tip, 0.08)))
                line(depth + 1, "}")
            line(depth, "}")

        hierarchy(0, 0)
        text += ["MOTION", "Frames: %d" % FRAMES, "Frame Time: %g" % FRAME_TIME]
        for frame in range(FRAMES):
            t = frame / (FRAMES - 1)
            # Global rotations in the figure's frame.
            globals_ = {}
            row = []
            for i in order:
                name, parent, direction, length, part = self.joints[i]
                if part is None:
                    now = globals_.get(parent, about((1, 0, 0), 12 * t))
                else:
                    # The bone leads to the first child on the limb.
                    below = next((c for c in children.get(name, []) if self.joints[c][2] != "toe"), None)
                    bone = self.joints[below][2] if below is not None else direction
                    bone = self.rest.get(bone, bone)
                    rotation, of = turned(bone, t, part)
                    now = between(bone, apply(rotation, of))
                globals_[name] = now
                above = globals_[parent] if parent is not None else transposed(
                    mul(transposed(self.axes), world))
                # In the file's axes: axes · local · axes⁻¹.
                local = mul(transposed(above), now)
                if parent is None:
                    row += scale(apply(world, (0.02 * t, 0.95, 0.3 * t)), 1 / self.unit_m)
                row += angles(mul(mul(self.axes, local), transposed(self.axes)), self.order)
            text.append(numbers(row))
        with open(os.path.join(folder, self.name + ".bvh"), "w") as file:
            file.write("\n".join(text) + "\n")


# name, parent, direction of the offset in the rest pose, its length, what turns it.
def figure(hips, spine, neck, head, collar, arm, leg, toe, hip_joint=None):
    joints = [(hips, None, "spine", 0, None)]
    above = hips
    for name in spine:
        joints.append((name, above, "spine", 0.42 / len(spine), None))
        above = name
    chest = above
    for i, name in enumerate(neck + [head]):
        joints.append((name, above, "spine", 0.12, None))
        above = name
    for side in ("left", "right"):
        above = chest
        if collar:
            joints.append((collar[side], chest, side + "_side", 0.06, None))
            above = collar[side]
        for k, (name, length, part) in enumerate(zip(arm[side], (0.13, 0.28, 0.25), ("_upper_arm", "_forearm", None))):
            joints.append((name, above, side + ("_side" if k == 0 else "_arm"), length, side + part if part else None))
            above = name
    for side in ("left", "right"):
        above = hips
        if hip_joint:
            joints.append((hip_joint[side], hips, side + "_side", 0.02, None))
            above = hip_joint[side]
        for k, (name, length, part) in enumerate(zip(leg[side], (0.09, 0.42, 0.4), ("_thigh", "_shin", None))):
            joints.append((name, above, side + ("_side" if k == 0 else "_leg"), length, side + part if part else None))
            above = name
        if toe:
            joints.append((toe[side], above, "toe", 0.12, None))
    return joints


def both(*patterns, left="Left", right="Right"):
    return {"left": [p.replace("@", left) for p in patterns], "right": [p.replace("@", right) for p in patterns]}


def one(pattern, left="Left", right="Right"):
    return {"left": pattern.replace("@", left), "right": pattern.replace("@", right)}


Z_UP = ((1, 0, 0), (0, 0, -1), (0, 1, 0))  # faces -y
MIXAMO = figure("Hips", ["Spine", "Spine1", "Spine2"], ["Neck"], "Head", one("@Shoulder"), both("@Arm", "@ForeArm", "@Hand"),
                both("@UpLeg", "@Leg", "@Foot"), one("@ToeBase"))
PREFIXED = [tuple("mixamorig:" + v if k < 2 and v else v for k, v in enumerate(joint)) for joint in MIXAMO]
NAMELESS = figure("b0", ["b1", "b2"], ["b3"], "b4", one("c@"), both("d@", "e@", "f@"), both("g@", "h@", "i@"), one("k@"))
FAMILIES = [
    Family("cmu", figure("Hips", ["LowerBack", "Spine", "Spine1"], ["Neck", "Neck1"], "Head", one("@Shoulder"),
                         both("@Arm", "@ForeArm", "@Hand"), both("@UpLeg", "@Leg", "@Foot"), one("@ToeBase"),
                         {"left": "LHipJoint", "right": "RHipJoint"}), unit_m=0.0564),
    Family("mixamo", MIXAMO, facing=90),
    Family("mixamo_prefixed", PREFIXED, order="XYZ"),
    Family("rokoko", figure("Hips", ["Spine1", "Spine2", "Spine3", "Spine4"], ["Neck"], "Head", one("@Shoulder"),
                            both("@Arm", "@ForeArm", "@Hand"), both("@Thigh", "@Shin", "@Foot"), one("@Toe")), order="YXZ"),
    Family("rigify", figure("spine", ["spine.001", "spine.002", "spine.003"], ["spine.004", "spine.005"], "spine.006",
                            one("shoulder.@", "L", "R"), both("upper_arm.@", "forearm.@", "hand.@", left="L", right="R"),
                            both("thigh.@", "shin.@", "foot.@", left="L", right="R"), one("toe.@", "L", "R")),
           unit_m=1, pose="A", axes=Z_UP, order="XYZ"),
    Family("vrm", figure("hips", ["spine", "chest", "upperChest"], ["neck"], "head", one("@Shoulder", "left", "right"),
                         both("@UpperArm", "@LowerArm", "@Hand", left="left", right="right"),
                         both("@UpperLeg", "@LowerLeg", "@Foot", left="left", right="right"), one("@Toes", "left", "right")),
           unit_m=1, facing=180),
    Family("animated_drawings", figure("root", ["torso"], ["neck"], "head", None,
                                       both("@_shoulder", "@_elbow", "@_hand", left="left", right="right"),
                                       both("@_hip", "@_knee", "@_foot", left="left", right="right"), None), pose="A"),
    Family("nameless", NAMELESS, axes=Z_UP, unit_m=1, facing=30),
]

if __name__ == "__main__":
    folder = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "data", "motions")
    os.makedirs(folder, exist_ok=True)
    for family in FAMILIES:
        family.write(folder)
