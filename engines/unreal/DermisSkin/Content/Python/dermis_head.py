"""Builds the head of `dermis export --engine unreal SCENE` in the open level: meshes with their maps bound, lights and camera, as
`dermis render` has them. In the Python console:

    import dermis_head; dermis_head.build()

Files are in millimetres or metres, y up, right-handed. Unreal is in centimetres, z up, left-handed: x, z, y of the file's, as its importer
of glTF has it.
"""

import json
import math
import os

import unreal

import dermis_skin

FOLDER = dermis_skin.FOLDER + "/Head"
TAG = "DermisHead"
WHITE = "/Engine/EngineResources/WhiteSquareTexture"

# Numbers, not colours: linear and not compressed. Levels are means of four texels, as Dermis has them.
DATA = {
    "srgb": False,
    "compression_settings": unreal.TextureCompressionSettings.TC_VECTOR_DISPLACEMENTMAP,
    "mip_gen_settings": unreal.TextureMipGenSettings.TMGS_SIMPLE_AVERAGE,
    "filter": unreal.TextureFilter.TF_TRILINEAR,
    "address_x": unreal.TextureAddress.TA_WRAP,
    "address_y": unreal.TextureAddress.TA_WRAP,
    "never_stream": True,
    "max_texture_size": 0,
}
COLOUR = dict(DATA, srgb=True, compression_settings=unreal.TextureCompressionSettings.TC_BC7)
# Over the skin's atlas, which does not repeat.
ATLAS = dict(DATA, address_x=unreal.TextureAddress.TA_CLAMP, address_y=unreal.TextureAddress.TA_CLAMP)
# Read at their full size alone: numbers of more than 8 bits, and what would be mixed across the atlas's gaps.
FLOATS = dermis_skin.TABLE_SETTINGS
FINE = dict(ATLAS, compression_settings=unreal.TextureCompressionSettings.TC_HDR)
FULL = dict(ATLAS, mip_gen_settings=unreal.TextureMipGenSettings.TMGS_NO_MIPMAPS)

NODE = """if (SkinHasNoTable(SkinTable)) return SkinSignOfNoTable(Parameters.SvPosition.xy);
SkinHeadPlace p = SkinHeadAt(LocalPosition, Normal, CameraVector, Tangent, AxisX, AxisY, AxisZ, UV, Atlas);
p.scattering = Scattering;
p.curvature_gain = CurvatureGain;
p.penumbra_mm = PenumbraMm;
p.strength = NormalStrength;
p.has_normal_map = HasNormalMap;
p.object_space_normals = ObjectSpaceNormals;
p.baked_normals = HasBakedNormals;
float4 Bends = VertexBends.SampleLevel(VertexBendsSampler, Atlas, 0);
SkinHeadSurface s = SkinHeadStart(p, SkinHeadNormal(p, NormalMap, NormalMapSampler), Bends);
SkinHeadReadNormals(s, p, NormalsRed, NormalsRedSampler, NormalsGreen, NormalsSpread);
SkinSetMaterial(s, Albedo * AlbedoMap.Sample(AlbedoMapSampler, UV).rgb, SurfaceMap.Sample(SurfaceMapSampler, UV).rgb, Roughness, F0,
    Bends.a, VertexOcclusion.Sample(VertexOcclusionSampler, Atlas).rgb, Bends.r, CurvedGain,
    ThicknessMap.Sample(ThicknessMapSampler, Atlas).g * ThicknessMaxMm);
float3 Terms[9] = { Ambient0, Ambient1, Ambient2, Ambient3, Ambient4, Ambient5, Ambient6, Ambient7, Ambient8 };
float3 Radiance = SkinHeadAmbient(s, Terms);
if (ReflectionLevels > 0.5) Radiance += SkinHeadReflected(s, ReflectedShares, ReflectedSharesSampler, Reflections, ReflectionsSampler,
    ReflectionLevels);
"""
# For each light; {0} is its number.
NODE_SHADOW = """SkinShadowLight Shadow{0}Light = {{ Shadow{0}X, Shadow{0}Y, Shadow{0}ToLight, Shadow{0}CenterMm, Shadow{0}RadiusMm,
    Shadow{0}InverseDistancePerMm }};
"""
NODE_LIGHT = NODE_SHADOW + """Radiance += SkinHeadLit(SkinTable, SkinTableSampler, s, p, Light{0}Direction, Light{0}Color, Shadow{0},
    Shadow{0}Light);
"""
NODE_NEAR_LIGHT = NODE_SHADOW + """Radiance += SkinHeadLitNear(SkinTable, SkinTableSampler, s, p, Light{0}Position, Light{0}Direction,
    Light{0}CosInner, Light{0}CosOuter, Light{0}Color, Shadow{0}, Shadow{0}Light);
"""


