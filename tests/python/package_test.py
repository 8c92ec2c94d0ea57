"""`pip install .` in a virtual environment, without a network, a home or the build folder on the path."""

import os
import pathlib
import subprocess
import sys
import unittest

from support import ROOT, TestCase


class Package(TestCase):
    def run_tool(self, *words, **environment):
        clean = {name: value for name, value in os.environ.items() if name in ("PATH", "DERMIS_BUILD", "CCACHE_DIR")}
        home = self.folder / "home"
        home.mkdir(exist_ok=True)
        return subprocess.run(list(map(str, words)), capture_output=True, text=True, cwd=ROOT,
                              env={**clean, "HOME": str(home), "TMPDIR": str(self.folder), **environment})

    def test_installs_into_a_virtual_environment_and_works(self):
        venv = self.folder / "venv"
        made = self.run_tool(sys.executable, "-m", "venv", "--system-site-packages", venv)
        if made.returncode != 0:
            self.skipTest("python3-venv is not installed: " + made.stdout)
        python = venv / "bin/python"
        installed = self.run_tool(python, "-m", "pip", "install", "--no-build-isolation", "--no-index",
                                  "--disable-pip-version-check", ".")
        self.assertEqual(installed.returncode, 0, installed.stdout + installed.stderr)
        code = ("import dermis, sys; print(dermis.__file__); print(dermis.__version__); "
                "print(dermis.bake_lut(size=8).values.shape, dermis.render('builtin:spheres', size=8).radiance.shape)")
        result = self.run_tool(python, "-c", code)
        self.assertEqual(result.returncode, 0, result.stderr)
        file, version, shapes = result.stdout.splitlines()
        self.assertTrue(pathlib.Path(file).is_relative_to(venv), file)
        self.assertIn(f"VERSION {version} ", (ROOT / "CMakeLists.txt").read_text())
        self.assertEqual(shapes, "(8, 8, 3) (8, 8, 3)")
        listed = self.run_tool(python, "-m", "pip", "show", "--files", "--disable-pip-version-check", "dermis").stdout
        self.assertIn("dermis/__init__.pyi", listed)
        checked = self.run_tool(python, "-m", "pip", "uninstall", "--yes", "--disable-pip-version-check", "dermis")
        self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_the_wheel_is_the_same_each_time(self):
        made = []
        for name in ("a", "b"):
            folder = self.folder / name
            folder.mkdir()
            result = self.run_tool(sys.executable, "-c", "import sys; sys.path.insert(0, 'apps/python'); "
                                   f"import build_backend; print(build_backend.build_wheel({str(folder)!r}))")
            self.assertEqual(result.returncode, 0, result.stderr)
            made.append((folder / result.stdout.splitlines()[-1]).read_bytes())
        self.assertEqual(made[0], made[1])
        self.assertLess(len(made[0]), 20_000_000)


if __name__ == "__main__":
    unittest.main()
