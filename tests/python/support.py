"""What the tests of the Python module share. Importing it skips the test where numpy is not installed."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
except ImportError:
    print("skipped: python3-numpy is not installed")
    sys.exit(77)

import dermis

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = os.environ["DERMIS_PROGRAM"]


def run_program(*words, **options):
    """The command line; the test's own environment unless told otherwise."""
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, **options)


def run_python(code, **environment):
    """Another interpreter with the module."""
    return subprocess.run([sys.executable, "-B", "-c", code], capture_output=True, text=True,
                          env={**os.environ, **environment})


def resident_kib():
    """Memory of this process."""
    pages = int(pathlib.Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE") // 1024


class TestCase(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def program_error(self, *words):
        """What the command line prints of a call that it refuses, without its name and where its help is."""
        result = run_program(*words)
        self.assertNotEqual(result.returncode, 0, words)
        return result.stderr.removeprefix("dermis: ").rstrip("\n").partition(" (see dermis ")[0]

    def assert_error(self, sentence, call, *arguments, **options):
        with self.assertRaises(dermis.Error) as raised:
            call(*arguments, **options)
        self.assertEqual(str(raised.exception), sentence)

    def assert_same_bytes(self, first, second):
        self.assertEqual(pathlib.Path(first).read_bytes(), pathlib.Path(second).read_bytes(), f"{first}, {second}")
