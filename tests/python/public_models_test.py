"""Models that others published: each is read right, with a warning for what is left out, or refused in one line.

DERMIS_MODELS=FOLDER reads those below FOLDER in place of Debian's assimp-testmodels.
"""

import json
import os
import pathlib
import sys
import unittest

import numpy

from support import ROOT, TestCase, run_program

sys.path.insert(0, str(ROOT / "tests/mesh"))
import gltf_pose

FOLDER = pathlib.Path(os.environ.get("DERMIS_MODELS", "/usr/share/assimp/models"))
if not FOLDER.is_dir():
    print(f"skipped: no models in {FOLDER} (Debian: apt-get install assimp-testmodels)")
    sys.exit(77)

TRIANGLES = 4, 5, 6  # modes of a primitive: a list, a strip, a fan
READ_EXTENSIONS = {"KHR_mesh_quantization", "KHR_texture_transform", *("KHR_materials_" + name for name in (
    "diffuse_transmission", "emissive_strength", "ior", "scatter", "specular", "volume", "volume_scatter"))}


def files(*endings):
    return sorted(path for path in FOLDER.rglob("*") if path.suffix in endings)


def box_mm(file):
    """Least and greatest corner of the triangles, by the specification."""
    points = []
    for primitive, positions in gltf_pose.posed(file):
        if primitive.get("mode", 4) not in TRIANGLES:
            continue
        used = {i for (i,) in file.accessor(primitive["indices"])} if "indices" in primitive else range(len(positions))
        points += [positions[i] for i in used]
    return 1000 * numpy.min(points, axis=0), 1000 * numpy.max(points, axis=0)


class PublicModels(TestCase):
    def read(self, path):
        """What `dermis info` says of it; None of a file that it refuses in one line."""
        result = run_program("info", path, "--unit-mm", 1000, "--json", timeout=120)
        if result.returncode == 0:
            return json.loads(result.stdout)
        self.assertEqual(result.returncode, 1, f"{path}: {result.stderr}")
        self.assertRegex(result.stderr, r"\Adermis: [^\n]+\n\Z", path)
        return None

    def check_gltf(self, path, info):
        file = gltf_pose.File(path)
        low, high = box_mm(file)
        size = (high - low).max()
        numpy.testing.assert_allclose(info["low_mm"], low, atol=1e-6 * size, err_msg=path)
        numpy.testing.assert_allclose(info["high_mm"], high, atol=1e-6 * size, err_msg=path)
        warnings = "\n".join(info["warnings"])
        named = set(file.json.get("extensionsUsed", [])) - READ_EXTENSIONS
        named |= {"cameras"} & file.json.keys()
        for feature in named:
            self.assertIn(feature, warnings, path)
        self.assertEqual(len(info.get("motion", {}).get("clips", [])), len(file.json.get("animations", [])), path)

    def test_gltf_is_read_as_specified_or_refused(self):
        read = [(path, info) for path in files(".gltf", ".glb") if (info := self.read(path))]
        for path, info in read:
            self.check_gltf(path, info)
        print(f"{len(read)} of {len(files('.gltf', '.glb'))} glTF files read, the others refused")
        self.assertEqual(bool(read), bool(files(".gltf", ".glb")))

    def test_obj_is_read_or_refused(self):
        read = [path for path in files(".obj") if self.read(path)]
        print(f"{len(read)} of {len(files('.obj'))} OBJ files read, the others refused")
        self.assertEqual(bool(read), bool(files(".obj")))


if __name__ == "__main__":
    unittest.main()
