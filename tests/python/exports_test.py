"""Packages, functions and baked normals: the files of the command line, to the byte."""

import pathlib
import unittest

from support import ROOT, TestCase, run_program

import dermis
import numpy

SPHERE = ROOT / "tests/engines/sphere_8mm.toml"


class Exports(TestCase):
    def assert_same_folders(self, first, second):
        names = [sorted(str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_file())
                 for folder in (first, second)]
        self.assertEqual(*names)
        for name in names[0]:
            self.assert_same_bytes(first / name, second / name)

    def test_folders_are_the_command_lines_to_the_byte(self):
        for words, options in (
                (("--engine", "three", SPHERE, "--light", "yaw_deg=10"), {"engine": "three", "scene": SPHERE, "light": {"yaw_deg": 10}}),
                (("--engine", "unity", "--profile", "jensen_skin1"), {"engine": "unity", "profile": "jensen_skin1"}),
                (("--engine", "godot", "--native"), {"engine": "godot", "native": True}),
                (("--language", "all", "--functions", "skin_diffuse"), {"language": "all", "functions": ["skin_diffuse"]})):
            by_command, mine = self.folder / "command", self.folder / "python"
            result = run_program("export", *words, "-o", by_command)
            self.assertEqual(result.returncode, 0, result.stderr)
            made = dermis.export(mine, **options)
            self.assert_same_folders(by_command, mine)
            self.assertEqual(sorted(made.files), sorted(str(path) for path in mine.rglob("*") if path.is_file()))
            for folder in (by_command, mine):
                for path in sorted(folder.rglob("*"), reverse=True):
                    path.unlink() if path.is_file() else path.rmdir()

    def test_errors_are_the_command_lines_and_nothing_is_written(self):
        out = self.folder / "package"
        for words, options in ((("--engine", "godott"), {"engine": "godott"}),
                               ((), {}),
                               (("--engine", "three", "--functions", "skin_diffuse"), {"engine": "three", "functions": "skin_diffuse"}),
                               (("--engine", "three", "--profile", "none.csv"), {"engine": "three", "profile": "none.csv"}),
                               (("none.glb", "--engine", "three"), {"scene": "none.glb", "engine": "three"})):
            self.assert_error(self.program_error("export", *words, "-o", out), dermis.export, out, **options)
            self.assertFalse(out.exists())
        with self.assertRaisesRegex(TypeError, "profile"):
            dermis.export(out, engine="three", profile=3)


class BakedNormals(TestCase):
    def test_files_are_the_command_lines_to_the_byte(self):
        path, mine = self.folder / "a.exr", self.folder / "b.exr"
        result = run_program("bake", "normals", SPHERE, "--size", 64, "-o", path)
        self.assertEqual(result.returncode, 0, result.stderr)
        made = dermis.bake_normals(SPHERE, size=64)
        made.save(mine)
        for channel in ("red", "green"):
            self.assert_same_bytes(self.folder / f"a_{channel}.exr", self.folder / f"b_{channel}.exr")

    def test_means_of_a_sphere_are_shorter_than_its_normals_and_reds_most(self):
        made = dermis.bake_normals(SPHERE, size=64)
        self.assertEqual((made.red.shape, made.green.shape, made.uneven.shape), ((64, 64, 3), (64, 64, 3), (64, 64, 2)))
        red, green = (numpy.linalg.norm(normals, axis=2) for normals in (made.red, made.green))
        skin = red > .5
        self.assertGreater(skin.mean(), .2)
        self.assertLess(red[skin].mean(), green[skin].mean())
        self.assertLess(green[skin].mean(), 1)

    def test_errors_are_the_command_lines(self):
        out = ("-o", self.folder / "x.exr")
        self.assert_error(self.program_error("bake", "normals", "spheres", "--size", 3, *out), dermis.bake_normals, "spheres", size=3)
        self.assert_error(self.program_error("bake", "normals", "spheres", "--unit-mm", 10, *out), dermis.bake_normals, "spheres",
                          unit_mm=10)
        self.assert_error(self.program_error("export", SPHERE, "--engine", "three", "--unit-mm", 0, *out), dermis.export,
                          self.folder / "package", SPHERE, engine="three", unit_mm=0)
        scene = self.folder / "mine.toml"
        scene.write_bytes(SPHERE.read_bytes())
        linked = self.folder / "maps_red.exr"
        linked.symlink_to(scene)
        with self.assertRaises(dermis.Error):
            dermis.bake_normals(scene, size=64).save(self.folder / "maps.exr")
        self.assertEqual(scene.read_bytes(), SPHERE.read_bytes())
        with self.assertRaisesRegex(dermis.Error, "exr or .png"):
            dermis.bake_normals(SPHERE, size=64).save(self.folder / "x.tga")


if __name__ == "__main__":
    unittest.main()
