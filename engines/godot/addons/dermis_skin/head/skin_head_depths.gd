@tool
extends SubViewport
# How far a head is from each of its lights, for skin_head_shadow.gdshaderinc: Godot gives no shader its own shadow maps. A separate world
# has a copy of each mesh for each light, turned so that one camera looks along all lights. The picture is drawn again when something has
# moved.

const MOST_LIGHTS := 4  # of skin_head_shadow.gdshaderinc
const COLUMNS := 2
const CASTERS := &"skin_shadow_casters"  # the group of other meshes that shade the skin
const CAMERA_RADII := 10.0  # from the camera to the head: what is farther casts no shadow

var skins: Array[ShaderMaterial] = []
var _own: Array[Node] = []
var _unseen := {}  # of a mesh, the surfaces that cast no shadow
var _copies: Array[Dictionary] = []  # from: a mesh; to: its copies, one for each light
var _materials: Array[ShaderMaterial] = []
var _copied: Array = []  # what the copies were made for
var _drawn: Array = []  # what the picture was drawn for
var _camera := Camera3D.new()
var _shader: Shader


func _init() -> void:
	own_world_3d = true
	gui_disable_input = true
	positional_shadow_atlas_size = 0
	mesh_lod_threshold = 0.0
	render_target_update_mode = SubViewport.UPDATE_DISABLED
	_camera.projection = Camera3D.PROJECTION_ORTHOGONAL
	_camera.environment = Environment.new()
	_camera.environment.background_mode = Environment.BG_COLOR
	_camera.environment.background_color = Color.WHITE  # the farthest depth
	add_child(_camera)


# A mesh of the head and the numbers of its surfaces that cast no shadow.
func add_caster(mesh: MeshInstance3D, unseen: Array[int]) -> void:
	_own.append(mesh)
	_unseen[mesh] = unseen


# Once a frame: draws what these lights see if it has changed. The sphere is in the world. side: texels of a light's square; 0: none.
func follow(lights: Array[Light3D], center: Vector3, radius: float, mm_per_unit: float, side: int) -> void:
	var shown := lights.filter(_casts_shadow).slice(0, MOST_LIGHTS) if side > 0 else []
	var casters := []
	for mesh: Variant in _own + get_tree().get_nodes_in_group(CASTERS):
		if is_instance_valid(mesh) and mesh is MeshInstance3D:
			casters.append(mesh)
	var copied := [shown.size(), casters, casters.map(func(mesh: MeshInstance3D) -> Mesh: return mesh.mesh)]
	if copied != _copied:
		_copied = copied
		_copy(casters, shown.size())
	var bases: Array[Basis] = []
	for light: Light3D in shown:
		bases.append(light.global_transform.basis.orthonormalized())
	var state := [bases, center, radius, mm_per_unit, side]
	for copy in _copies:
		state.append([copy.from.global_transform, copy.from.is_visible_in_tree(), _weights(copy.from)])
	if state == _drawn:
		return
	_drawn = state
	_place(bases, center, radius, side)
	_tell_skins(bases, center, radius, mm_per_unit, side)
	_redraw()


static func _casts_shadow(light: Variant) -> bool:
	return is_instance_valid(light) and light is DirectionalLight3D and light.shadow_enabled and light.is_visible_in_tree()


static func _weights(mesh: MeshInstance3D) -> PackedFloat32Array:
	var weights := PackedFloat32Array()
	for i in mesh.get_blend_shape_count():
		weights.append(mesh.get_blend_shape_value(i))
	return weights


func _copy(casters: Array, count: int) -> void:
	for copy in _copies:
		for mesh: MeshInstance3D in copy.to:
			mesh.queue_free()
	_copies.clear()
	_materials.clear()
	_drawn = []
	for i in count:
		_materials.append(_material())
	for from: MeshInstance3D in casters:
		var to: Array[MeshInstance3D] = []
		for material in _materials:
			to.append(_copy_of(from, material))
		_copies.append({"from": from, "to": to})
		_follow_skeleton(from.get_node_or_null(from.skeleton) as Skeleton3D)


func _material() -> ShaderMaterial:
	if _shader == null:
		_shader = load((get_script() as Script).resource_path.get_base_dir() + "/skin_head_depth.gdshader")
	var material := ShaderMaterial.new()
	material.shader = _shader
	return material


