@tool
extends Node3D
# The head of `dermis export --engine godot SCENE`: meshes with their maps bound, lights with shadows, camera, environment, as
# `dermis render` has them. Units are metres.

const FOLDER := "res://addons/dermis_skin/head/"
const TABLE := "res://addons/dermis_skin/skin_table.exr"
const MM_PER_UNIT := 1000.0
const Depths := preload("skin_head_depths.gd")
const MOST_TARGETS := 64  # of skin_head_surface.gdshaderinc

# Texels along a side of the picture that has a light's depths of the head; 0: shadows have the engine's edges.
@export_range(0, 4096, 256) var depths_side := 2048

var settings: Dictionary
var skins: Array[ShaderMaterial] = []
var lights: Array[Light3D] = []  # directional ones that shade the skin; yours may be added
var players: Array[AnimationPlayer] = []  # of the clips, one for each object that moves
var environment: Environment
var _depths: Depths
var _followed: Array[Dictionary] = []  # skins whose curvature follows the targets of their mesh


func _ready() -> void:
	process_priority = 1  # after the players
	settings = (load(FOLDER + "scene.json") as JSON).data
	_depths = Depths.new()
	add_child(_depths, false, Node.INTERNAL_MODE_BACK)
	for object: Dictionary in settings.objects:
		_add_object(object)
	for light: Dictionary in settings.lights:
		_add_light(light)
	_add_camera(settings.camera)
	_add_environment()


static func _vector(numbers: Array) -> Vector3:
	return Vector3(numbers[0], numbers[1], numbers[2])


static func _metres(lengths_mm: Array) -> Vector3:
	return _vector(lengths_mm) / MM_PER_UNIT


# A colour of the engine is sRGB, at most 1; what is above goes into the energy.
static func _set_color(light: Light3D, color_linear: Vector3, intensity: float) -> void:
	var largest := maxf(maxf(color_linear.x, color_linear.y), maxf(color_linear.z, 1e-6))
	var part := color_linear / largest
	light.light_color = Color(part.x, part.y, part.z).linear_to_srgb()
	light.light_energy = intensity * largest / PI  # shaders get it times pi: an irradiance


func _add_object(object: Dictionary) -> void:
	var node := (load(FOLDER + object.file) as PackedScene).instantiate()
	add_child(node)
	for player: AnimationPlayer in node.find_children("*", "AnimationPlayer", true, false):
		players.append(player)
	var by_name := {}
	for one: Dictionary in object.materials:
		by_name[one.name] = one
	for child: MeshInstance3D in node.find_children("*", "MeshInstance3D", true, false):
		var unseen: Array[int] = []
		for surface in child.mesh.get_surface_count():
			var source := child.mesh.surface_get_material(surface)
			var one: Dictionary = by_name.get(source.resource_name, {"class": "other"})
			if one.class == "skin":
				var skin := _skin_material(one)
				child.set_surface_override_material(surface, skin)
				if object.has("curvature_of_targets"):
					_follow_targets(child, skin, object.curvature_of_targets)
			elif one.class == "translucent":
				child.cast_shadow = GeometryInstance3D.SHADOW_CASTING_SETTING_OFF
				unseen.append(surface)
		_depths.add_caster(child, unseen)


func _follow_targets(mesh: MeshInstance3D, skin: ShaderMaterial, changes: Dictionary) -> void:
	var rows := PackedInt32Array()  # the first one of each target; below 0: it changes nothing
	var opened := PackedFloat32Array()
	for i in mesh.get_blend_shape_count():
		rows.append(changes.targets.find(String((mesh.mesh as ArrayMesh).get_blend_shape_name(i))) * int(changes.rows))
		opened.append(mesh.get_blend_shape_value(i))
	for material: ShaderMaterial in [skin, skin.next_pass]:
		material.set_shader_parameter("curvature_of_targets", load(FOLDER + changes.file))
		material.set_shader_parameter("most_change_per_mm", changes.most_per_mm)
	_followed.append({"mesh": mesh, "skin": skin, "rows": rows, "opened": opened, "weights": PackedVector2Array()})


func _process(_delta: float) -> void:
	_follow_weights()
	var scale_here := global_transform.basis.get_scale().x
	_depths.follow(lights, global_transform * _metres(settings.bounds.center_mm), scale_here * settings.bounds.radius_mm / MM_PER_UNIT,
			MM_PER_UNIT / scale_here, depths_side)


# The weights of the targets, whoever sets them, for the shaders.
func _follow_weights() -> void:
	for one: Dictionary in _followed:
		var weights := PackedVector2Array()
		for i: int in one.rows.size():
			var weight: float = one.mesh.get_blend_shape_value(i) - one.opened[i]
			if one.rows[i] >= 0 and weight != 0.0 and weights.size() < MOST_TARGETS:
				weights.append(Vector2(one.rows[i], weight))
		if weights == one.weights:
			continue
		one.weights = weights
		for material: ShaderMaterial in [one.skin, one.skin.next_pass]:
			material.set_shader_parameter("target_count", weights.size())
			material.set_shader_parameter("target_weights", weights)


