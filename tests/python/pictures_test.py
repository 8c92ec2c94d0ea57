"""render() and reference()."""

import json
import os
import unittest

import numpy

import dermis
from support import TestCase, run_program


class Rendered(TestCase):
    def test_files_are_the_command_lines_to_the_byte(self):
        for name, words, options in (
                ("a.png", (), {}),
                ("b.exr", ("-t", "wrap", "--set", "wrap=0.4", "--camera", "yaw_deg=30 pitch_deg=5"),
                 {"technique": "wrap", "settings": {"wrap": .4}, "camera": {"yaw_deg": 30, "pitch_deg": 5}}),
                ("c.png", ("-t", "preintegrated", "--scene", "light.key.intensity=2", "--light", "yaw_deg=-60",
                           "--bits", "16"),
                 {"technique": "preintegrated", "keys": {"light.key.intensity": 2}, "light": {"yaw_deg": -60},
                  "bits": 16}),
                ("d.exr", ("--view", "curvature"), {"view": "curvature"})):
            result = run_program("render", "spheres", "--size", "48x32", *words, "-o", self.folder / name)
            self.assertEqual(result.returncode, 0, result.stderr)
            picture = dermis.render("spheres", size=(48, 32), **options)
            picture.save(self.folder / ("python_" + name))
            self.assert_same_bytes(self.folder / name, self.folder / ("python_" + name))

    def test_arrays_are_the_files(self):
        picture = dermis.render("spheres", "lambert", size="48x32")
        picture.save(self.folder / "a.exr")
        picture.save(self.folder / "a.png")
        radiance = picture.radiance
        self.assertEqual((radiance.dtype, radiance.shape), (numpy.float32, (32, 48, 3)))
        numpy.testing.assert_array_equal(radiance, dermis.read_image(self.folder / "a.exr")[..., :3])
        self.assertTrue(numpy.shares_memory(radiance, picture.radiance))
        self.assertFalse(radiance.flags.writeable)
        self.assertEqual((picture.display.dtype, picture.display.shape), (numpy.uint8, (32, 48, 3)))
        codes = picture.display / 255
        linear = numpy.where(codes <= .04045, codes / 12.92, ((codes + .055) / 1.055)**2.4)
        numpy.testing.assert_allclose(dermis.read_image(self.folder / "a.png")[..., :3], linear, atol=1e-5)
        self.assertEqual(picture.coverage.shape, (32, 48))
        self.assertGreater(picture.coverage.max(), .99)
        self.assertEqual(picture.technique, "lambert")
        del picture
        self.assertTrue(numpy.isfinite(radiance).all())

    def test_texts_and_mappings_mean_the_same(self):
        pictures = [dermis.render("spheres", size=32, camera=camera, keys=keys).radiance
                    for camera, keys in (({"yaw_deg": 20, "target_mm": (0, 5, 0)}, {"environment.visible": True}),
                                         ("yaw_deg=20 target_mm=0,5,0", "environment.visible=true"),
                                         (["yaw_deg=20", "target_mm=0,5,0"], ["environment.visible=true"]))]
        self.assertFalse(numpy.array_equal(pictures[0], dermis.render("spheres", size=32).radiance))
        for picture in pictures[1:]:
            numpy.testing.assert_array_equal(picture, pictures[0])

    def test_frames_of_a_clip_are_the_command_lines_to_the_byte(self):
        result = run_program("render", "bust", "-t", "lambert", "--size", 32, "--clip", "greet", "--time", "0.5",
                             "--morph", "squintL=1", "--frames", 3, "--fps", 2, "-o", self.folder / "%d.png")
        self.assertEqual(result.returncode, 0, result.stderr)
        told = []
        pictures = dermis.render("bust", "lambert", size=32, clip="greet", time=.5, morph={"squintL": 1}, frames=3,
                                 fps=2, progress=told.append)
        self.assertEqual((len(pictures), told[-1]), (3, 1))
        for i, picture in enumerate(pictures):
            picture.save(self.folder / "python.png")
            self.assert_same_bytes(self.folder / f"{i}.png", self.folder / "python.png")
        self.assertFalse(numpy.array_equal(pictures[0].display, pictures[2].display))
        first = dermis.render("bust", "lambert", size=32, clip="greet", time=.5, morph="squintL=1")
        numpy.testing.assert_array_equal(first.display, pictures[0].display)
        posed = dermis.reference("bust", size=8, integrator="lambert", samples=4, clip="greet", time=1.5)
        rest = dermis.reference("bust", size=8, integrator="lambert", samples=4)
        self.assertFalse(numpy.array_equal(posed.radiance, rest.radiance))

    def test_a_turn_is_the_command_lines_to_the_byte(self):
        for words, options in (((), {}), (("--clip", "greet", "--fps", 2), {"clip": "greet", "fps": 2})):
            result = run_program("render", "bust", "-t", "lambert", "--size", 32, "--turn", 90, "--frames", 3, *words,
                                 "-o", self.folder / "%d.png")
            self.assertEqual(result.returncode, 0, result.stderr)
            pictures = dermis.render("bust", "lambert", size=32, turn=90, frames=3, **options)
            for i, picture in enumerate(pictures):
                picture.save(self.folder / "python.png")
                self.assert_same_bytes(self.folder / f"{i}.png", self.folder / "python.png")
            self.assertFalse(numpy.array_equal(pictures[0].display, pictures[1].display))
        self.assert_error("turn is the camera's over all frames; give frames: turn=360, frames=96", dermis.render, "bust",
                          turn=90)
        self.assert_error(self.program_error("render", "bust", "--frames", 3, "--turn", "1e+07", "-o", self.folder / "%d.png"),
                          dermis.render, "bust", frames=3, turn=1e7)

    def test_frames_without_a_clip_are_refused(self):
        need = "frames of a clip need clip, frames and fps: clip='talk', frames=96, fps=24"
        for wrong in ({"frames": 3}, {"frames": 3, "fps": 24}, {"fps": 24}, {"clip": "greet", "frames": 3}):
            self.assert_error(need, dermis.render, "bust", **wrong)
        out = ("-o", self.folder / "%d.png")
        for words, options in ((("--clip", "greet", "--frames", 0), {"clip": "greet", "frames": 0, "fps": 24}),
                               (("--clip", "greet", "--fps", -1), {"clip": "greet", "frames": 2, "fps": -1}),
                               (("--clip", "greet", "--time", -1), {"clip": "greet", "time": -1}),
                               (("--clip", "gret"), {"clip": "gret"}),
                               (("--morph", "smil=1"), {"morph": {"smil": 1}}),
                               (("--morph", "smile"), {"morph": "smile"})):
            self.assert_error(self.program_error("render", "bust", *words, *out), dermis.render, "bust", **options)

    def test_errors_are_the_command_lines(self):
        out = ("-o", self.folder / "x.png")
        for words, call in (
                (("nowhere",), lambda: dermis.render("nowhere")),
                (("spheres", "-t", "wrapp"), lambda: dermis.render("spheres", "wrapp")),
                (("spheres", "--size", "9000"), lambda: dermis.render("spheres", size=9000)),
                (("spheres", "--samples", "3"), lambda: dermis.render("spheres", samples=3)),
                (("spheres", "--bits", "9"), lambda: dermis.render("spheres", bits=9)),
                (("spheres", "--view", "finel"), lambda: dermis.render("spheres", view="finel")),
                (("spheres", "-t", "wrap", "--set", "wrap=7"),
                 lambda: dermis.render("spheres", "wrap", settings={"wrap": 7})),
                (("spheres", "-t", "wrap", "--set", "wrap=nan"),
                 lambda: dermis.render("spheres", "wrap", settings={"wrap": float("nan")})),
                (("spheres", "--camera", "yaw=1"), lambda: dermis.render("spheres", camera={"yaw": 1})),
                (("spheres", "--scene", "light.keys.intensity=1"),
                 lambda: dermis.render("spheres", keys={"light.keys.intensity": 1})),
                (("spheres", "--device", "none such"), lambda: dermis.render("spheres", device="none such"))):
            self.assert_error(self.program_error("render", *words, *out), call)
        picture = dermis.render("spheres", size=8)
        self.assert_error(self.program_error("render", "spheres", "--size", 8, "-o", "x.jpg"), picture.save, "x.jpg")
        for wrong in ({"settings": 5}, {"settings": {"wrap": object()}}, {"samples": "1"}, {"camera": [1]}):
            with self.assertRaises(TypeError):
                dermis.render("spheres", **wrong)

    def test_parameters_are_listed(self):
        names = [parameter["name"] for parameter in dermis.parameters("wrap")]
        self.assertIn("wrap", names)
        self.assertIn("wrap", dermis.technique_names())
        self.assertIn("builtin:bust", dermis.subject_names())


