"""compare() and the metrics."""

import json
import os
import unittest
from unittest import mock

import numpy

import dermis
from support import TestCase, run_program

WHAT = ("--size", "48", "--samples-per-pixel", "4", "--samples", "64", "--noise", "1", "--timed-frames", "1")
SAME = {"size": 48, "samples_per_pixel": 4, "samples": 64, "noise": 1, "timed_frames": 1}
TIMES = ("time_ms", "time_ratio")


class Compare(TestCase):
    # With a cache of its own: another test may refine the same reference between the two.
    def test_scores_are_the_command_lines(self):
        with mock.patch.dict(os.environ, DERMIS_CACHE=str(self.folder / "cache")):
            self.compare_both()

    def compare_both(self):
        result = run_program("compare", "spheres", "-t", "lambert,wrap[wrap=0.4]", *WHAT, "--json", "-o", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        told = []
        compared = dermis.compare("spheres", ["lambert", "wrap[wrap=0.4]"], progress=told.append, **SAME)
        printed = json.loads(result.stdout)["rows"]
        self.assertEqual(len(compared.rows), 2)
        for theirs, ours in zip(printed, compared.rows, strict=True):
            for time in TIMES:
                self.assertGreater(ours.pop(time), 0)
                theirs.pop(time)
            self.assertEqual(ours, theirs)
        self.assertEqual(compared.names, ["lambert", "wrap[wrap=0.4]"])
        self.assertEqual(told[-1], 1)
        self.check_pictures(compared)

    def check_pictures(self, compared):
        lambert, wrap = compared.radiance("lambert"), compared.radiance("wrap[wrap=0.4]")
        self.assertEqual((compared.reference.dtype, compared.reference.shape), (numpy.float32, (48, 48, 3)))
        numpy.testing.assert_allclose(compared.effect("wrap[wrap=0.4]"), wrap - lambert, atol=1e-6)
        self.assertFalse(compared.effect("lambert").any())
        self.assertAlmostEqual(dermis.rmse(wrap, compared.reference, compared.skin), compared.rows[1]["rmse"], places=6)
        with self.assertRaises(KeyError):
            compared.radiance("wrapp")
        convex = compared.regions["convex"]
        self.assertEqual((convex.dtype, convex.shape), (numpy.float32, (48, 48)))
        self.assertTrue(convex.any())
        self.assertFalse((convex > compared.skin).any())
        self.assertFalse(compared.regions["concave"].any())

    def test_effects_give_the_share(self):
        """As docs/reference.md defines it, but for the reference's noise."""
        compared = dermis.compare("spheres", "wrap[wrap=0.4]", size=48, samples_per_pixel=4, noise=0.05, timed_frames=1)
        counts = compared.skin > 0.5
        reference, wrap = compared.reference_effect[counts], compared.effect("wrap[wrap=0.4]")[counts]
        share = 1 - numpy.sqrt(((wrap - reference) ** 2).sum() / (reference**2).sum())
        self.assertAlmostEqual(share, compared.rows[0]["walk_captured"], delta=0.02)

    def test_pictures_of_ones_own_get_a_row(self):
        drawn = dermis.compare("spheres", "lambert,wrap", **SAME)
        same = drawn.radiance("wrap"), drawn.radiance("lambert")
        settings = {name: value for name, value in SAME.items() if name != "size"}
        compared = dermis.compare("spheres", "lambert", pictures={"same": same}, **settings)
        self.assertEqual(compared.names, ["lambert", "picture[same]"])
        self.assertAlmostEqual(compared.rows[1]["walk_captured"], drawn.rows[1]["walk_captured"], places=5)
        with self.assertRaisesRegex(TypeError, "two arrays"):
            dermis.compare("spheres", pictures={"one": [same[0]]}, **SAME)

    def test_a_set_of_scenes_is_a_list(self):
        compared = dermis.compare("unit", "lambert", keys={"mesh.shape": "slab_behind"}, **SAME)
        self.assertEqual(compared.scene.split("/")[-1], "slab_behind")

    # In the common cache, where the built-in head is made already; no other test compares these poses.
    def test_frames_of_a_clip_are_the_command_lines(self):
        result = run_program("compare", "bust", "-t", "lambert,wrap", *WHAT, "--clip", "greet", "--time", "0.5",
                             "--frames", 2, "--fps", 2, "--json", "-o", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        clip = dermis.compare("bust", "lambert,wrap", clip="greet", time=.5, frames=2, fps=2, **SAME)
        printed = json.loads(result.stdout)
        self.assertEqual((clip.rows, clip.clip, clip.times_s), (printed["rows"], "greet", [.5, 1]))
        self.assertEqual(len(clip.rows), 2)
        self.assertEqual([frame.rows[1]["rmse"] for frame in clip.frames],
                         [frame["rows"][1]["rmse"] for frame in printed["frames"]])
        self.assertFalse(numpy.array_equal(clip.frames[0].reference, clip.frames[1].reference))

    def test_bakes_of_the_rest_pose_get_the_command_lines_rows(self):
        result = run_program("compare", "bust", "-t", "wrap", *WHAT, "--clip", "greet", "--frames", 2,
                             "--rest-bakes", "occlusion,curvature+occlusion", "--json", "-o", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        bakes = ["occlusion", "curvature+occlusion"]
        clip = dermis.compare("bust", "wrap", clip="greet", frames=2, rest_bakes=bakes, **SAME)
        pose = dermis.compare("bust", "wrap", clip="greet", time=clip.times_s[1], rest_bakes="occlusion", **SAME)
        self.assertEqual(clip.rows, json.loads(result.stdout)["rows"])
        names = ["wrap", "wrap[rest=occlusion]", "wrap[rest=curvature+occlusion]"]
        self.assertEqual((clip.frames[1].names, pose.names), (names, names[:2]))
        out = ("-o", self.folder / "x")
        for scene, words, option in (("bust", "gian", "gian"), ("unit", "gain", ["gain"])):
            self.assert_error(self.program_error("compare", scene, "--rest-bakes", words, *out), dermis.compare, scene,
                              rest_bakes=option)

    def test_wrong_frames_are_refused_as_by_the_command_line(self):
        out = ("-o", self.folder / "x")
        for words, options in ((("--frames", 2), {"frames": 2}), (("--fps", 2), {"fps": 2}),
                               (("--clip", "greet", "--frames", 0), {"clip": "greet", "frames": 0}),
                               (("--clip", "gret", "--frames", 2), {"clip": "gret", "frames": 2}),
                               (("--clip", "greet", "--time", 9, "--frames", 2),
                                {"clip": "greet", "time": 9, "frames": 2})):
            self.assert_error(self.program_error("compare", "bust", *words, *out), dermis.compare, "bust", **options)
        self.assert_error("pictures show one frame; leave frames out and give its time", dermis.compare, "bust",
                          size=8, clip="greet", frames=2, pictures={"one": (numpy.zeros((8, 8, 3)),) * 2})

    def test_errors_are_the_command_lines(self):
        out = ("-o", self.folder / "x")
        for words, call in ((("--samples-per-pixel", 5), lambda: dermis.compare("spheres", samples_per_pixel=5)),
                            (("--noise", 0), lambda: dermis.compare("spheres", noise=0)),
                            (("-t", "wrap[wrap=9]"), lambda: dermis.compare("spheres", "wrap[wrap=9]")),
                            (("--integrator", "x"), lambda: dermis.compare("spheres", integrator="x")),
                            (("--timed-frames", 0), lambda: dermis.compare("spheres", timed_frames=0))):
            self.assert_error(self.program_error("compare", "spheres", *words, *out), call)
        with self.assertRaisesRegex(dermis.Error, "--noise: nan is not a finite number"):
            dermis.compare("spheres", noise=float("nan"))


class Metrics(TestCase):
    def setUp(self):
        super().setUp()
        random = numpy.random.default_rng(1)
        self.a, self.b = random.random((2, 20, 30, 3), numpy.float32)

    def test_are_their_formulas(self):
        a, b = self.a.astype(float), self.b.astype(float)
        self.assertAlmostEqual(dermis.rmse(self.a, self.b), numpy.sqrt(((a - b)**2).mean()), places=6)
        self.assertAlmostEqual(dermis.max_abs_error(self.a, self.b), abs(a - b).max(), places=6)
        self.assertAlmostEqual(dermis.rel_mse(self.a, self.b), ((a - b)**2 / (b**2 + .01)).mean(), places=4)
        mask = numpy.zeros((20, 30), bool)
        mask[3:7, 5:9] = True
        self.assertAlmostEqual(dermis.rmse(self.a, self.b, mask), numpy.sqrt(((a - b)[mask]**2).mean()), places=6)

    def test_of_equal_pictures(self):
        for metric, equal in ((dermis.ssim, 1), (dermis.flip, 0), (dermis.ciede2000, 0), (dermis.rmse, 0),
                              (dermis.psnr_db, numpy.inf)):
            self.assertEqual(metric(self.a, self.a), equal)
        self.assertLess(dermis.ssim(self.a, self.b), .5)
        self.assertGreater(dermis.ciede2000(self.a, self.b), 5)

    def test_flip_is_the_mean_of_its_map(self):
        flip = dermis.flip_map(self.a, self.b)
        self.assertEqual((flip.dtype, flip.shape), (numpy.float32, (20, 30)))
        self.assertTrue(flip.flags.writeable)
        self.assertAlmostEqual(dermis.flip(self.a, self.b), float(flip.mean()), places=5)

    def test_arrays_of_any_layout_are_taken(self):
        for other in (numpy.asfortranarray(self.a), self.a[::-1][::-1], self.a.astype(float), self.a.astype(">f4"),
                      numpy.repeat(self.a, 2, axis=1)[:, ::2], self.a.tolist()):
            self.assertEqual(dermis.rmse(other, self.a), 0)
        self.assertEqual(dermis.rmse(numpy.broadcast_to(self.a[:1], self.a.shape), self.a[:1].repeat(20, 0)), 0)
        self.assertAlmostEqual(dermis.rmse(self.a[..., 0], self.b[..., 0]),
                               dermis.rmse(self.a[..., :1], self.b[..., :1]))

    def test_wrong_arrays_are_errors(self):
        nothing = numpy.zeros((0, 30, 3), numpy.float32)
        for sentence, *pictures in (
                ("image: dtype uint8, must be a float type: linear light, not codes of a display",
                 numpy.zeros((4, 4, 3), numpy.uint8), self.b),
                ("image: dtype <U1, must be a float type: linear light, not codes of a display", ["a"], self.b),
                ("reference: shape 20 x 30 x 2, must be height x width x 3 (or height x width)", self.a, self.b[..., :2]),
                ("image: shape 0 x 30 x 3, each side must be 1 to 16384", nothing, self.b),
                ("image: shape a single number, must be height x width x 3 (or height x width)", numpy.float32(1), self.b),
                ("mask: shape 20 x 30 x 3, must be height x width", self.a, self.b, self.a)):
            self.assert_error(sentence, dermis.rmse, *pictures)
        huge = numpy.broadcast_to(numpy.float32(0), (20000, 1, 3))
        self.assert_error("image: shape 20000 x 1 x 3, each side must be 1 to 16384", dermis.rmse, huge, huge)
        bad = self.a.copy()
        bad[3, 4, 1] = numpy.nan
        for metric in (dermis.rmse, dermis.ssim, dermis.flip, dermis.ciede2000):
            with self.assertRaises(dermis.Error):
                metric(bad, self.b)
            with self.assertRaises(dermis.Error):
                metric(self.a, self.b[:-1])
            with self.assertRaises(dermis.Error):
                metric(self.a, self.b, numpy.zeros((20, 30)))
        with self.assertRaises(dermis.Error):
            dermis.flip(self.a, self.b, pixels_per_degree=0)


if __name__ == "__main__":
    unittest.main()
