"""Memory, signals, threads, and environments without a home, a display or a GPU."""

import gc
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy

import dermis
from support import TestCase, resident_kib, run_python


class Process(TestCase):
    def test_memory_does_not_grow(self):
        skin = dermis.profile("jensen_skin1")
        table = dermis.bake_lut(size=64)
        picture = numpy.ones((64, 64, 3), numpy.float32)
        positions = numpy.random.default_rng(1).random((3000, 3))
        triangles = numpy.arange(3000).reshape(-1, 3)

        def calls(times):
            for _ in range(times):
                skin.cdf(numpy.linspace(0, 5, 100))
                table.lookup(numpy.linspace(-1, 1, 100), .1)
                dermis.rmse(picture, picture)
                dermis.Mesh(positions, triangles).positions_mm
                dermis.bake_lut(size=64).values
                for wrong in (lambda: dermis.profile("none"), lambda: dermis.rmse(picture, None)):
                    try:
                        wrong()
                    except dermis.Error:
                        pass
            gc.collect()

        calls(200)  # the allocator's own pools
        before = resident_kib()
        calls(1000)
        # A table or a picture left behind by each call would be 48 MB.
        self.assertLess(resident_kib() - before, 4000)

    def test_memory_of_pictures_does_not_grow(self):
        # Left behind by each call: 4 MB and more, and 2 MB and more.
        for call in (lambda: dermis.render("spheres", "lambert", size=512).radiance,
                     lambda: dermis.reference("spheres", size=192, samples=2).radiance):
            growths = self.growths_kib(call, 4000)
            self.assertLess(growths[-1], 4000, growths)

    def test_memory_of_many_pictures_does_not_grow(self):
        call = lambda: dermis.render("builtin:unit", "lambert", size=16)
        growths = self.growths_kib(call, 1000, calls=100)
        self.assertLess(growths[-1], 1000, growths)

    def test_a_forked_process_draws_too(self):
        code = """
import os, signal, sys, dermis
draw = lambda: dermis.render("builtin:unit", "lambert", size=16).radiance
here = draw()
child = os.fork()
if child == 0:
    signal.alarm(60)  # it waits without end for a thread that is not there
    os._exit(0 if (draw() == here).all() else 1)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""
        self.assertEqual(run_python(code).returncode, 0)

    def growths_kib(self, call, enough, calls=4):
        """Of rounds of calls, until one grows by less: a leak grows in each, the pools of the allocator and
        of the driver in the first ones only."""
        growths = []
        while len(growths) < 10 and not (growths and growths[-1] < enough):
            before = resident_kib()
            for _ in range(calls):
                call()
            gc.collect()
            growths.append(resident_kib() - before)
        return growths

    def test_ctrl_c_ends_the_reference(self):
        # Without a function for the progress: Python's own code would see the signal too.
        code = ("import dermis\n"
                "dermis.reference('bust', size=16, samples=2)\n"
                "print('begun', flush=True)\n"
                "try:\n"
                "    dermis.reference('bust', size=512, samples=65536)\n"
                "except KeyboardInterrupt:\n"
                "    print('interrupted', flush=True)\n")
        with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True) as process:
            self.assertEqual(process.stdout.readline(), "begun\n")
            time.sleep(1)
            process.send_signal(signal.SIGINT)
            begun = time.monotonic()
            try:
                self.assertIn("interrupted", process.communicate(timeout=60)[0])
            finally:
                process.kill()
            # Minutes otherwise; the rows in work end in well under a second on an idle machine.
            self.assertLess(time.monotonic() - begun, 20)

    def test_ctrl_c_ends_the_loading_of_a_scene(self):
        code = ("import dermis\n"
                "print('begun', flush=True)\n"
                "try:\n"
                "    dermis.render('bust', 'lambert', size=16)\n"
                "except KeyboardInterrupt:\n"
                "    print('interrupted', flush=True)\n"
                "print(dermis.render('builtin:unit', 'lambert', size=16).radiance.shape)\n")
        with tempfile.TemporaryDirectory() as cache:
            environment = {**os.environ, "DERMIS_CACHE": cache}
            with subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True,
                                  env=environment) as process:
                self.assertEqual(process.stdout.readline(), "begun\n")
                time.sleep(.3)
                process.send_signal(signal.SIGINT)
                try:
                    self.assertEqual(process.communicate(timeout=100)[0], "interrupted\n(16, 16, 3)\n")
                finally:
                    process.kill()
            kept = [path.relative_to(cache) for path in pathlib.Path(cache).rglob("*") if path.is_file()]
            self.assertFalse([path for path in kept if ".part" in path.name])
            # The last of what loading the bust computes; the unit sphere keeps nothing of this size.
            sizes = [path.stat().st_size for path in pathlib.Path(cache, "curvature").glob("*")]
            self.assertLess(max(sizes, default=0), 1_000_000)

    def test_other_threads_go_on(self):
        counted = 0
        done = threading.Event()

        def count():
            nonlocal counted
            while not done.wait(.001):
                counted += 1

        thread = threading.Thread(target=count)
        thread.start()
        dermis.reference("spheres", size=128, samples=32)
        done.set()
        thread.join()
        self.assertGreater(counted, 5)

    def test_calls_from_several_threads_agree(self):
        expected = dermis.reference("spheres", size=24, samples=8).radiance
        results = [None] * 3

        def call(i):
            results[i] = dermis.reference("spheres", size=24, samples=8).radiance

        threads = [threading.Thread(target=call, args=(i,)) for i in range(3)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        for result in results:
            numpy.testing.assert_array_equal(result, expected)

    def test_without_home_display_or_cache(self):
        blocked = self.folder / "file"
        blocked.write_text("")
        code = "import dermis; print(dermis.reference('spheres', size=8, samples=4).radiance.shape)"
        for environment in ({"HOME": "", "XDG_CACHE_HOME": "", "DERMIS_CACHE": "", "DISPLAY": ""},
                            {"DERMIS_CACHE": str(blocked / "cache")}, {"DERMIS_CACHE": "/proc/nothing"}):
            result = run_python(code, **environment)
            self.assertEqual(result.stdout, "(8, 8, 3)\n", result.stderr)
        without = {name: value for name, value in os.environ.items() if name in ("PYTHONPATH", "PATH")}
        result = subprocess.run([sys.executable, "-c", code], env=without, capture_output=True, text=True)
        self.assertEqual(result.stdout, "(8, 8, 3)\n", result.stderr)

    def test_without_a_gpu_only_drawing_fails(self):
        code = ("import dermis\n"
                "dermis.bake_lut(size=8)\n"
                "try:\n"
                "    dermis.render('spheres', size=8)\n"
                "except dermis.Error as error:\n"
                "    print(error)\n")
        nothing = str(self.folder / "none.json")
        result = run_python(code, VK_ICD_FILENAMES=nothing, VK_DRIVER_FILES=nothing)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Vulkan", result.stdout)

    def test_handles_cannot_be_made_up(self):
        for kind in (dermis.Profile, dermis.Table, dermis.Picture, dermis.ReferencePicture, dermis.Map,
                     dermis.ClosedForm, dermis.Comparison):
            with self.assertRaises(TypeError):
                kind(5)
        for hidden in ("Profile", "Table", "Mesh", "Map"):
            with self.assertRaises(TypeError):
                getattr(dermis._dermis, hidden)()


if __name__ == "__main__":
    unittest.main()
