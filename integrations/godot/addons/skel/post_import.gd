# For Godot's own importer of scenes: Import > Nodes > Custom Script.
tool
extends EditorScenePostImport

const Character = preload("character.gd")

func post_import(scene):
	Character.mend(scene, Character.LOOPS)
	return scene
