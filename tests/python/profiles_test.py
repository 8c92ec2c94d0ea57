"""Profiles: presets, conversions, fits, numbers of one's own."""

import json
import unittest

import numpy

import dermis
from support import TestCase, run_program


class Profiles(TestCase):
    def test_reports_are_the_command_lines(self):
        for name in ("jensen_skin1", "gpu_gems_3", "burley:1,.5,.2"):
            shown = json.loads(run_program("profile", "show", name, "--json").stdout)
            self.assertEqual(dermis.profile(name).report(), shown)

    def test_conversions_are_the_command_lines(self):
        printed = json.loads(run_program("profile", "convert", "jensen_skin1", "--to", "all", "--json").stdout)
        self.assertEqual(dermis.convert("jensen_skin1", to="all"), printed)
        self.assertEqual(dermis.convert(dermis.profile("jensen_skin1"), to="all"), printed)
        printed = json.loads(run_program("profile", "convert", "--from", "unreal", "--set", "mean_free_path_distance=3",
                                         "--to", "blender_burley", "--albedo", ".6,.4,.3", "--json").stdout)
        self.assertEqual(dermis.convert(from_tool="unreal", settings={"mean_free_path_distance": 3},
                                        to="blender_burley", albedo=(.6, .4, .3)), printed)

    def test_three_numbers_are_burleys_profile(self):
        skin = dermis.burley_profile((1, .5, .2), albedo=(.8, .5, .4))
        numpy.testing.assert_allclose(skin.albedo, (.8, .5, .4))
        numpy.testing.assert_allclose(skin.mean_radius_mm, (2.5, 1.25, .5))
        r_mm = numpy.geomspace(.01, 20, 50)
        d = numpy.array((1, .5, .2))
        closed = 1 - numpy.exp(-r_mm[:, None] / d) / 4 - 3 * numpy.exp(-r_mm[:, None] / (3 * d)) / 4
        numpy.testing.assert_allclose(skin.cdf(r_mm), closed, atol=1e-12)
        numpy.testing.assert_allclose(skin.inverse_cdf_mm(skin.cdf(2.0)[0])[0], 2, atol=1e-9)

    def test_a_part_of_the_light_is_0_to_1(self):
        skin = dermis.profile("jensen_skin1")
        self.assertTrue(numpy.isfinite(skin.inverse_cdf_mm((0, .999))).all())
        self.assert_error("u: 1.1 is above 1", skin.inverse_cdf_mm, 1.1)
        self.assert_error("u: -0.1 is below 0", skin.inverse_cdf_mm, (.5, -.1))
        self.assertEqual(skin.cdf(1e9).shape, (3,))

    def test_gaussians_come_back_from_their_fit(self):
        variances, weights = [.1, 2.0], [[.3, .5, .9], [.7, .5, .1]]
        fit = dermis.gaussian_profile(variances, weights).fit()
        numpy.testing.assert_allclose(fit.variances_mm2, variances)
        numpy.testing.assert_allclose(fit.weights, weights)
        self.assertEqual(fit.max_error.tolist(), [0, 0, 0])
        jensen = dermis.profile("jensen_skin1").fit(8)
        self.assertLess(jensen.max_error.max(), .01)
        self.assertEqual(jensen.profile.model, "sum of Gaussians")

    def test_a_table_of_a_profile_is_the_profile(self):
        skin = dermis.profile("gpu_gems_3")
        r_mm = numpy.linspace(0, 12, 4000)
        table = dermis.table_profile(r_mm, skin.reflectance_per_mm2(r_mm))
        numpy.testing.assert_allclose(table.mean_radius_mm, skin.mean_radius_mm, rtol=.002)
        path = self.folder / "skin.csv"
        path.write_text(skin.csv(r_mm))
        numpy.testing.assert_allclose(dermis.profile(str(path)).cdf(1.5), skin.cdf(1.5))

    def test_an_object_is_taken_where_a_name_is(self):
        own = dermis.gaussian_profile([.1, 2], [(.2, .6, .9), (.8, .4, .1)], name="my skin, 2")
        path = self.folder / "own.csv"
        path.write_text(own.csv([.1, 1]))
        settings = {"size": 8, "samples": 4, "shadows": "all"}
        by_object, by_file, other = (dermis.reference("spheres", profile=profile, **settings).radiance
                                     for profile in (own, str(path), own.scaled(4)))
        numpy.testing.assert_array_equal(by_object, by_file)
        self.assertGreater(abs(by_object - other).max(), .01)
        drawn = [dermis.render("spheres", "preintegrated", size=32, keys={"skin.profile": profile}).radiance
                 for profile in (own, str(path), own.scaled(4))]
        numpy.testing.assert_array_equal(drawn[0], drawn[1])
        self.assertGreater(abs(drawn[0] - drawn[2]).max(), .01)
        for profile, file in ((own, "own.hlsl"), (path, "file.hlsl")):
            dermis.export(self.folder / file, language="hlsl", profile=profile)
        self.assertIn("my skin", (self.folder / "own.hlsl").read_text())
        self.assert_error("name: must be one line, without control characters", dermis.burley_profile, (1, 1, 1), name="a\nb")
        with self.assertRaisesRegex(TypeError, "must be a Profile or its name"):
            dermis.reference("spheres", profile=3)

    def test_lengths_scale(self):
        skin = dermis.profile("jensen_skin2")
        numpy.testing.assert_allclose(skin.scaled(10).mean_radius_mm, 10 * skin.mean_radius_mm)

    def test_errors_are_the_command_lines(self):
        for words, call in ((("profile", "show", "jensen"), lambda: dermis.profile("jensen")),
                            (("profile", "show", "jensen_skin1", "--terms", "13"),
                             lambda: dermis.profile("jensen_skin1").fit(13)),
                            (("profile", "convert", "jensen_skin1", "--to", "unrel"),
                             lambda: dermis.convert("jensen_skin1", to="unrel")),
                            (("profile", "convert", "--to", "unreal"), lambda: dermis.convert(to="unreal")),
                            (("profile", "convert", "--from", "unreal", "--set", "x=1", "--to", "hdrp"),
                             lambda: dermis.convert(from_tool="unreal", settings={"x": 1}, to="hdrp"))):
            self.assert_error(self.program_error(*words), call)

    def test_wrong_shapes_and_numbers_are_errors(self):
        skin = dermis.profile("gpu_gems_3")
        self.assert_error("r_mm: nan in row 1 is not a finite number", skin.cdf, [1, float("nan")])
        self.assert_error("r_mm: -1 is below 0", skin.cdf, -1)
        self.assert_error("r_mm: is empty", skin.cdf, [])
        self.assert_error("r_mm: dtype complex128, must be real numbers", skin.cdf, [1j])
        self.assert_error("r_mm: dtype object, must be real numbers", skin.cdf, [None])
        self.assert_error("weights: shape 2 x 2, must be N x 3", dermis.gaussian_profile, [1, 2], [[1, 2], [3, 4]])
        self.assert_error("weights: 1 rows for 2 variances", dermis.gaussian_profile, [1, 2], [[1, 1, 1]])
        self.assert_error("albedo: 2 numbers, must be red, green, blue", dermis.burley_profile, (1, 1, 1), (1, 1))
        with self.assertRaisesRegex(dermis.Error, "variance"):
            dermis.gaussian_profile([-1], [[1, 1, 1]])
        with self.assertRaises(dermis.Error):
            dermis.burley_profile((1, 1, 0))
        for factor in (0, -1, float("nan"), float("inf")):
            with self.assertRaisesRegex(dermis.Error, "factor"):
                skin.scaled(factor)


if __name__ == "__main__":
    unittest.main()
