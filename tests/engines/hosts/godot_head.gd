extends Node
# Draws a package's head as godot_head.js asks for it: each light alone and the ambient light, which add up. Compatibility adds lights that
# have shadows to the picture in sRGB, where sums are wrong. There is no importer here: files become resources as their .import says.

const FOLDER := "res://addons/dermis_skin/"

# Of all light, from 0.5 down: nothing is cut off at 1, and the mean of several pictures is finer than the 8 bits of each.
const LEAST_SCALE := 0.42

var choice := {}
var viewport := SubViewport.new()
var energy := 1.0  # the head's, of the environment
var background_linear := Color.BLACK
var imported: Array[Resource] = []  # the cache does not keep them


func _ready() -> void:
	for word in OS.get_cmdline_user_args():
		choice[word.get_slice("=", 0)] = word.get_slice("=", 1)
	_import_folder(FOLDER)
	viewport.size = Vector2i.ONE * int(choice.side) * int(choice.points)
	viewport.own_world_3d = true
	viewport.render_target_update_mode = SubViewport.UPDATE_ALWAYS
	viewport.positional_shadow_atlas_size = 4096
	add_child(viewport)
	var head: Node3D = load(FOLDER + "head/skin_head.tscn").instantiate()
	viewport.add_child(head)
	energy = head.environment.background_energy_multiplier
	background_linear = head.environment.background_color.srgb_to_linear()
	if choice.has("rest"):
		await _add_moment(head)
	if choice.has("clip"):
		head.pose(choice.clip, float(choice.time))
	await _add_moment(head)
	JavaScriptBridge.eval("window.showSquares()")


func _dress(head: Node3D, look: String) -> void:
	head.depths_side = 0 if look == "shadow" else 2048
	for skin: ShaderMaterial in head.skins:
		for material: ShaderMaterial in [skin, skin.next_pass]:
			material.set_shader_parameter("scattering", look != "lambert")
			material.set_shader_parameter("curved_gain", choice.has("gain"))
			if look == "normals":
				material.set_shader_parameter("baked_normals", false)
			if look == "frames":
				material.set_shader_parameter("moves", false)
			if look == "curvature":
				material.set_shader_parameter("curvature_gain", 0.001)


func _add_moment(head: Node3D) -> void:
	var usual: String = "lambert" if choice.has("lambert") else choice.get("mistake", "skin")
	for look: String in choice.get("looks", usual).split(","):
		_dress(head, look)
		await _add_square(head)


func _add_square(head: Node3D) -> void:
	for only: Light3D in head.lights:
		for light: Light3D in head.lights:
			light.visible = light == only
		_set_ambient(head, 0.0)
		await _add_pictures(head)
	for light: Light3D in head.lights:
		light.visible = false
	_set_ambient(head, 1.0)
	await _add_pictures(head)
	JavaScriptBridge.eval("window.endSquare()")


func _set_ambient(head: Node3D, part: float) -> void:
	head.environment.background_energy_multiplier = part * energy
	head.environment.ambient_light_source = Environment.AMBIENT_SOURCE_DISABLED if part == 0.0 else Environment.AMBIENT_SOURCE_SKY
	head.environment.reflected_light_source = Environment.REFLECTION_SOURCE_DISABLED if part == 0.0 else Environment.REFLECTION_SOURCE_SKY
	for skin: ShaderMaterial in head.skins:
		skin.set_shader_parameter("has_environment", part > 0.0)


func _add_pictures(head: Node3D) -> void:
	var count := int(choice.get("exposures", 6))
	for number in count:
		var scale := lerpf(0.5, LEAST_SCALE, float(number) / count)
		head.environment.tonemap_exposure = scale
		# Compatibility does not expose the background.
		head.environment.background_color = (background_linear * scale).linear_to_srgb()
		for i in 3 if number == 0 else 1:
			await RenderingServer.frame_post_draw
			if choice.get("mistake") == "place":
				_move_depths(head)
		var image := viewport.get_texture().get_image()
		image.convert(Image.FORMAT_RGBA8)
		JavaScriptBridge.eval("window.addPicture('%s', %f)" % [Marshalls.raw_to_base64(image.get_data()), scale * count])


# The depths are looked up 20 mm higher.
func _move_depths(head: Node3D) -> void:
	for skin: ShaderMaterial in head.skins:
		skin.set_shader_parameter("depth_center", head.global_transform * head._metres(head.settings.bounds.center_mm) - Vector3(0.0, 0.02, 0.0))


func _import_folder(folder: String) -> void:
	for name in DirAccess.get_directories_at(folder):
		_import_folder(folder + name + "/")
	for name in DirAccess.get_files_at(folder):
		if name.ends_with(".halves"):
			var path := folder + name.get_basename().get_basename()
			_import_halves(path, int(name.get_basename().get_extension()), FileAccess.get_file_as_bytes(folder + name))
		elif name.ends_with(".import") and not name.ends_with(".exr.import"):
			_import(folder + name.trim_suffix(".import"), FileAccess.get_file_as_string(folder + name))


func _import(path: String, settings: String) -> void:
	if path.ends_with(".glb"):
		_import_scene(path)
		return
	var image := Image.new()
	if image.load(path) != OK:
		return
	if choice.get("mistake") == "srgb" and path.get_file().begins_with("normals_"):
		image.srgb_to_linear()
	if settings.contains("mipmaps/generate=true"):
		image.generate_mipmaps(settings.contains("compress/normal_map=1"))
	var texture := ImageTexture.create_from_image(image)
	texture.take_over_path(path)
	imported.append(texture)


func _import_halves(path: String, width: int, halves: PackedByteArray) -> void:
	@warning_ignore("integer_division")
	var image := Image.create_from_data(width, halves.size() / (8 * width), false, Image.FORMAT_RGBAH, halves)
	if FileAccess.get_file_as_string(path + ".import").contains("mipmaps/generate=true"):
		image.generate_mipmaps()
	imported.append(ImageTexture.create_from_image(image))
	imported[-1].take_over_path(path)


func _import_scene(path: String) -> void:
	var document := GLTFDocument.new()
	var state := GLTFState.new()
	document.append_from_buffer(FileAccess.get_file_as_bytes(path), "", state)
	var root := document.generate_scene(state)
	var scene := PackedScene.new()
	scene.pack(root)
	scene.take_over_path(path)
	imported.append(scene)