func _copy_of(from: MeshInstance3D, material: ShaderMaterial) -> MeshInstance3D:
	var to := MeshInstance3D.new()
	to.mesh = from.mesh
	add_child(to)
	var skeleton := from.get_node_or_null(from.skeleton) as Skeleton3D
	to.skin = from.skin
	to.skeleton = to.get_path_to(skeleton) if skeleton else NodePath()
	for surface in from.mesh.get_surface_count() if from.mesh else 0:
		to.set_surface_override_material(surface, _surface_material(from, surface, material))
	return to


# Of a surface that is seen through holes, or not at all, a material of its own.
func _surface_material(from: MeshInstance3D, surface: int, material: ShaderMaterial) -> ShaderMaterial:
	var source := from.get_active_material(surface) as BaseMaterial3D
	var below := 2.0 if surface in _unseen.get(from, []) else 0.0
	if below == 0.0 and source and source.transparency == BaseMaterial3D.TRANSPARENCY_ALPHA_SCISSOR:
		below = source.alpha_scissor_threshold
	if below == 0.0:
		return material
	var own := material.duplicate() as ShaderMaterial
	own.set_shader_parameter("cut_out_below", below)
	if source:
		own.set_shader_parameter("cut_out_map", source.albedo_texture)
	return own


func _follow_skeleton(skeleton: Skeleton3D) -> void:
	for word: StringName in [&"pose_updated", &"skeleton_updated"]:  # the second one from Godot 4.3 on
		if skeleton and skeleton.has_signal(word) and not skeleton.is_connected(word, _redraw):
			skeleton.connect(word, _redraw)


func _redraw() -> void:
	render_target_update_mode = SubViewport.UPDATE_DISABLED if _materials.is_empty() else SubViewport.UPDATE_ONCE


# The centre of a light's square in the camera's plane, in radii.
static func _square_center(number: int, count: int) -> Vector2:
	@warning_ignore("integer_division")
	var row := number / COLUMNS
	return Vector2(2 * (number % COLUMNS) + 1 - _columns(count), _rows(count) - 1 - 2 * row)


static func _columns(count: int) -> int:
	return clampi(count, 1, COLUMNS)


static func _rows(count: int) -> int:
	return maxi(ceili(float(count) / COLUMNS), 1)


# The camera looks along -z; a copy lies as the light sees it, its square's centre in the plane z = 0.
func _place(bases: Array[Basis], center: Vector3, radius: float, side: int) -> void:
	var count := bases.size()
	for i in count:
		var at := radius * _square_center(i, count)
		var turn := bases[i].transposed()
		var from_world := Transform3D(turn, Vector3(at.x, at.y, 0.0) - turn * center)
		for copy in _copies:
			var mesh: MeshInstance3D = copy.to[i]
			mesh.transform = from_world * copy.from.global_transform
			mesh.visible = copy.from.is_visible_in_tree()
			for shape in mesh.get_blend_shape_count():
				mesh.set_blend_shape_value(shape, copy.from.get_blend_shape_value(shape))
			for surface in mesh.get_surface_override_material_count():
				var material := mesh.get_surface_override_material(surface) as ShaderMaterial
				material.set_shader_parameter("square_center", at)
				material.set_shader_parameter("radius", radius)
				material.set_shader_parameter("camera_distance", CAMERA_RADII * radius)
	size = maxi(side, 2) * Vector2i(_columns(count), _rows(count))
	_camera.position = Vector3(0.0, 0.0, CAMERA_RADII * radius)
	_camera.size = 2.0 * radius * _rows(count)
	_camera.near = 0.01 * radius
	_camera.far = (CAMERA_RADII + 2.0) * radius


func _tell_skins(bases: Array[Basis], center: Vector3, radius: float, mm_per_unit: float, side: int) -> void:
	var to_light := PackedVector3Array()
	var across := PackedVector3Array()
	for basis in bases:
		to_light.append(basis.z)
		across.append(basis.x)
	var values := {"depths": get_texture(), "depth_count": bases.size(), "depth_side": side, "depth_radius_mm": radius * mm_per_unit,
		"depth_center": center, "depth_to_light": to_light, "depth_across": across, "mm_per_unit": mm_per_unit}
	for skin in skins:
		for material: ShaderMaterial in [skin, skin.next_pass]:
			for word: String in values:
				material.set_shader_parameter(word, values[word])
