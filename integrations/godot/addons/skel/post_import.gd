# For Godot's own importer of scenes: Import > Nodes > Custom Script.
tool
extends EditorScenePostImport

const Character = preload("character.gd")

func post_import(scene):
	Character.mend(scene, Character.AUTO, get_source_file())
	return scene
