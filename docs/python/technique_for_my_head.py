"""Which technique for my head: captured shares of some techniques, with the pictures.

    ./run python docs/python/technique_for_my_head.py              # the bust; writes out/techniques.png
    ./run python docs/python/technique_for_my_head.py head.obj
"""

import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy

import dermis

OUT = pathlib.Path("out")
TECHNIQUES = ("lambert", "wrap", "preintegrated", "screen_space_separable", "texture_space_gaussians")


def shown(radiance):
    """Linear light for matplotlib."""
    return (1.5 * radiance).clip(0, 1)**(1 / 2.2)


def main(scene="bust", size=160):
    OUT.mkdir(exist_ok=True)
    compared = dermis.compare(scene, TECHNIQUES, size=size, samples_per_pixel=16, timed_frames=1,
                              progress=lambda done: print(f"\r{100 * done:.0f} %", end="", file=sys.stderr))
    print(file=sys.stderr)
    rows = [(name, row) for name, row in zip(compared.names, compared.rows) if row["captured"] is not None]
    rows.sort(key=lambda pair: pair[1]["captured"])
    best = rows[-1][0]

    figure, (bars, reference, picture, rest) = plt.subplots(1, 4, figsize=(13, 3.6), layout="constrained",
                                                        width_ratios=(1.5, 1, 1, 1))
    bars.barh([name for name, _ in rows], [row["captured"] for _, row in rows],
              xerr=[row["captured_error"] for _, row in rows], color="tab:orange")
    bars.set(title="captured share of scattering", xlim=(min(0, rows[0][1]["captured"]), 1))
    left = (compared.radiance(best) - compared.reference) * (compared.skin > 0)[..., None]
    limit = max(float(numpy.percentile(abs(left), 99.5)), 1e-6)
    for axes, pixels, title in ((reference, shown(compared.reference), "reference"),
                                (picture, shown(compared.radiance(best)), best),
                                (rest, (0.5 + left / (2 * limit)).clip(0, 1), f"difference, ± {limit:.3f}")):
        axes.imshow(pixels)
        axes.set_title(title)
        axes.axis("off")
    figure.savefig(OUT / "techniques.png", dpi=80)
    for name, row in reversed(rows):
        print(f"{name:28} captured {row['captured']:.2f} ± {row['captured_error']:.2f}, FLIP {row['flip']:.4f}")
    for warning in compared.warnings:
        print("warning:", warning)
    print(compared.credit)


if __name__ == "__main__":
    main(*sys.argv[1:2])