# The head at a time of a clip; see the list of a player's animations for the clips.
func pose(clip: String, time_s: float) -> void:
	for player in players:
		if player.has_animation(clip):
			player.play(clip)
			player.seek(time_s, true)
			player.pause()


func _skin_material(one: Dictionary) -> ShaderMaterial:
	var skin := ShaderMaterial.new()
	skin.shader = load(FOLDER + "skin_head.gdshader")
	skin.next_pass = ShaderMaterial.new()
	skin.next_pass.shader = load(FOLDER + "skin_head_through.gdshader")
	var albedo := _vector(one.albedo_linear)
	var values := {"f0": one.f0, "roughness": one.roughness, "normal_strength": one.normal_scale, "skin_table": load(TABLE),
		"albedo": Color(albedo.x, albedo.y, albedo.z).linear_to_srgb(), "object_space_normals": one.object_space_normals,
		"moves": one.moves, "penumbra_mm": settings.penumbra_mm}
	for map: String in one.maps:
		values[map + "_map"] = load(FOLDER + one.maps[map])
	if settings.has("baked_normals"):
		values.baked_normals = true
		var names := ["normals_red", "normals_green", "normals_spread"]
		for i in 3:
			values[names[i]] = load(FOLDER + settings.baked_normals[i])
	if settings.has("thickness"):
		values.thickness_map = load(FOLDER + settings.thickness.file)
		values.thickness_max_mm = settings.thickness.max_mm
	if settings.environment != null:
		values.merge(_environment_values(settings.environment))
	for name: String in values:
		skin.set_shader_parameter(name, values[name])
		skin.next_pass.set_shader_parameter(name, values[name])
	skins.append(skin)
	_depths.skins.append(skin)
	return skin


static func _environment_values(sky: Dictionary) -> Dictionary:
	var harmonics := PackedVector3Array()
	for one: Array in sky.radiance_sh:
		harmonics.append(_vector(one) * sky.intensity)
	return {"has_environment": true, "environment_sh": harmonics, "environment_turn": Vector2(cos(sky.yaw_rad), sin(sky.yaw_rad)),
		"reflections": load(FOLDER + sky.reflections.file), "reflection_levels": sky.reflections.levels,
		"reflected_shares": load(FOLDER + "reflected_shares.exr")}


func _add_light(one: Dictionary) -> void:
	var light: Light3D
	var to_light := _vector(one.to_light)
	if one.kind == "directional":
		light = DirectionalLight3D.new()
		light.directional_shadow_mode = DirectionalLight3D.SHADOW_ORTHOGONAL
		# One map over the head.
		light.directional_shadow_max_distance = 0.001 + (_metres(settings.camera.eye_mm) - _metres(settings.bounds.center_mm)).length() \
				+ settings.bounds.radius_mm / MM_PER_UNIT
	elif one.kind == "point":
		light = OmniLight3D.new()
		light.omni_range = 100.0
		light.omni_attenuation = 2.0
	else:
		light = SpotLight3D.new()
		light.spot_range = 100.0
		light.spot_attenuation = 2.0
		light.spot_angle = rad_to_deg(one.outer_angle_rad)
	light.name = one.name
	_set_color(light, _vector(one.color_linear), one.intensity)
	light.light_specular = 1.0
	light.shadow_enabled = one.casts_shadow
	add_child(light)
	var up := Vector3.UP if absf(to_light.y) < 0.99 else Vector3.RIGHT
	light.basis = Basis.looking_at(-to_light, up)
	if one.has("position_mm"):
		light.position = _metres(one.position_mm)
	lights.append(light)


func _add_camera(one: Dictionary) -> void:
	var camera := Camera3D.new()
	camera.fov = rad_to_deg(one.vertical_fov_rad)
	camera.near = 0.05
	camera.far = 20.0
	add_child(camera)
	camera.look_at_from_position(_metres(one.eye_mm), _metres(one.target_mm), _vector(one.up))
	camera.current = true


func _add_environment() -> void:
	environment = Environment.new()
	var energy: float = 1.0 if settings.environment == null else settings.environment.intensity
	var color := _vector(settings.background_linear) / maxf(energy, 1e-3)  # the energy is the background's too
	environment.background_mode = Environment.BG_COLOR
	environment.background_color = Color(color.x, color.y, color.z).linear_to_srgb()
	environment.tonemap_mode = Environment.TONE_MAPPER_LINEAR
	environment.tonemap_exposure = settings.exposure
	if settings.environment != null:
		var panorama := PanoramaSkyMaterial.new()
		panorama.panorama = load(FOLDER + settings.environment.file)
		environment.sky = Sky.new()
		environment.sky.sky_material = panorama
		environment.sky_rotation = Vector3(0.0, settings.environment.yaw_rad, 0.0)
		environment.ambient_light_source = Environment.AMBIENT_SOURCE_SKY
		environment.reflected_light_source = Environment.REFLECTION_SOURCE_SKY
		environment.background_energy_multiplier = energy
	var world := WorldEnvironment.new()
	world.environment = environment
	add_child(world)
