"""A skin from three numbers to a table: how far red, green and blue scatter, in mm.

    ./run python docs/python/skin_from_three_numbers.py            # writes out/skin.exr, out/skin_table.png
    ./run python docs/python/skin_from_three_numbers.py 1.1 .45 .3
"""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")  # no display is needed
import matplotlib.pyplot as plt
import numpy

import dermis

OUT = pathlib.Path("out")
COLOURS = ("tab:red", "tab:green", "tab:blue")


def main(d_mm=(0.9, 0.4, 0.25)):
    OUT.mkdir(exist_ok=True)
    skin = dermis.burley_profile(d_mm)
    fit = skin.fit(terms=6)
    table = dermis.bake_lut(skin, size=(256, 128))
    table.save(OUT / "skin.exr")
    form = dermis.bake_closed_form(skin, max_curvature=0.5)

    figure, (light, curves, picture) = plt.subplots(1, 3, figsize=(13, 3.8), layout="constrained")
    r_mm = numpy.linspace(0, 8, 200)
    for channel, colour in enumerate(COLOURS):
        light.plot(r_mm, skin.cdf(r_mm)[:, channel], colour)
        light.plot(r_mm, fit.profile.cdf(r_mm)[:, channel], "k:", lw=1)
    light.set(title="Light within r (dotted: fit)", xlabel="r in mm", ylabel="part of the light")

    n_dot_l = numpy.linspace(-1, 1, 201)
    for channel, colour in enumerate(COLOURS):
        curves.plot(n_dot_l, table.lookup(n_dot_l, 1 / 8)[:, channel], colour)
        curves.plot(n_dot_l, form(n_dot_l, 1 / 8)[:, channel], "k:", lw=1)
    curves.plot(n_dot_l, n_dot_l.clip(0), "0.6")
    curves.set(title="Radius 8 mm (dotted: closed form)", xlabel="N.L", ylabel="diffuse light")

    extent = [axis[end] for axis in table.convention["axes"] for end in ("min", "max")]
    picture.imshow(table.values**(1 / 2.2), origin="lower", aspect="auto", extent=extent)
    picture.set(title="The table", xlabel="N.L", ylabel="curvature in 1/mm")
    figure.savefig(OUT / "skin_table.png", dpi=80)
    print(f"{table.description}; closed form within {form.max_error:.4f}")
    hdrp = dermis.convert(skin, to="hdrp")["settings"][0]["values"]
    print("in HDRP:", {name: key["value"] for name, key in hdrp.items()})


if __name__ == "__main__":
    main(tuple(map(float, sys.argv[1:4])) or (0.9, 0.4, 0.25))
