tool
extends EditorPlugin

const PROGRAM = "skel/program"
var importer

func _enter_tree():
	var settings = get_editor_interface().get_editor_settings()
	if not settings.has_setting(PROGRAM):
		settings.set_setting(PROGRAM, "skel-infer")
	settings.add_property_info({name = PROGRAM, type = TYPE_STRING, hint = PROPERTY_HINT_GLOBAL_FILE})
	importer = preload("import_character.gd").new()
	importer.settings = settings
	add_import_plugin(importer)

func _exit_tree():
	remove_import_plugin(importer)
	importer = null
