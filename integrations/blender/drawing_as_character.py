# Blender add-on: File > Import > Drawing as character. Edit > Preferences > Add-ons > Install takes this file.
import builtins
import os
import shutil
import subprocess
import tempfile

import bpy
import numpy
from bpy.props import BoolProperty, CollectionProperty, EnumProperty, FloatProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

bl_info = {
    "name": "Drawing as character (skel)",
    "description": "Rigs a drawing of a character by skel-infer and imports it with its clips",
    "author": "skel",
    "version": (1, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Import > Drawing as character",
    "category": "Import-Export",
}


class SkelPreferences(bpy.types.AddonPreferences):
    bl_idname = __name__

    program: StringProperty(name="skel-infer", subtype="FILE_PATH", default="skel-infer",
                            description="The program; a name alone is looked for in PATH")

    def draw(self, _context):
        self.layout.prop(self, "program")


class ToolError(Exception):
    """With the sentence that a user reads."""


def rig(program, drawing, folder, options):
    """Writes a GLB of the drawing into the folder; its path, and the notes about it."""
    found = shutil.which(bpy.path.abspath(program) if os.path.dirname(program) else program)
    if not found:
        raise ToolError(f"{program} was not found; install skel, or name skel-infer in the add-on's preferences")
    command = [found, drawing, "-o", folder, "--formats", "glb", "--bones", "ends", *options]
    done = subprocess.run(command, capture_output=True, text=True, errors="replace", stdin=subprocess.DEVNULL)
    lines = [line for line in done.stderr.splitlines() if line]
    stem = os.path.splitext(os.path.basename(drawing))[0]
    if done.returncode != 0:
        raise ToolError(lines[-1] if lines else f"{found} ended with code {done.returncode}")
    return os.path.join(folder, stem + ".glb"), [line for line in lines if ": note: " in line]


def import_glb(path):
    """The armature that was imported."""
    # Debian's Blender 3.4 comes with a numpy that has dropped names which its importer uses.
    for name in ("bool", "int", "float", "object"):
        if name not in numpy.__dict__:
            setattr(numpy, name, getattr(builtins, name))
    bpy.ops.import_scene.gltf(filepath=path)
    return next(o for o in bpy.context.selected_objects if o.type == "ARMATURE")


def remove_bone_ends(armature):
    """They have told the last bones how long they are; nothing is bound to them."""
    bpy.context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    bones = armature.data.edit_bones
    ends = [bone for bone in bones if bone.get("end")]
    names = [bone.name for bone in ends]
    for bone in ends:
        bones.remove(bone)
    bpy.ops.object.mode_set(mode="OBJECT")
    for mesh in (child for child in armature.children if child.type == "MESH"):
        for group in [mesh.vertex_groups[name] for name in names if name in mesh.vertex_groups]:
            mesh.vertex_groups.remove(group)


def show(armature, scene):
    """Bones before the body; all clips stay in the file, as muted tracks and actions; the idle one plays."""
    armature.show_in_front = True
    if not armature.animation_data:
        return
    actions = {track.name: track.strips[0].action for track in armature.animation_data.nla_tracks}
    for action in actions.values():
        action.use_fake_user = True
    chosen = actions.get("idle") or armature.animation_data.action
    armature.animation_data.action = chosen
    scene.frame_start, scene.frame_end = (round(frame) for frame in chosen.frame_range)
    scene.frame_set(scene.frame_start)


class ImportDrawing(bpy.types.Operator, ImportHelper):
    """Rig drawings of characters and import them with their clips"""
    bl_idname = "import_scene.drawing_as_character"
    bl_label = "Import drawing as character"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".png"
    filter_glob: StringProperty(default="*.png;*.jpg;*.jpeg", options={"HIDDEN"})
    files: CollectionProperty(type=bpy.types.OperatorFileListElement, options={"HIDDEN", "SKIP_SAVE"})
    body_plan: EnumProperty(name="Body plan", items=[
        ("auto", "What it fits", "A person or an animal, as it looks"),
        ("biped", "Person", "Goes on two legs"),
        ("quadruped", "Animal", "Goes on four feet, drawn from the side")])
    rest_pose: EnumProperty(name="Rest pose", items=[
        ("drawn", "As drawn", "The pose of the drawing"),
        ("A", "A", "Arms down to the sides"),
        ("T", "T", "Arms out to the sides")])
    height: FloatProperty(name="Height", description="0: 1.7 m, or 1.2 m from end to end of an animal",
                          min=0, max=1000, default=0, subtype="DISTANCE")
    clips: BoolProperty(name="Clips", description="Walk, run, wave and more, as actions", default=True)

    def execute(self, context):
        program = context.preferences.addons[__name__].preferences.program
        options = ["--template", self.body_plan, "--rest-pose", self.rest_pose, "--height", str(self.height)]
        if not self.clips:
            options += ["--clips", "none"]
        folder = os.path.dirname(self.filepath)
        drawings = [os.path.join(folder, file.name) for file in self.files if file.name] or [self.filepath]
        imported, right = [], 0.0
        for drawing in drawings:
            try:
                with tempfile.TemporaryDirectory() as results:
                    glb, notes = rig(program, bpy.path.abspath(drawing), results, options)
                    armature = import_glb(glb)
            except ToolError as error:
                self.report({"ERROR"}, str(error))
                continue
            for note in notes:
                self.report({"WARNING"}, note)
            remove_bone_ends(armature)
            show(armature, context.scene)
            # Several stand side by side.
            width = max(child.dimensions.x for child in armature.children)
            armature.location.x = right + width / 2 if imported else 0
            right = armature.location.x + width / 2
            imported.append(armature)
        for armature in imported:
            armature.select_set(True)
        return {"FINISHED"} if imported else {"CANCELLED"}


def menu_entry(menu, _context):
    menu.layout.operator(ImportDrawing.bl_idname, text="Drawing as character (.png .jpg)")


def register():
    bpy.utils.register_class(SkelPreferences)
    bpy.utils.register_class(ImportDrawing)
    bpy.types.TOPBAR_MT_file_import.append(menu_entry)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(menu_entry)
    bpy.utils.unregister_class(ImportDrawing)
    bpy.utils.unregister_class(SkelPreferences)
