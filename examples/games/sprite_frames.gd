# What a sheet of skel-animate holds, as SpriteFrames for an AnimatedSprite. Godot 3.
#   var Sheet = preload("sprite_frames.gd")
#   var atlas = Sheet.read_atlas("res://hero-sheet.json")
#   $AnimatedSprite.frames = Sheet.sprite_frames(atlas, preload("hero-sheet.png"))
#   $AnimatedSprite.centered = false
#   $AnimatedSprite.offset = -Sheet.pivot(atlas)  # stands where the node is
#   $AnimatedSprite.play("walk-s")
extends Reference

static func read_atlas(path: String) -> Dictionary:
	var file = File.new()
	if file.open(path, File.READ) != OK:
		return {}
	return JSON.parse(file.get_as_text()).result

static func sprite_frames(atlas: Dictionary, texture: Texture) -> SpriteFrames:
	var frames = atlas.frames if atlas.frames is Array else atlas.frames.values()
	var result = SpriteFrames.new()
	result.remove_animation("default")
	for tag in atlas.meta.frameTags:
		var duration_ms = 0.0
		result.add_animation(tag.name)
		for i in range(int(tag.from), int(tag.to) + 1):
			var box = frames[i].frame
			var in_cell = frames[i].spriteSourceSize
			var cell = frames[i].sourceSize
			var part = AtlasTexture.new()
			part.atlas = texture
			part.region = Rect2(box.x, box.y, box.w, box.h)
			part.margin = Rect2(in_cell.x, in_cell.y, cell.w - box.w, cell.h - box.h)
			result.add_frame(tag.name, part)
			duration_ms += frames[i].duration
		result.set_animation_speed(tag.name, 1000 * (tag.to - tag.from + 1) / duration_ms)
		result.set_animation_loop(tag.name, not tag.has("repeat"))
	return result

# In px, from the left and from the top of a frame.
static func pivot(atlas: Dictionary) -> Vector2:
	var point = atlas.meta.slices[0].keys[0].pivot
	return Vector2(point.x, point.y)
