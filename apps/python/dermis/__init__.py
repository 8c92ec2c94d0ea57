"""Human skin in real time: profiles, tables, meshes, pictures, reference and comparison.

Lengths are millimetres and names say so (width_mm, curvature_per_mm). Light is linear, red, green, blue with the
primaries of sRGB. Pictures are float32 arrays of height x width x 3, rows from the top.

Errors are dermis.Error, with the sentence that the command line `dermis` prints. Work that takes long releases
Python's lock, ends with Ctrl-C, and calls `progress` with the share that is done, 0 to 1.
"""

from dermis._dermis import Error
from dermis._dermis import version as _version
from dermis._exports import Exported, export
from dermis._judge import (ClipComparison, Comparison, ciede2000, compare, flip, flip_map, max_abs_error, psnr_db, rel_mse,
                           rmse, ssim)
from dermis._meshes import (Map, Mesh, NormalMaps, bake_curvature, bake_gain, bake_kernel_size, bake_normals, bake_occlusion,
                            bake_stretch, bake_thickness, load_mesh, scene_meshes)
from dermis._pictures import (Picture, ReferencePicture, parameters, read_image, reference, render, scene_names,
                              subject_names, technique_names)
from dermis._profiles import (GaussianFit, Profile, burley_profile, convert, gaussian_profile, profile, profile_names,
                              skin_profile, table_profile)
from dermis._tables import (ClosedForm, Table, bake_closed_form, bake_lut, bake_shadow, bake_zh, read_table)

__version__ = _version().split()[-1]
__all__ = [
    "ClipComparison", "ClosedForm", "Comparison", "Error", "Exported", "GaussianFit", "Map", "Mesh", "NormalMaps", "Picture", "Profile",
    "ReferencePicture", "Table", "bake_closed_form", "bake_curvature", "bake_gain", "bake_kernel_size", "bake_lut", "bake_normals",
    "bake_occlusion", "bake_shadow", "bake_stretch", "bake_thickness", "bake_zh", "burley_profile", "ciede2000", "compare", "convert", "export", "flip",
    "flip_map", "gaussian_profile", "load_mesh", "max_abs_error", "parameters", "profile", "profile_names",
    "psnr_db", "read_image", "read_table", "reference", "rel_mse", "render", "rmse", "scene_meshes", "scene_names",
    "skin_profile", "ssim", "subject_names", "table_profile", "technique_names",
]