def direction(numbers):
    return unreal.Vector(numbers[0], numbers[2], numbers[1])


def centimetres(lengths_mm):
    return direction([length / 10 for length in lengths_mm])


def colour(numbers, factor=1.0):
    return unreal.LinearColor(numbers[0] * factor, numbers[1] * factor, numbers[2] * factor, 1.0)


# Of this build, by their files: several materials have the same.
textures = {}


def texture(file, settings):
    """A map of the head; white where it has none."""
    if not file:
        return unreal.EditorAssetLibrary.load_asset(WHITE)
    if file not in textures:
        name = "T_" + os.path.splitext(file)[0]
        textures[file] = dermis_skin.import_texture(os.path.join("Head", file), FOLDER, name, settings)
    return textures[file]


def skin_maps(scene, surface):
    """By the node's inputs: the texture, and whether it is a colour."""
    maps, normals = surface.get("maps", {}), scene.get("baked_normals", [None, None, None])
    files = {
        "AlbedoMap": (maps.get("albedo"), COLOUR),
        "NormalMap": (maps.get("normal"), DATA),
        "SurfaceMap": (maps.get("surface"), DATA),
        "NormalsRed": (normals[0], FINE),
        "NormalsGreen": (normals[1], ATLAS),
        "NormalsSpread": (normals[2], ATLAS),
        "ThicknessMap": (scene.get("thickness", {}).get("file"), ATLAS),
        "VertexBends": (scene["vertex_maps"]["bends"], FLOATS),
        "VertexOcclusion": (scene["vertex_maps"]["occlusion"], FULL),
        "ReflectedShares": ("reflected_shares.exr", FLOATS),
        "Reflections": (reflections(scene).get("file"), FLOATS),
    }
    for i, lamp in enumerate(scene["lights"]):
        files["Shadow%d" % i] = (lamp.get("shadow", {}).get("file"), FLOATS)
    made = {name: (texture(file, settings), not file or settings is COLOUR) for name, (file, settings) in files.items()}
    made["SkinTable"] = (unreal.EditorAssetLibrary.load_asset(dermis_skin.TABLE), False)
    return made


def reflections(scene):
    return (scene.get("environment") or {}).get("reflections", {})


def skin_numbers(scene, surface):
    maps = surface.get("maps", {})
    numbers = {
        "Scattering": 1.0,
        "CurvedGain": 1.0,
        "CurvatureGain": 1.0,
        "PenumbraMm": scene["penumbra_mm"],
        "Roughness": surface["roughness"],
        "F0": surface["f0"],
        "NormalStrength": surface["normal_scale"],
        "HasNormalMap": 1.0 if maps.get("normal") else 0.0,
        "ObjectSpaceNormals": 1.0 if surface["object_space_normals"] else 0.0,
        "HasBakedNormals": 1.0 if scene.get("baked_normals") else 0.0,
        "ReflectionLevels": float(reflections(scene).get("levels", 0)),
        "ThicknessMaxMm": scene["thickness"]["max_mm"] if scene.get("thickness") else 1000.0,
    }
    for i, lamp in enumerate(scene["lights"]):
        shadow = lamp.get("shadow", {})
        numbers["Shadow%dRadiusMm" % i] = shadow.get("radius_mm", 1.0)
        numbers["Shadow%dInverseDistancePerMm" % i] = shadow.get("inverse_distance_per_mm", 0.0)
        if lamp["kind"] == "directional":
            continue
        # A point light shines in all directions.
        is_spot = lamp["kind"] == "spot"
        numbers["Light%dCosInner" % i] = math.cos(lamp["inner_angle_rad"]) if is_spot else -2.0
        numbers["Light%dCosOuter" % i] = math.cos(lamp["outer_angle_rad"]) if is_spot else -3.0
    return numbers


