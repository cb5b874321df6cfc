# godot3-server --script load_sheet.gd SHEET.json ANIMATIONS FRAMES: reads the sheet by the example's script. Of its clips idle loops.
extends SceneTree

func _init():
	var arguments = OS.get_cmdline_args()
	var Sheet = load(arguments[-4])
	var path = arguments[-3]
	var atlas = Sheet.read_atlas(path)
	var image = Image.new()
	var problem = image.load(path.get_base_dir() + "/" + atlas.meta.image)
	var texture = ImageTexture.new()
	texture.create_from_image(image, 0)
	var frames = Sheet.sprite_frames(atlas, texture)
	var count = 0
	var inside = problem == OK
	for name in frames.get_animation_names():
		count += frames.get_frame_count(name)
		for i in range(frames.get_frame_count(name)):
			var part = frames.get_frame(name, i)
			inside = inside and Rect2(Vector2(), image.get_size()).encloses(part.region)
			var size = part.region.size + part.margin.size
			inside = inside and Rect2(Vector2(), size + Vector2(1, 1)).has_point(Sheet.pivot(atlas))
	for tag in atlas.meta.frameTags:
		inside = inside and frames.get_animation_loop(tag.name) == tag.name.begins_with("idle")
	var animations = frames.get_animation_names().size()
	var good = inside and animations == int(arguments[-2]) and count == int(arguments[-1])
	print("Godot: %s: %d animations, %d frames, %s" % [path.get_file(), animations, count, "good" if good else "WRONG"])
	quit(0 if good else 1)
