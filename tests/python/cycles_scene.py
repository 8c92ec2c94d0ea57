"""Run by Blender: pictures of one mesh of skin by Cycles' random walk. Blender 3.4 and later.

    blender -b --factory-startup --python-exit-code 1 --python cycles_scene.py -- FOLDER

FOLDER/scene.npz has positions_mm, normals, indices; FOLDER/scene.json the numbers below and `pictures`: for the name of
each file a seed and a factor on the skin's lengths. Axes are Dermis' (Y up), a unit of Blender is a millimetre.
"""
import json
import math
import pathlib
import sys

import bpy
import mathutils
import numpy


def skin_material(albedo, radius_mm):
    """The node of subsurface scattering alone; returns it too, as its scale changes."""
    material = bpy.data.materials.new("skin")
    material.use_nodes = True
    nodes = material.node_tree.nodes
    nodes.clear()
    skin = nodes.new("ShaderNodeSubsurfaceScattering")
    # The walk whose radius does not depend on the albedo, by its name since 4.0 or before.
    names = skin.bl_rna.properties["falloff"].enum_items.keys()
    skin.falloff = "RANDOM_WALK" if "RANDOM_WALK_SKIN" in names else "RANDOM_WALK_FIXED_RADIUS"
    skin.inputs["Color"].default_value = (*albedo, 1)
    skin.inputs["Radius"].default_value = radius_mm
    skin.inputs["Anisotropy"].default_value = 0
    output = nodes.new("ShaderNodeOutputMaterial")
    material.node_tree.links.new(skin.outputs[0], output.inputs["Surface"])
    return material, skin


def add_mesh(arrays, material):
    mesh = bpy.data.meshes.new("skin")
    mesh.from_pydata(arrays["positions_mm"].tolist(), [], arrays["indices"].tolist())
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    if hasattr(mesh, "use_auto_smooth"):  # until 4.0: without it, normals of one's own are not read
        mesh.use_auto_smooth = True
    mesh.normals_split_custom_set_from_vertices(arrays["normals"].tolist())
    mesh.materials.append(material)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("skin", mesh))


def looking(backward, up=(0, 1, 0)):
    """A rotation whose third axis is `backward`: cameras and lights look against theirs."""
    z = mathutils.Vector(backward).normalized()
    x = mathutils.Vector(up).cross(z).normalized()
    return mathutils.Matrix((x, z.cross(x), z)).transposed().to_4x4()


def add_camera(eye_mm, target_mm, vertical_fov_rad):
    camera = bpy.data.cameras.new("camera")
    camera.sensor_fit = "VERTICAL"
    camera.angle_y = vertical_fov_rad
    camera.clip_end = 1e5
    placed = bpy.data.objects.new("camera", camera)
    offset = mathutils.Vector(eye_mm) - mathutils.Vector(target_mm)
    placed.matrix_world = mathutils.Matrix.Translation(eye_mm) @ looking(offset)
    bpy.context.scene.collection.objects.link(placed)
    bpy.context.scene.camera = placed


def add_sun(to_light, irradiance):
    sun = bpy.data.lights.new("sun", "SUN")
    sun.energy = irradiance
    sun.angle = 0
    placed = bpy.data.objects.new("sun", sun)
    placed.matrix_world = looking(to_light)
    bpy.context.scene.collection.objects.link(placed)


def set_up(scene, size, samples):
    scene.render.engine = "CYCLES"
    scene.render.resolution_x = scene.render.resolution_y = size
    scene.render.resolution_percentage = 100
    scene.render.film_transparent = True
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.world = bpy.data.worlds.new("dark")
    scene.world.color = (0, 0, 0)
    cycles = scene.cycles
    cycles.device = "CPU"
    cycles.samples = samples
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type = "BOX"
    cycles.filter_width = 1
    # All light of the walks and none that one place of the skin throws on another.
    cycles.max_bounces = cycles.diffuse_bounces = 0
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.light_sampling_threshold = 0


def main():
    folder = pathlib.Path(sys.argv[sys.argv.index("--") + 1])
    given = json.loads((folder / "scene.json").read_text())
    bpy.ops.wm.read_factory_settings(use_empty=True)
    material, skin = skin_material(given["albedo"], given["radius_mm"])
    add_mesh(numpy.load(folder / "scene.npz"), material)
    add_camera(given["eye_mm"], given["target_mm"], math.radians(given["fov_deg"]))
    add_sun(given["to_light"], given["irradiance"])
    scene = bpy.context.scene
    set_up(scene, given["size"], given["samples"])
    for name, (seed, factor) in given["pictures"].items():
        scene.cycles.seed = seed
        skin.inputs["Scale"].default_value = factor
        scene.render.filepath = str(folder / name)
        bpy.ops.render.render(write_still=True)


main()
