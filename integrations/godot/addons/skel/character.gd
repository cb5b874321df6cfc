# What both ways of importing do to a scene that Godot has made of a GLB.
tool

const LOOPS = "dance, idle, run, talk, walk"

# The clips that go on and on; others are played once.
static func mend(scene: Node, loops: String) -> void:
	var looping = []
	for name in loops.split(",", false):
		looping.append(name.strip_edges())
	_mend(scene, scene.name, looping)

static func _mend(node: Node, name: String, looping: Array) -> void:
	if node is MeshInstance:
		node.name = name  # Godot puts a number behind what another node is called
	if node is AnimationPlayer:
		for clip in node.get_animation_list():
			node.get_animation(clip).loop = clip in looping
	for child in node.get_children():
		_mend(child, name, looping)