def skin_colours(scene, surface):
    """Directions of lights are Unreal's; what is of a shadow's map is in the space of the file."""
    sky = scene.get("environment") or {}
    colours = {"Albedo": colour(surface["albedo_linear"])}
    for i in range(9):
        colours["Ambient%d" % i] = colour(sky["ambient_terms"][i] if sky else [0.0, 0.0, 0.0])
    for i, lamp in enumerate(scene["lights"]):
        to_light = direction(lamp["to_light"])
        colours["Light%dDirection" % i] = colour([to_light.x, to_light.y, to_light.z])
        colours["Light%dColor" % i] = colour(lamp["color_linear"], lamp["intensity"] / math.pi)
        shadow = lamp.get("shadow", {})
        for name, key in (("X", "x"), ("Y", "y"), ("ToLight", "to_light"), ("CenterMm", "center_mm")):
            colours["Shadow%d%s" % (i, name)] = colour(shadow.get(key, [0.0, 0.0, 0.0]))
    return colours


def add(material, kind, row, **properties):
    return dermis_skin.add(material, kind, -900 - 300 * (row % 4), 100 * row, **properties)


def in_object(material, position, row):
    """A place of the world in the space of the object."""
    local = add(material, unreal.MaterialExpressionTransformPosition, row,
                transform_source_type=unreal.MaterialPositionTransformSource.TRANSFORMPOSSOURCE_WORLD,
                transform_type=unreal.MaterialPositionTransformSource.TRANSFORMPOSSOURCE_LOCAL)
    unreal.MaterialEditingLibrary.connect_material_expressions(position, "", local, "")
    return local


def skin_geometry(material):
    """What the node gets of the pixel."""
    position = add(material, unreal.MaterialExpressionWorldPosition, 1)
    inputs = {
        "LocalPosition": in_object(material, position, 0),
        "Normal": add(material, unreal.MaterialExpressionVertexNormalWS, 4),
        "Tangent": add(material, unreal.MaterialExpressionVertexTangentWS, 8),
        "CameraVector": add(material, unreal.MaterialExpressionCameraVectorWS, 12),
        "UV": add(material, unreal.MaterialExpressionTextureCoordinate, 16, coordinate_index=0),
        "Atlas": add(material, unreal.MaterialExpressionTextureCoordinate, 20, coordinate_index=1),
    }
    for i, name in enumerate(["AxisX", "AxisY", "AxisZ"]):
        axis = add(material, unreal.MaterialExpressionConstant3Vector, 25 + 4 * i,
                   constant=colour([float(i == k) for k in range(3)]))
        inputs[name] = add(material, unreal.MaterialExpressionTransform, 24 + 4 * i,
                           transform_source_type=unreal.MaterialVectorCoordTransformSource.TRANSFORMSOURCE_WORLD,
                           transform_type=unreal.MaterialVectorCoordTransform.TRANSFORM_LOCAL)
        unreal.MaterialEditingLibrary.connect_material_expressions(axis, "", inputs[name], "")
    return inputs


def light_positions(material, scene):
    """Of point and spot lights, in the space of the object."""
    inputs = {}
    for i, lamp in enumerate(scene["lights"]):
        if lamp["kind"] == "directional":
            continue
        name, at = "Light%dPosition" % i, centimetres(lamp["position_mm"])
        position = add(material, unreal.MaterialExpressionVectorParameter, 41 + 4 * i, parameter_name=name,
                       default_value=colour([at.x, at.y, at.z]))
        inputs[name] = in_object(material, position, 40 + 4 * i)
    return inputs


