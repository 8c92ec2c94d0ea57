"""Random walks of Dermis against those of Cycles, another program: the same mesh, skin, light and camera. Needs Blender.

    PYTHONPATH=build/python DERMIS_PROGRAM=build/dermis DERMIS_BUILD=build python3 tests/python/cycles_test.py

Prints rows of docs/figures.md. CYCLES_REPORT=FOLDER keeps the effects as arrays.
"""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tomllib
import unittest

import numpy

import dermis
from support import ROOT, TestCase

BLENDER = shutil.which("blender")
if BLENDER is None:
    print("skipped: blender is not installed (Debian: apt-get install --no-install-recommends blender)")
    sys.exit(77)

SIZE, SEEDS = 96, (1, 2)
CYCLES_SAMPLES, DERMIS_SAMPLES, WALKS = 400, 16, 16  # a seed; WALKS for each of Dermis' samples
SMALL = .02  # the factor on the lengths of skin whose scattering is not seen
SKIN = "openpbr_skin_3"
LEAST_CORRELATION, LEAST_SHARE = .95, .8

SCENE = """
[[mesh]]
file = "head.obj"
default_class = "skin"
[skin]
profile = "{skin}"
[environment]
kind = "none"
[[light]]
key = true
intensity = {irradiance}
yaw_deg = {light[yaw_deg]}
pitch_deg = {light[pitch_deg]}
[camera]
target_mm = {camera[target_mm]}
yaw_deg = {camera[yaw_deg]}
pitch_deg = {camera[pitch_deg]}
distance_mm = {camera[distance_mm]}
fov_deg = {camera[fov_deg]}
"""


def direction(placed):
    yaw, pitch = math.radians(placed["yaw_deg"]), math.radians(placed["pitch_deg"])
    return numpy.array((math.sin(yaw) * math.cos(pitch), math.sin(pitch), math.cos(yaw) * math.cos(pitch)))


def cycles_medium(albedo, radius_mm):
    """The volume of Cycles' random walk with a fixed radius, from its node's colour and radius (with its scale).

    The mean free path is the radius over 4 pi. The single-scattering albedo is the fit of Wrenninge, Villemin and Hery
    2017 (Pixar technical memo 17-07) to walks in an index-matched half-space, here for isotropic scattering.
    """
    albedo, sigma_t = numpy.array(albedo), 4 * math.pi / numpy.array(radius_mm)
    low = 1.8260523782 * numpy.arctan(4.98511194385 * albedo)**1.09686102424
    high = .496310210422 * numpy.arctan(4.23190299701 * albedo)**2.40602999408
    single = low + albedo**.25 * (high - low)
    return {"sigma_s": single * sigma_t, "sigma_a": (1 - single) * sigma_t, "g": 0, "eta": 1}


class Agreement:
    """Of two effects in two independent halves each, half x pixel x channel: products of halves have no noise."""

    def __init__(self, cycles, ours):
        product = lambda a, b: (a[0] * b[1] + a[1] * b[0]).mean(0) / 2
        both = lambda a, b: (a.mean(0) * b.mean(0)).mean(0)
        self.pixels = cycles.shape[1]
        self.cycles_rms, self.rms = (numpy.sqrt(product(a, a)) for a in (cycles, ours))
        missed = numpy.maximum(product(ours - cycles, ours - cycles), 0)  # below 0 where noise alone is left
        self.share = 1 - numpy.sqrt(missed) / self.cycles_rms
        cycles, ours = (a - a.mean(1, keepdims=True) for a in (cycles, ours))
        self.correlation = both(cycles, ours) / numpy.sqrt(product(cycles, cycles) * product(ours, ours))


