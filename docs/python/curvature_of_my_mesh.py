"""Curvature and thickness of a mesh of one's own, as maps for a technique and as plots.

    ./run python docs/python/curvature_of_my_mesh.py               # the bust; writes out/curvature.exr, out/curvature.png
    ./run python docs/python/curvature_of_my_mesh.py head.obj 10   # a file in cm: one unit is 10 mm
"""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

import dermis

OUT = pathlib.Path("out")


def main(path=None, unit_mm=None, size=512):
    OUT.mkdir(exist_ok=True)
    mesh = dermis.load_mesh(path, unit_mm) if path else dermis.scene_meshes("builtin:bust")[0]
    for warning in mesh.warnings:
        print("warning:", warning)
    curvature = dermis.bake_curvature(mesh, size=size, smoothing_mm=1.8)
    curvature.save(OUT / "curvature.exr")
    thickness = dermis.bake_thickness(mesh, size=size, rays=16, ray_size=256, max_mm=200)

    figure, (map_axes, thick_axes, points, bars) = plt.subplots(1, 4, figsize=(14, 3.8), layout="constrained")
    outside = curvature.coverage == 0
    shown = map_axes.imshow(numpy.ma.array(curvature.values, mask=outside), cmap="coolwarm", vmin=-0.2, vmax=0.2)
    figure.colorbar(shown, ax=map_axes, label="1/mm, positive where convex", shrink=0.7)
    map_axes.set_title("curvature over the UV atlas")
    shown = thick_axes.imshow(numpy.ma.array(thickness.values, mask=outside), cmap="magma", vmin=0, vmax=200)
    figure.colorbar(shown, ax=thick_axes, label="mm", shrink=0.7)
    thick_axes.set_title("thickness")

    # The same at the vertices, seen from the front; the nearest are drawn last.
    values = mesh.curvature(smoothing_mm=1.8)
    x_mm, y_mm, z_mm = mesh.positions_mm.T
    order = numpy.argsort(z_mm)
    points.scatter(x_mm[order], y_mm[order], c=values[order], s=0.4, cmap="coolwarm", vmin=-0.2, vmax=0.2)
    points.set(title="at the vertices", xlabel="x in mm", aspect="equal")
    radius_mm = 1 / numpy.maximum(values, 1e-3)
    bars.hist(radius_mm[radius_mm < 200], bins=numpy.geomspace(1, 200, 40), color="tab:orange")
    bars.set(title="radii of the convex parts", xlabel="mm", xscale="log", ylabel="vertices")
    figure.savefig(OUT / "curvature.png", dpi=80)
    print(mesh, f"curvature {curvature.min:.3f} to {curvature.max:.3f} 1/mm, median thickness "
          f"{numpy.median(thickness.values[~outside]):.1f} mm")


if __name__ == "__main__":
    main(*sys.argv[1:2], *map(float, sys.argv[2:3]))