class Reference(TestCase):
    def test_files_are_the_command_lines_to_the_byte(self):
        for name, words, options in (
                ("a", ("--samples", 8), {"samples": 8}),
                ("b", ("--integrator", "walk", "--samples", 4, "--medium", "sigma_s=1,2,3 sigma_a=.1 eta=1.3", "--seed",
                       7, "--probes", 4),
                 {"integrator": "walk", "samples": 4, "medium": {"sigma_s": (1, 2, 3), "sigma_a": .1, "eta": 1.3},
                  "seed": 7, "probes": 4}),
                ("c", ("--samples", 8, "--profile", "jensen_skin1", "--width-scale", 0, "--specular", "none"),
                 {"samples": 8, "profile": "jensen_skin1", "width_scale": 0, "specular": "none"})):
            files = [self.folder / f"{name}.exr", self.folder / f"{name}.png"]
            result = run_program("reference", "spheres", "--size", 24, *words, "-o", files[0], "--preview", files[1])
            self.assertEqual(result.returncode, 0, result.stderr)
            picture = dermis.reference("spheres", size=24, **options)
            mine = [self.folder / f"{name}_python.exr", self.folder / f"{name}_python.png"]
            picture.save(mine[0], preview=mine[1])
            for theirs, ours in zip(files, mine):
                self.assert_same_bytes(theirs, ours)
            numpy.testing.assert_array_equal(picture.radiance, dermis.read_image(files[0])[..., :3])

    def test_layers_are_views_of_one_picture(self):
        picture = dermis.reference("spheres", size="24x16", samples=8)
        for name in ("radiance", "diffuse", "specular", "variance"):
            layer = getattr(picture, name)
            self.assertEqual((layer.dtype, layer.shape), (numpy.float32, (16, 24, 3)), name)
            self.assertTrue(numpy.shares_memory(layer, getattr(picture, name)))
        for name in ("coverage", "samples", "skin"):
            self.assertEqual(getattr(picture, name).shape, (16, 24), name)
        numpy.testing.assert_allclose((picture.diffuse + picture.specular)[picture.skin > .99],
                                      picture.radiance[picture.skin > .99], rtol=1e-3)
        self.assertEqual(picture.samples.max(), 8)
        self.assertEqual(picture.description["passes"], 8)

    def test_progress_is_told_on_the_callers_thread(self):
        import threading
        told = []
        dermis.reference("spheres", size=96, samples=32,
                         progress=lambda done: told.append((done, threading.current_thread())))
        shares = [done for done, _ in told]
        self.assertEqual(shares, sorted(shares))
        self.assertEqual(shares[-1], 1)
        self.assertEqual({thread for _, thread in told}, {threading.main_thread()})

    def test_what_progress_raises_ends_the_work(self):
        def raise_at_once(done):
            raise ValueError("enough")
        with self.assertRaisesRegex(ValueError, "enough"):
            dermis.reference("bust", size=256, samples=4096, progress=raise_at_once)
        with self.assertRaises(TypeError):
            dermis.reference("spheres", size=8, progress=5)

    def test_errors_are_the_command_lines(self):
        out = ("-o", self.folder / "x.exr")
        for words, call in (
                (("--integrator", "wlk"), lambda: dermis.reference("spheres", integrator="wlk")),
                (("--size", "x"), lambda: dermis.reference("spheres", size="x")),
                (("--samples", 1, "--size", 8), lambda: dermis.reference("spheres", samples=1, size=8)),
                (("--probes", -2, "--size", 8), lambda: dermis.reference("spheres", probes=-2, size=8)),
                (("--medium", "sigma_s=1"), lambda: dermis.reference("spheres", medium={"sigma_s": 1})),
                (("--medium", "x=1", "--integrator", "walk"),
                 lambda: dermis.reference("spheres", medium={"x": 1}, integrator="walk")),
                (("--profile", "none", "--size", 8), lambda: dermis.reference("spheres", profile="none", size=8)),
                (("--filter", "boxes"), lambda: dermis.reference("spheres", filter="boxes"))):
            self.assert_error(self.program_error("reference", "spheres", *words, *out), call)
        self.assert_error("--noise: nan is not a finite number", dermis.reference, "spheres", noise=float("nan"))
        picture = dermis.reference("spheres", size=8, samples=4)
        with self.assertRaisesRegex(dermis.Error, "x.png"):
            picture.save("x.png")
        with self.assertRaises(dermis.Error):
            dermis.reference("spheres", seed=-1)


if __name__ == "__main__":
    unittest.main()