class Cycles(TestCase):
    def test_bust(self):
        self.compare("bust")

    def test_head_scan(self):
        if not (pathlib.Path(os.environ.get("DERMIS_ASSETS", "")) / "lee_perry_smith/head_quads.obj").exists():
            self.skipTest("the head scan is not here: tools/get_head")
        self.compare("head_scan")

    def compare(self, name):
        scene = tomllib.loads((ROOT / f"scenes/{name}.toml").read_text())
        mesh, = dermis.scene_meshes(name)
        mesh.save(self.folder / "head.obj")
        text = SCENE.format(skin=SKIN, irradiance=math.pi, light=scene["light"][0], camera=scene["camera"])
        (self.folder / "head.toml").write_text(text)
        numpy.savez(self.folder / "scene.npz", positions_mm=mesh.positions_mm, normals=mesh.normals, indices=mesh.indices)
        tool, = dermis.convert(SKIN, to="blender_random_walk")["settings"]
        albedo, ratios, (scale_m,) = (numpy.atleast_1d(entry["value"]) for entry in tool["values"].values())
        radius_mm = 1000 * scale_m * ratios
        cycles = self.cycles_effect(scene, albedo, radius_mm)
        ours = self.effect(cycles_medium(albedo, radius_mm))
        self.judge(name, cycles, ours)

    def cycles_effect(self, scene, albedo, radius_mm):
        camera, target_mm = scene["camera"], numpy.array(scene["camera"]["target_mm"])
        pictures = {f"{seed}_{factor}.exr": (seed, factor) for seed in SEEDS for factor in (1, SMALL)}
        given = {"albedo": list(albedo), "radius_mm": list(radius_mm), "fov_deg": camera["fov_deg"],
                 "eye_mm": list(target_mm + camera["distance_mm"] * direction(camera)), "target_mm": list(target_mm),
                 "to_light": list(direction(scene["light"][0])), "irradiance": math.pi, "size": SIZE,
                 "samples": CYCLES_SAMPLES, "pictures": pictures}
        (self.folder / "scene.json").write_text(json.dumps(given, default=float))
        script = pathlib.Path(__file__).with_name("cycles_scene.py")
        run = subprocess.run([BLENDER, "-b", "--factory-startup", "--python-exit-code", "1", "--python", script, "--",
                              self.folder], capture_output=True, text=True)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)
        picture = lambda seed, factor: dermis.read_image(self.folder / f"{seed}_{factor}.exr")[..., :3]
        return numpy.array([picture(seed, 1) - picture(seed, SMALL) for seed in SEEDS])

    def effect(self, medium):
        def picture(seed, factor):
            return dermis.reference(self.folder / "head.toml", size=SIZE, integrator="walk", medium=medium, seed=seed,
                                    width_scale=factor, samples=DERMIS_SAMPLES, probes=WALKS, penumbra_mm=0,
                                    specular="none", cavities="open").diffuse
        return numpy.array([picture(seed, 1) - picture(seed, SMALL) for seed in SEEDS])

    def judge(self, name, cycles, ours):
        # For its regions; of its cheapest reference.
        compared = dermis.compare(self.folder / "head.toml", "lambert", size=SIZE, samples_per_pixel=4, samples=8, noise=1,
                                  integrator="surface", timed_frames=1)
        skin = compared.skin == 1
        parts = {"skin": skin, **{part: (inside > 0) & skin for part, inside in compared.regions.items()}}
        found = {part: Agreement(cycles[:, inside], ours[:, inside]) for part, inside in parts.items() if inside.any()}
        self.report(name, cycles, ours, skin, found)
        self.assertGreater(found["skin"].correlation.min(), LEAST_CORRELATION)
        self.assertGreater(found["skin"].share.min(), LEAST_SHARE)

    def report(self, name, cycles, ours, skin, found):
        row = lambda values, digits: ", ".join(f"{value:.{digits}f}" for value in values)
        for part, at in found.items():
            print(f"| `{name}`, {part} | {at.pixels} | {row(at.cycles_rms, 4)} | {row(at.rms, 4)} | "
                  f"{row(at.correlation, 3)} | {row(at.share, 2)} |")
        if "CYCLES_REPORT" in os.environ:
            numpy.savez(pathlib.Path(os.environ["CYCLES_REPORT"]) / f"{name}.npz", cycles=cycles, ours=ours, skin=skin)


if __name__ == "__main__":
    unittest.main()