def make_skin(name, scene, surface):
    if unreal.EditorAssetLibrary.does_asset_exist(FOLDER + "/" + name):
        unreal.EditorAssetLibrary.delete_asset(FOLDER + "/" + name)
    material = dermis_skin.create_material(FOLDER, name)
    inputs = skin_geometry(material)
    inputs.update(light_positions(material, scene))
    for key, (asset, is_colour) in skin_maps(scene, surface).items():
        inputs[key] = add(material, unreal.MaterialExpressionTextureObjectParameter, len(inputs) + 30, parameter_name=key, texture=asset,
                          sampler_type=unreal.MaterialSamplerType.SAMPLERTYPE_COLOR if is_colour
                          else unreal.MaterialSamplerType.SAMPLERTYPE_LINEAR_COLOR)
    for key, value in skin_numbers(scene, surface).items():
        inputs[key] = add(material, unreal.MaterialExpressionScalarParameter, len(inputs) + 30, parameter_name=key, default_value=value)
    for key, value in skin_colours(scene, surface).items():
        inputs[key] = add(material, unreal.MaterialExpressionVectorParameter, len(inputs) + 30, parameter_name=key, default_value=value)
    lights = [(NODE_LIGHT if lamp["kind"] == "directional" else NODE_NEAR_LIGHT).format(i) for i, lamp in enumerate(scene["lights"])]
    code = NODE + "".join(lights) + "return Radiance;"
    node = dermis_skin.add(material, unreal.MaterialExpressionCustom, -400, 200, description="Skin of the head",
                           output_type=unreal.CustomMaterialOutputType.CMOT_FLOAT3,
                           include_file_paths=["/Plugin/DermisSkin/SkinHead.ush"],
                           inputs=[dermis_skin.custom_input(key) for key in inputs], code=code)
    dermis_skin.finish(material, node, inputs)
    return material


def import_mesh(item):
    """As the file has it: no normals, tangents or texture coordinates of the engine's own, and no simplification."""
    name = os.path.splitext(item["file"])[0]
    assets = dermis_skin.import_file(os.path.join("Head", item["file"]), FOLDER, "SM_" + name)
    meshes = [asset for asset in assets if isinstance(asset, unreal.StaticMesh)]
    if len(meshes) != 1:
        raise RuntimeError("dermis_head: %s became %d static meshes, not one" % (item["file"], len(meshes)))
    editor = unreal.get_editor_subsystem(unreal.StaticMeshEditorSubsystem)
    build = editor.get_lod_build_settings(meshes[0], 0)
    for key in ("recompute_normals", "recompute_tangents", "generate_lightmap_u_vs", "remove_degenerates"):
        build.set_editor_property(key, False)
    for key in ("use_full_precision_u_vs", "use_high_precision_tangent_basis"):
        build.set_editor_property(key, True)
    editor.set_lod_build_settings(meshes[0], 0, build)
    nanite = editor.get_nanite_settings(meshes[0])
    nanite.set_editor_property("enabled", False)
    editor.set_nanite_settings(meshes[0], nanite, True)
    check_axes(item, meshes[0].get_bounding_box())
    return meshes[0]


def check_axes(item, box):
    low, high = (centimetres(corner) for corner in item["box_mm"])
    for found, expected in ((box.min, low), (box.max, high)):
        if max(abs(found.x - expected.x), abs(found.y - expected.y), abs(found.z - expected.z)) > 0.1:
            raise RuntimeError("dermis_head: this version's importer of glTF turned or scaled %s; its box ends at %s, not at %s" %
                               (item["file"], found, expected))


