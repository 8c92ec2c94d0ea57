@tool
extends Node
# The scale of all subsurface scattering, for skin_material.tres (@profile@): in the world, not of the picture. The engine's blur is as
# many parts of the height as of the width; its mean is as wide as the profile.

const DEPTH_SCALE := @depth_scale@


func _ready() -> void:
	RenderingServer.sub_surface_scattering_set_quality(RenderingServer.SUB_SURFACE_SCATTERING_QUALITY_HIGH)
	get_viewport().size_changed.connect(_scale_to_picture)
	_scale_to_picture()


func _scale_to_picture() -> void:
	var size := get_viewport().get_visible_rect().size
	RenderingServer.sub_surface_scattering_set_scale(0.0, DEPTH_SCALE * sqrt(size.x / size.y))
