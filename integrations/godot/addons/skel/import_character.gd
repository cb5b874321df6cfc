# Import > Import As > Character (skel), for a drawing or a GLB.
tool
extends EditorImportPlugin

const Character = preload("character.gd")
var settings: EditorSettings

func get_importer_name(): return "skel.character"
func get_visible_name(): return "Character (skel)"
func get_recognized_extensions(): return ["glb", "png", "jpg", "jpeg"]
func get_save_extension(): return "scn"
func get_resource_type(): return "PackedScene"
func get_priority(): return 0.5  # pictures stay textures unless they are told otherwise
func get_import_order(): return 100  # as scenes: after textures
func get_preset_count(): return 1
func get_preset_name(_preset): return "Default"
func get_option_visibility(_option, _options): return true

func get_import_options(_preset):
	return [
		{name = "clips/loop", default_value = Character.AUTO},
		{name = "clips/fps", default_value = 30, property_hint = PROPERTY_HINT_RANGE, hint_string = "5,120"},
		{name = "drawing/template", default_value = "auto", property_hint = PROPERTY_HINT_ENUM, hint_string = "auto,biped,quadruped"},
		{name = "drawing/height", default_value = 0.0, property_hint = PROPERTY_HINT_RANGE, hint_string = "0,1000"},
	]

func import(source_file, save_path, options, _platform_variants, _gen_files):
	var path = ProjectSettings.globalize_path(source_file)
	var is_drawing = path.get_extension().to_lower() != "glb"
	var results = ProjectSettings.globalize_path(save_path) + "-skel"
	if is_drawing:
		path = _rig(path, results, options)
	var scene = _scene(path, options["clips/fps"]) if path else null
	if scene:
		scene.name = source_file.get_file().get_basename()
		Character.mend(scene, options["clips/loop"], path)
	if is_drawing:
		_remove(results)
	if scene == null:
		return ERR_FILE_CORRUPT
	_own(scene, scene)
	var packed = PackedScene.new()
	var problem = packed.pack(scene)
	scene.free()
	return problem if problem != OK else ResourceSaver.save(save_path + "." + get_save_extension(), packed, ResourceSaver.FLAG_COMPRESS)

# The path of the GLB; empty, and said why, if there is none.
func _rig(drawing: String, results: String, options: Dictionary) -> String:
	var program = settings.get_setting("skel/program")
	var said = []
	var arguments = [drawing, "-o", results, "--formats", "glb",
		"--template", options["drawing/template"], "--height", str(options["drawing/height"])]
	var code = OS.execute(program, arguments, true, said, true)
	var lines = PoolStringArray(said).join("").strip_edges().split("\n")
	if code == 0:
		for line in lines:
			if ": note: " in line:
				print(line)
		return results + "/" + drawing.get_file().get_basename() + ".glb"
	if lines[-1].begins_with("skel-infer: "):
		push_error(lines[-1])
	else:
		push_error("%s cannot be run; install skel, or name skel-infer in Editor Settings > Skel" % program)
	return ""

# By Godot's own importer of glTF, which wants more arguments in later versions.
func _scene(path: String, fps: int) -> Node:
	var importer = EditorSceneImporter.new()
	var arguments = [path, EditorSceneImporter.IMPORT_ANIMATION, fps]
	for method in importer.get_method_list():
		if method.name == "import_scene_from_other_importer":
			while arguments.size() < method.args.size():
				arguments.append(0)
	return importer.callv("import_scene_from_other_importer", arguments)

func _own(node: Node, root: Node) -> void:
	for child in node.get_children():
		child.owner = root
		_own(child, root)

func _remove(folder: String) -> void:
	var dir = Directory.new()
	if dir.open(folder) != OK:
		return
	dir.list_dir_begin(true)
	var file = dir.get_next()
	while file:
		dir.remove(file)
		file = dir.get_next()
	dir.remove(folder)
