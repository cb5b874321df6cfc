# godot3 --path PROJECT --script show_character.gd FILE PICTURE: a character at rest, walking and waving.
extends SceneTree

var frames = 0

func add(node):
	root.add_child(node)
	return node

func _init():
	var environment = Environment.new()
	environment.background_mode = Environment.BG_COLOR
	environment.background_color = Color(0.75, 0.8, 0.85)
	environment.ambient_light_color = Color(1, 1, 1)
	environment.ambient_light_energy = 0.5
	add(WorldEnvironment.new()).environment = environment
	var light = add(DirectionalLight.new())
	light.rotation_degrees = Vector3(-40, 30, 0)
	light.light_energy = 0.7
	var camera = add(Camera.new())
	camera.projection = Camera.PROJECTION_ORTHOGONAL
	camera.size = 2.1
	camera.translation = Vector3(0, 0.95, 5)
	camera.current = true
	var x = -1.05
	for clip in ["idle", "walk", "wave"]:
		var scene = add(load("res://" + OS.get_cmdline_args()[-2]).instance())
		scene.translation = Vector3(x, 0, 0)
		scene.rotation_degrees = Vector3(0, 25 * x, 0)
		x += 1.05
		var player = scene.get_node("AnimationPlayer")
		player.play(clip)
		player.seek(0.3 * player.get_animation(clip).length, true)
		player.stop(false)

func _idle(_delta):
	frames += 1
	if frames < 5:
		return false
	var image = root.get_texture().get_data()
	image.flip_y()
	image.save_png(OS.get_cmdline_args()[-1])
	return true
