# What both ways of importing do to a scene that Godot has made of a GLB.
tool

const AUTO = "auto"  # clips go on and on as the file says

# `loops`: the names of clips that go on and on, or AUTO; others are played once. `glb`: the path of the file.
static func mend(scene: Node, loops: String, glb: String) -> void:
	var looping = []
	if loops.strip_edges() == AUTO:
		looping = _loops_of(glb)
	else:
		for name in loops.split(",", false):
			looping.append(name.strip_edges())
			if not _has_clip(scene, looping.back()):
				push_warning("skel: %s has no clip \"%s\" that could loop; see the option clips/loop" % [glb.get_file(), looping.back()])
	_mend(scene, scene.name, looping)

# Of the animations whose extras say so.
static func _loops_of(glb: String) -> Array:
	var file = File.new()
	if file.open(glb, File.READ) != OK or file.get_32() != 0x46546C67:  # glTF
		return []
	file.seek(12)
	var length = file.get_32()
	file.seek(20)
	var said = JSON.parse(file.get_buffer(length).get_string_from_utf8()).result
	var names = []
	for animation in said.get("animations", []) if said is Dictionary else []:
		var extras = animation.get("extras")
		if extras is Dictionary and extras.get("loop") is bool and extras.loop:
			names.append(animation.get("name", ""))
	return names

static func _has_clip(node: Node, name: String) -> bool:
	if node is AnimationPlayer and node.has_animation(name):
		return true
	for child in node.get_children():
		if _has_clip(child, name):
			return true
	return false

static func _mend(node: Node, name: String, looping: Array) -> void:
	if node is MeshInstance:
		node.name = name  # Godot puts a number behind what another node is called
		node.mesh = _with_shares(node.mesh)
		for surface in range(node.mesh.get_surface_count()):
			_dim(node.mesh.surface_get_material(surface))
	if node is AnimationPlayer:
		for clip in node.get_animation_list():
			node.get_animation(clip).loop = clip in looping
	for child in node.get_children():
		_mend(child, name, looping)

# Godot forgets how much of the texture shines and lets it all: what light does not give.
static func _dim(material: SpatialMaterial) -> void:
	if material.emission_texture and material.emission_texture == material.albedo_texture:
		material.emission_energy = 1 - pow((material.albedo_color.r + 0.055) / 1.055, 2.4)

# Godot 3.2 takes texture coordinates in units of 1/65535 for whole numbers.
static func _with_shares(mesh: ArrayMesh) -> ArrayMesh:
	var result = ArrayMesh.new()
	for surface in range(mesh.get_surface_count()):
		var arrays = mesh.surface_get_arrays(surface)
		var most = 0.0
		var shares = arrays[Mesh.ARRAY_TEX_UV] if arrays[Mesh.ARRAY_TEX_UV] else PoolVector2Array()
		for uv in shares:
			most = max(most, max(uv.x, uv.y))
		if surface == 0 and most < 256:
			return mesh
		for i in range(shares.size()):
			arrays[Mesh.ARRAY_TEX_UV][i] /= 65535.0
		result.add_surface_from_arrays(mesh.surface_get_primitive_type(surface), arrays)
		result.surface_set_material(surface, mesh.surface_get_material(surface))
		result.surface_set_name(surface, mesh.surface_get_name(surface))
	return result
