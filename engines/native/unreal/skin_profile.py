"""Makes the Subsurface Profile /Game/Skin: @profile@. In the editor's Python console: py "path/to/skin_profile.py" """

import unreal

SETTINGS = {
    "surface_albedo": unreal.LinearColor(@surface_albedo_r@, @surface_albedo_g@, @surface_albedo_b@, 1),
    "mean_free_path_color": unreal.LinearColor(@mean_free_path_color_r@, @mean_free_path_color_g@, @mean_free_path_color_b@, 1),
    "mean_free_path_distance": @mean_free_path_distance@,
    "world_unit_scale": @world_unit_scale@,
    "enable_burley": True,
    "enable_mean_free_path": False,
    "ior": 1.4,
}

tools = unreal.AssetToolsHelpers.get_asset_tools()
profile = unreal.EditorAssetLibrary.load_asset("/Game/Skin") or tools.create_asset(
    "Skin", "/Game", unreal.SubsurfaceProfile, unreal.SubsurfaceProfileFactory())
settings = profile.get_editor_property("settings")
for name, value in SETTINGS.items():
    settings.set_editor_property(name, value)
profile.set_editor_property("settings", settings)
unreal.EditorAssetLibrary.save_asset("/Game/Skin")
