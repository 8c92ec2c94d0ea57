"""Tables and the closed form."""

import json
import unittest

import numpy

import dermis
from support import TestCase, run_program


class Tables(TestCase):
    def bake(self, table, storage, *words):
        """The table saved, and the command line's file of the same name in another folder."""
        name = words[words.index("-o") + 1]
        mine = self.folder / "python" / name
        mine.parent.mkdir(exist_ok=True)
        table.save(mine, storage)
        result = run_program("bake", *words, "--storage", storage, cwd=self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        for end in ("", ".json"):
            self.assert_same_bytes(f"{mine}{end}", self.folder / f"{name}{end}")
        return self.folder / name

    def test_files_are_the_command_lines_to_the_byte(self):
        self.bake(dermis.bake_lut("jensen_skin1", size=32), "auto", "lut", "--profile", "jensen_skin1", "--size", 32,
                  "-o", "a.exr")
        self.bake(dermis.bake_lut("jensen_skin1", size=32), "8", "lut", "--profile", "jensen_skin1", "--size", 32,
                  "-o", "b.png")
        self.bake(dermis.bake_lut(convention="faceworks", size=32, range=(.02, .8)), "auto", "lut", "--convention",
                  "faceworks", "--size", 32, "--range", ".02,.8", "-o", "c.png")
        self.bake(dermis.bake_lut("jensen_skin2", construction="full_ring", ring_weights="area", axis="radius",
                                  warp="squared", size=(32, 8)), "float", "lut", "--profile", "jensen_skin2",
                  "--construction", "full_ring", "--ring-weights", "area", "--axis", "radius", "--warp", "squared",
                  "--size", "32x8", "-o", "d.exr")
        self.bake(dermis.bake_zh(size=16), "float", "zh", "--size", 16, "-o", "e.exr")
        self.bake(dermis.bake_zh(size=16, layout="remapped"), "auto", "zh", "--size", 16, "--layout", "remapped", "-o",
                  "f.png")
        self.bake(dermis.bake_shadow(size=(16, 8), range=(2, 20)), "16", "shadow", "--size", "16x8", "--range", "2,20",
                  "-o", "g.png")

    def test_the_array_is_the_file(self):
        table = dermis.bake_lut(size=(16, 8))
        path = self.bake(table, "float", "lut", "--size", "16x8", "-o", "lut.exr")
        read = dermis.read_table(path)
        self.assertEqual(read.values.tobytes(), table.values.tobytes())
        self.assertEqual(table.convention, json.loads((self.folder / "lut.exr.json").read_text()))
        numpy.testing.assert_array_equal(dermis.read_image(path)[..., :3], table.values)

    def test_values_are_a_view_that_keeps_the_table(self):
        table = dermis.bake_lut(size=(16, 8))
        values = table.values
        self.assertEqual((values.dtype, values.shape), (numpy.float32, (8, 16, 3)))
        self.assertTrue(numpy.shares_memory(values, table.values))
        self.assertFalse(values.flags.writeable)
        before = values.copy()
        del table
        again = dermis.bake_lut("jensen_skin1", size=(16, 8))  # what was freed would be written over
        numpy.testing.assert_array_equal(values, before)
        self.assertFalse(numpy.array_equal(again.values, values))

    def test_axes_and_lookups_agree(self):
        table = dermis.bake_lut("gpu_gems_3", size=64)
        numpy.testing.assert_allclose(table.lookup(table.u, table.v[:, None]), table.values, atol=1e-6)
        self.assertEqual(table.lookup(0.0, 0.1).shape, (3,))
        self.assertAlmostEqual(table.v[0], .5 / 128)

    def test_the_closed_form_is_near_the_table(self):
        table, form = dermis.bake_lut("gpu_gems_3", size=64), dermis.bake_closed_form("gpu_gems_3", max_curvature=.5)
        self.assertLess(form.max_error, .004)
        numpy.testing.assert_allclose(form(table.u, table.v[:, None]), table.values, atol=.005)
        csv = self.folder / "form.csv"
        run_program("bake", "closed_form", "--max-curvature", .5, "-o", csv)
        lines = [line.split(",") for line in csv.read_text().splitlines()[1:]]
        printed = numpy.array([line[2:] for line in lines], float).reshape(-1, 3, 5).transpose(0, 2, 1)
        numpy.testing.assert_array_equal(form.coefficients.astype(numpy.float32), printed.astype(numpy.float32))
        self.assertEqual(form.coefficients.shape, (len(form.curvature_per_mm), 5, 3))

    def test_errors_are_the_command_lines(self):
        for words, call in ((("--size", "0"), lambda: dermis.bake_lut(size=0)),
                            (("--size", "99999"), lambda: dermis.bake_lut(size=99999)),
                            (("--axis", "radios"), lambda: dermis.bake_lut(axis="radios")),
                            (("--construction", "spere"), lambda: dermis.bake_lut(construction="spere")),
                            (("--convention", "pener"), lambda: dermis.bake_lut(convention="pener")),
                            (("--range", "1"), lambda: dermis.bake_lut(range="1")),
                            (("--range", "-1,2"), lambda: dermis.bake_lut(range=(-1, 2))),
                            (("--profile", "x.csv"), lambda: dermis.bake_lut("x.csv"))):
            self.assert_error(self.program_error("bake", "lut", *words, "-o", self.folder / "x.exr"), call)
        zonal = self.folder / "zonal.png"
        self.assert_error(self.program_error("bake", "zh", "-o", zonal), dermis.bake_zh().save, zonal)
        table = dermis.bake_lut(size=8)
        self.assert_error(self.program_error("bake", "lut", "-o", "x.jpg"), table.save, "x.jpg")
        self.assert_error(self.program_error("bake", "lut", "-o", "x.exr", "--storage", "8"), table.save, "x.exr", "8")
        self.assert_error("v: nan in row 0 is not a finite number", table.lookup, 0, float("nan"))
        self.assertFalse(zonal.exists())
        with self.assertRaises(dermis.Error):
            dermis.read_table(self.folder / "missing.exr")
        for sizes in (-5, 2**40, "nan", (8, 8, 8)):
            with self.assertRaisesRegex(dermis.Error, "--size"):
                dermis.bake_lut(size=sizes)
        with self.assertRaisesRegex(dermis.Error, "--variance-scale: 0 is not in its range"):
            dermis.bake_lut(variance_scale=0)


if __name__ == "__main__":
    unittest.main()
