# blender -b -P look.py -- FILE [ADD-ON SKEL-INFER] [PICTURE ANGLE]: opens a GLB by Blender's own importer, a drawing by the
# add-on, says what is there, and fails if bones, skin, clips or ground are not as they should be.
import argparse
import builtins
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile

import bpy
import numpy
from mathutils import Matrix, Vector


def fail(problem):
    sys.exit(f"check-in-blender: {problem}")


def open_glb(path):
    # Blender 3.4's importer uses names that later versions of numpy dropped.
    for name in ("bool", "int", "float", "object"):
        if name not in numpy.__dict__:
            setattr(numpy, name, getattr(builtins, name))
    bpy.ops.import_scene.gltf(filepath=path)


def refusal(path):
    try:
        bpy.ops.import_scene.drawing_as_character(filepath=path)
    except RuntimeError as error:
        return str(error).strip().removeprefix("Error: ")
    fail(f"{path} was imported")


def check_mended(path, program):
    """A joint that a person has moved, beside the drawing or in out/ beside it, comes along."""
    for below in ("", "out"):
        with tempfile.TemporaryDirectory() as folder:
            drawing = shutil.copy(path, folder)
            results = os.path.join(folder, below)
            subprocess.run([program, drawing, "-o", results, "--formats", "json"], check=True, capture_output=True)
            stem = os.path.splitext(os.path.basename(path))[0]
            skeleton = os.path.join(results, stem + ".skeleton.json")
            with open(skeleton) as file:
                content = json.load(file)
            content["joints"][-1]["image"][0] += 5
            with open(skeleton, "w") as file:
                json.dump(content, file)
            said = mended_notes(drawing)
            if f"1 joint ({skeleton})" not in said:
                fail(f"a joint that was moved in {skeleton} is not taken up: {said}")
    print("mended: joints beside the drawing and in out/ beside it come along")


def mended_notes(path):
    """What the add-on warns of when it imports the drawing."""
    add_on = sys.modules["drawing_as_character"]
    with tempfile.TemporaryDirectory() as results:
        _, notes = add_on.rig(bpy.context.preferences.addons["drawing_as_character"].preferences.program, path, results, [])
    return "\n".join(notes)


def open_drawing(path, add_on, program):
    bpy.ops.preferences.addon_install(filepath=add_on)
    module = os.path.splitext(os.path.basename(add_on))[0]
    bpy.ops.preferences.addon_enable(module=module)
    preferences = bpy.context.preferences.addons[module].preferences
    preferences.program = "skel-nowhere"
    if "skel-nowhere was not found; install skel" not in refusal(path):
        fail("the add-on does not say that the program is missing")
    preferences.program = program
    with tempfile.NamedTemporaryFile(suffix=".png") as broken:
        broken.write(b"no picture")
        broken.flush()
        said = refusal(broken.name)
    if not said.startswith("skel-infer: ") or "\n" in said:
        fail(f"the add-on does not say what the tool says: {said}")
    print("add-on: says what the tool says of a missing program and of a file that is no picture")
    check_mended(path, program)
    if bpy.ops.import_scene.drawing_as_character(filepath=path) != {"FINISHED"}:
        fail("the add-on imported nothing")


def check_bones(armature, mesh):
    bones = armature.data.bones
    print("bones:", ", ".join(bone.name for bone in bones))
    angles = [math.degrees((bone.tail_local - bone.head_local).angle(bone.children[0].head_local - bone.head_local))
              for bone in bones
              if len(bone.children) == 1 and (bone.children[0].head_local - bone.head_local).length > 1e-4]
    ground = min((mesh.matrix_world @ vertex.co).z for vertex in mesh.data.vertices)
    lowest = min((armature.matrix_world @ bone.tail_local).z for bone in bones) - ground
    print(f"bone directions: at most {max(angles, default=0):.1f} degrees past the child, "
          f"the lowest bone ends {lowest:.3f} m above the ground")
    if max(angles, default=0) > 5 or lowest < -0.01:
        fail("bones do not lie along the limbs, or end in the ground")
    return ground


def check_last_bones(armature, mesh):
    """Each ends where what it moves ends."""
    height = mesh.dimensions.z
    off = {}
    for bone in (bone for bone in armature.data.bones if not bone.children):
        group = mesh.vertex_groups[bone.name].index
        direction = (bone.tail_local - bone.head_local).normalized()
        reach = max((direction.dot(vertex.co - bone.head_local) for vertex in mesh.data.vertices
                     if any(g.group == group and g.weight > .5 for g in vertex.groups)), default=0)
        if reach > .02 * height:
            off[bone.name] = abs(bone.length - reach) / height
    print("last bones: " + ", ".join(f"{name} {100 * share:.1f} %" for name, share in off.items()) + " of the height off the end")
    if not off or max(off.values()) > .03:
        fail("the last bones do not end where toes, fingertips and heads do")


def check_clips(armature):
    tracks = armature.animation_data.nla_tracks
    names = {track.name for track in tracks}
    if not {"idle", "walk"} <= names or any(not track.mute for track in tracks):
        fail(f"the clips are {sorted(names)}, all of them as muted tracks expected")
    if any(not track.strips[0].action.use_fake_user for track in tracks):
        fail("an action would be lost when the file is saved")
    if armature.animation_data.action != tracks["idle"].strips[0].action:
        fail("idle is not what plays")


def posed_vertices(mesh):
    evaluated = mesh.evaluated_get(bpy.context.evaluated_depsgraph_get())
    return [evaluated.matrix_world @ vertex.co for vertex in evaluated.data.vertices]


