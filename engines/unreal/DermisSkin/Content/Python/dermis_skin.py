"""Imports the skin's table with the settings that it needs, and makes an example material.

Run by init_unreal.py when the editor starts and the table is not there yet. By hand, in the Python console:

    import dermis_skin; dermis_skin.install()
"""

import os

import unreal

PLUGIN = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FOLDER = "/DermisSkin"
TABLE = FOLDER + "/T_SkinTable"
MATERIAL = FOLDER + "/M_Skin"

# What the table needs in the engine: linear numbers, 16 bit, no mip levels, read within its edges.
TABLE_SETTINGS = {
    "srgb": False,
    "compression_settings": unreal.TextureCompressionSettings.TC_HDR,
    "mip_gen_settings": unreal.TextureMipGenSettings.TMGS_NO_MIPMAPS,
    "filter": unreal.TextureFilter.TF_BILINEAR,
    "address_x": unreal.TextureAddress.TA_CLAMP,
    "address_y": unreal.TextureAddress.TA_CLAMP,
    "never_stream": True,
    "max_texture_size": 0,
}


def import_file(path, folder, name):
    """Imports a file of the plugin; the assets that it became."""
    task = unreal.AssetImportTask()
    task.set_editor_property("filename", os.path.join(PLUGIN, path))
    task.set_editor_property("destination_path", folder)
    task.set_editor_property("destination_name", name)
    task.set_editor_property("automated", True)
    task.set_editor_property("replace_existing", True)
    task.set_editor_property("save", False)
    unreal.AssetToolsHelpers.get_asset_tools().import_asset_tasks([task])
    assets = [unreal.EditorAssetLibrary.load_asset(path) for path in task.get_editor_property("imported_object_paths")]
    if not assets:
        raise RuntimeError("dermis_skin: " + path + " could not be imported")
    return assets


def import_texture(path, folder, name, settings):
    texture = import_file(path, folder, name)[0]
    for key, value in settings.items():
        texture.set_editor_property(key, value)
    unreal.EditorAssetLibrary.save_loaded_asset(texture)
    return texture


def import_table():
    return import_texture(os.path.join("Resources", "SkinTable.exr"), FOLDER, "T_SkinTable", TABLE_SETTINGS)


def add(material, kind, x, y, **properties):
    node = unreal.MaterialEditingLibrary.create_material_expression(material, kind, x, y)
    for name, value in properties.items():
        node.set_editor_property(name, value)
    return node


def custom_input(name):
    value = unreal.CustomInput()
    value.set_editor_property("input_name", name)
    return value


def create_material(folder, name):
    tools = unreal.AssetToolsHelpers.get_asset_tools()
    material = tools.create_asset(name, folder, unreal.Material, unreal.MaterialFactoryNew())
    material.set_editor_property("shading_model", unreal.MaterialShadingModel.MSM_UNLIT)
    return material


def make_material(table):
    material = create_material(FOLDER, "M_Skin")
    inputs = {
        "Table": add(material, unreal.MaterialExpressionTextureObjectParameter, -900, 0, parameter_name="SkinTable",
                     texture=table, sampler_type=unreal.MaterialSamplerType.SAMPLERTYPE_LINEAR_COLOR),
        "Normal": add(material, unreal.MaterialExpressionVertexNormalWS, -900, 150),
        "Position": add(material, unreal.MaterialExpressionWorldPosition, -900, 250,
                        world_position_shader_offset=unreal.WorldPositionIncludedOffsets.WPT_CAMERA_RELATIVE),
        "LightDirection": add(material, unreal.MaterialExpressionSkyAtmosphereLightDirection, -900, 350),
        "Albedo": add(material, unreal.MaterialExpressionVectorParameter, -900, 450, parameter_name="Albedo",
                      default_value=unreal.LinearColor(0.48, 0.19, 0.11, 1.0)),
        "LightColor": add(material, unreal.MaterialExpressionVectorParameter, -900, 650, parameter_name="LightColor",
                          default_value=unreal.LinearColor(1.0, 1.0, 1.0, 1.0)),
        # In mm, of ears and other thin parts; 0: no light goes through. A map goes in its place.
        "Thickness": add(material, unreal.MaterialExpressionScalarParameter, -900, 850, parameter_name="ThicknessMm",
                         default_value=0.0),
    }
    node = add(material, unreal.MaterialExpressionCustom, -400, 200, description="Skin",
               output_type=unreal.CustomMaterialOutputType.CMOT_FLOAT3,
               include_file_paths=["/Plugin/DermisSkin/SkinNode.ush"],
               inputs=[custom_input(name) for name in inputs],
               code="float NdotL = dot(normalize(Normal), LightDirection);\n"
                    "float3 Diffuse = SkinDiffuseOfTable(Table, TableSampler, NdotL, SkinCurvature(Normal, Position),\n"
                    "    Parameters.SvPosition.xy);\n"
                    "return SkinThin(Diffuse, SkinGain(Normal, Position), NdotL, Thickness) * Albedo.rgb * LightColor.rgb;")
    finish(material, node, inputs)


def finish(material, node, inputs):
    """Connects the node and compiles the material, which is unlit: the node's light is what it emits."""
    for name, source in inputs.items():
        unreal.MaterialEditingLibrary.connect_material_expressions(source, "", node, name)
    unreal.MaterialEditingLibrary.connect_material_property(node, "", unreal.MaterialProperty.MP_EMISSIVE_COLOR)
    unreal.MaterialEditingLibrary.recompile_material(material)
    unreal.EditorAssetLibrary.save_loaded_asset(material)


def install():
    table = import_table()
    if not unreal.EditorAssetLibrary.does_asset_exist(MATERIAL):
        make_material(table)
    unreal.log("dermis_skin: " + TABLE + " and " + MATERIAL + " are ready")
