# godot3-server --path PROJECT --script load_character.gd FILE BONES LOOPS: what the add-on has made of a drawing or of a GLB.
extends SceneTree

func find(node, type):
	if node.is_class(type):
		return node
	for child in node.get_children():
		var found = find(child, type)
		if found:
			return found

func has_number(name):
	return name != name.rstrip("0123456789")

func wrong(problem, file):
	print("Godot: %s: %s, WRONG" % [file, problem])
	quit(1)

func _init():
	var arguments = OS.get_cmdline_args()
	var file = arguments[-3]
	var packed = load("res://" + file)
	if not packed is PackedScene:
		return wrong("no scene", file)
	var scene = packed.instance()
	var skeleton = find(scene, "Skeleton")
	var mesh = find(scene, "MeshInstance")
	var player = find(scene, "AnimationPlayer")
	if skeleton.get_bone_count() != int(arguments[-2]):
		return wrong("%d bones" % skeleton.get_bone_count(), file)
	if has_number(mesh.name) or scene.name != file.get_basename():
		return wrong("names are %s, %s" % [scene.name, mesh.name], file)
	if mesh.skin == null or mesh.get_node(mesh.skeleton) != skeleton:
		return wrong("no skin", file)
	var material = mesh.get_surface_material(0)
	if material == null:
		material = mesh.mesh.surface_get_material(0)
	if material.albedo_texture == null:
		return wrong("no texture", file)
	if abs(material.emission_energy - 0.25) > 0.01:
		return wrong("shines by %f" % material.emission_energy, file)
	for uv in mesh.mesh.surface_get_arrays(0)[Mesh.ARRAY_TEX_UV]:
		if not Rect2(0, 0, 1, 1).has_point(uv):
			return wrong("texture coordinates beyond the texture", file)
	if mesh.get_aabb().position.y < -0.01 or mesh.get_aabb().position.y > 0.01:
		return wrong("stands at %f m" % mesh.get_aabb().position.y, file)
	var expected = arguments[-1].split(",")
	for name in player.get_animation_list():
		if player.get_animation(name).loop != (name in expected):
			return wrong("%s: looping is %s" % [name, player.get_animation(name).loop], file)
		if has_number(name):
			return wrong("a clip is called " + name, file)
	root.add_child(scene)
	player.play("walk")
	player.advance(0.1)
	var hip = skeleton.find_bone("left_hip")
	var before = skeleton.get_bone_global_pose(hip)
	player.advance(0.4)
	if skeleton.get_bone_global_pose(hip).is_equal_approx(before):
		return wrong("nothing moves", file)
	print("Godot: %s: %d bones, %d clips, good" % [file, skeleton.get_bone_count(), player.get_animation_list().size()])
	quit(0)
