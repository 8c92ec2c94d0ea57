extends Node
# Of the files of `dermis export --engine godot --native`, as the engine reads them: strength, whether it scatters and in skin mode, and the
# script's depth scale, as floats for tools/checks/host_floats.mjs. In place of head.gd for godot_head.js.


func _ready() -> void:
	var skin: StandardMaterial3D = load("res://skin_material.tres")
	var scattering: Node = load("res://skin_scattering.gd").new()
	add_child(scattering)
	var values := PackedFloat32Array([skin.subsurf_scatter_strength, float(skin.subsurf_scatter_enabled), float(skin.subsurf_scatter_skin_mode),
		scattering.DEPTH_SCALE, 0.0, 0.0])
	JavaScriptBridge.eval("window.picture = { width: 2, height: 1, base64: '%s' }; document.body.dataset.state = 'drawn'" %
		Marshalls.raw_to_base64(values.to_byte_array()))