def add_bones_picture(armature, mesh):
    """Octahedra where the bones are, in a body that lets them shine through: no screen is needed to draw them."""
    color = bpy.data.materials.new("bone")
    color.use_nodes = True
    nodes = color.node_tree.nodes
    nodes.clear()
    glow = nodes.new("ShaderNodeEmission")
    glow.inputs["Color"].default_value = (.02, .08, .6, 1)
    color.node_tree.links.new(glow.outputs[0], nodes.new("ShaderNodeOutputMaterial").inputs[0])
    for bone in armature.pose.bones:
        thick, x, z = bone.length / 9, bone.x_axis, bone.z_axis
        ring = bone.head + .12 * (bone.tail - bone.head)
        corners = [bone.head, *(ring + thick * side for side in (x, z, -x, -z)), bone.tail]
        faces = [(end, 1 + k, 1 + (k + 1) % 4) for end in (0, 5) for k in range(4)]
        shape = bpy.data.meshes.new(bone.name)
        shape.from_pydata([armature.matrix_world @ corner for corner in corners], [], faces)
        shape.materials.append(color)
        bpy.context.scene.collection.objects.link(bpy.data.objects.new(bone.name, shape))
    for slot in mesh.material_slots:
        tree = slot.material.node_tree
        output = next(node for node in tree.nodes if node.type == "OUTPUT_MATERIAL")
        mix = tree.nodes.new("ShaderNodeMixShader")
        mix.inputs[0].default_value = .65
        tree.links.new(output.inputs[0].links[0].from_socket, mix.inputs[1])
        tree.links.new(tree.nodes.new("ShaderNodeBsdfTransparent").outputs[0], mix.inputs[2])
        tree.links.new(mix.outputs[0], output.inputs[0])


def render(mesh, path, degrees):
    scene = bpy.context.scene
    corners = [mesh.matrix_world @ Vector(corner) for corner in mesh.bound_box]
    middle = sum(corners, Vector()) / 8
    size = max(max(c[k] for c in corners) - min(c[k] for c in corners) for k in range(3))
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = 1.25 * size
    angle = math.radians(degrees)
    # Blender's front looks along -y.
    camera.location = middle + 4 * size * Vector((math.sin(angle), -math.cos(angle), 0))
    camera.rotation_euler = (math.pi / 2, 0, angle)
    scene.collection.objects.link(camera)
    scene.camera = camera
    sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
    sun.data.energy = 3
    sun.rotation_euler = (math.radians(60), 0, math.radians(-20))
    scene.collection.objects.link(sun)
    scene.world = bpy.data.worlds.new("world")
    scene.world.color = (0.6, 0.6, 0.6)
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 16
    scene.cycles.use_denoising = False  # Debian builds without it
    scene.render.resolution_x = scene.render.resolution_y = 512
    scene.render.filepath = path
    bpy.ops.render.render(write_still=True)


parser = argparse.ArgumentParser()
parser.add_argument("file")
parser.add_argument("--add-on")
parser.add_argument("--program")
parser.add_argument("--picture")
parser.add_argument("--angle", type=float, default=0)
parser.add_argument("--bones", action="store_true")
arguments = parser.parse_args(sys.argv[sys.argv.index("--") + 1:])

bpy.ops.wm.read_factory_settings(use_empty=True)
if arguments.add_on:
    open_drawing(arguments.file, arguments.add_on, arguments.program)
else:
    open_glb(arguments.file)
scene = bpy.context.scene
armatures = [o for o in scene.objects if o.type == "ARMATURE"]
meshes = [o for o in scene.objects if o.type == "MESH" and o.find_armature()]
if len(armatures) != 1 or len(meshes) != 1:
    fail(f"{len(armatures)} armatures and {len(meshes)} skinned meshes, one each expected")
armature, mesh = armatures[0], meshes[0]
ground = check_bones(armature, mesh)
if arguments.add_on:
    print(f"ground: the lowest vertex is at {ground:.4f} m")
    if abs(ground) > 1e-3:
        fail("the character does not stand on the ground")
    check_last_bones(armature, mesh)
    check_clips(armature)
print("vertex groups:", len(mesh.vertex_groups))
if len(mesh.vertex_groups) != len(armature.data.bones):
    fail("there are vertex groups without bones, or the other way round")
sums = [sum(group.weight for group in vertex.groups) for vertex in mesh.data.vertices]
print(f"vertices: {len(sums)}, sums of weights {min(sums):.5f} to {max(sums):.5f}")
if abs(min(sums) - 1) > 1e-3 or abs(max(sums) - 1) > 1e-3:
    fail("weights do not sum to 1")
for action in bpy.data.actions:
    print(f"action: {action.name}, frames {action.frame_range[0]:.0f} to {action.frame_range[1]:.0f}")
for image in bpy.data.images:
    print(f"texture: {image.name}, {image.size[0]}x{image.size[1]}")

if bpy.data.actions:
    playing = armature.animation_data.action
    first, last = playing.frame_range
    scene.frame_set(round(first))
    before = posed_vertices(mesh)
    scene.frame_set(round(.7 * first + .3 * last))
    moved = max((a - b).length for a, b in zip(before, posed_vertices(mesh)))
    scene.frame_set(round((first + last) / 2))
    print(f"motion: {playing.name} moves vertices by up to {moved:.3f} m")
    if moved < 1e-3:
        fail("nothing moves")
if arguments.picture:
    if arguments.bones:
        add_bones_picture(armature, mesh)
    render(mesh, arguments.picture, arguments.angle)