def place(item, index, scene, actors):
    mesh = import_mesh(item)
    surfaces = {surface["name"]: (i, surface) for i, surface in enumerate(item["materials"])}
    for slot, material in enumerate(mesh.get_editor_property("static_materials")):
        found = surfaces.get(str(material.get_editor_property("material_slot_name")))
        if found is None:
            raise RuntimeError("dermis_head: %s has a material that scene.json does not name; export the package again" % item["file"])
        if found[1]["class"] == "skin":
            mesh.set_material(slot, make_skin("M_Head_%d_%d" % (index, found[0]), scene, found[1]))
    unreal.EditorAssetLibrary.save_loaded_asset(mesh)
    named(actors.spawn_actor_from_object(mesh, unreal.Vector(0.0, 0.0, 0.0)), item["name"])


def named(actor, label):
    actor.set_actor_label(label)
    actor.set_editor_property("tags", [TAG])
    return actor


def add_light(lamp, actors):
    """Unreal's own light, for what is not skin."""
    x, y, z = (-number for number in lamp["to_light"])
    rotation = unreal.MathLibrary.make_rot_from_x(direction([x, y, z]))
    kind = {"directional": unreal.DirectionalLight, "point": unreal.PointLight, "spot": unreal.SpotLight}[lamp["kind"]]
    actor = named(actors.spawn_actor_from_class(kind, centimetres(lamp.get("position_mm", [0.0, 0.0, 0.0])), rotation), lamp["name"])
    light = actor.get_editor_property("light_component")
    if lamp["kind"] != "directional":  # candelas are the lux at a metre
        light.set_editor_property("intensity_units", unreal.LightUnits.CANDELAS)
        light.set_editor_property("attenuation_radius", 10000.0)
    if lamp["kind"] == "spot":
        light.set_editor_property("inner_cone_angle", math.degrees(lamp["inner_angle_rad"]))
        light.set_editor_property("outer_cone_angle", math.degrees(lamp["outer_angle_rad"]))
    light.set_editor_property("intensity", lamp["intensity"])
    light.set_light_color(colour(lamp["color_linear"]))
    light.set_editor_property("cast_shadows", lamp["casts_shadow"])


def add_camera(view, exposure, actors):
    """Seen through it, a picture is as high as the view of `dermis render`. The exposure is fixed."""
    eye, target = centimetres(view["eye_mm"]), centimetres(view["target_mm"])
    rotation = unreal.MathLibrary.make_rot_from_xz(target - eye, direction(view["up"]))
    actor = named(actors.spawn_actor_from_class(unreal.CameraActor, eye, rotation), "Camera")
    camera = actor.get_editor_property("camera_component")
    aspect = 16.0 / 9.0
    across = 2.0 * math.atan(aspect * math.tan(0.5 * view["vertical_fov_rad"]))
    camera.set_editor_property("aspect_ratio", aspect)
    camera.set_editor_property("constrain_aspect_ratio", True)
    camera.set_editor_property("field_of_view", math.degrees(across))
    look = camera.get_editor_property("post_process_settings")
    for key, value in (("auto_exposure_method", unreal.AutoExposureMethod.AEM_MANUAL),
                       ("auto_exposure_apply_physical_camera_exposure", False), ("auto_exposure_bias", math.log2(exposure))):
        look.set_editor_property("override_" + key, True)
        look.set_editor_property(key, value)
    camera.set_editor_property("post_process_settings", look)


def build():
    path = os.path.join(dermis_skin.PLUGIN, "Head", "scene.json")
    if not os.path.exists(path):
        raise RuntimeError("dermis_head: the package has no head; export it with a scene: dermis export --engine unreal SCENE")
    with open(path, encoding="utf-8") as file:
        scene = json.load(file)
    dermis_skin.install()
    textures.clear()
    actors = unreal.get_editor_subsystem(unreal.EditorActorSubsystem)
    for actor in actors.get_all_level_actors():
        if actor.actor_has_tag(TAG):
            actors.destroy_actor(actor)
    for index, item in enumerate(scene["objects"]):
        place(item, index, scene, actors)
    for lamp in scene["lights"]:
        add_light(lamp, actors)
    add_camera(scene["camera"], scene["exposure"], actors)
    unreal.log("dermis_head: '%s' is in the level" % scene["name"])
