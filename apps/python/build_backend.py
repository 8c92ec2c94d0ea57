"""What `pip install .` calls (PEP 517): builds the module with CMake and packs a wheel. Nothing is downloaded.

Of Debian 12's packaged backends mesonpy 0.12 wants a Meson project, and scikit-build 0.16 a setup.py and
setuptools beside it; both would repeat what CMake has. The build folder is the one of ./run (build/, or
$DERMIS_BUILD), so what that has compiled is not compiled again.
"""

import base64
import hashlib
import os
import pathlib
import platform
import re
import subprocess
import sys
import sysconfig
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ.get("DERMIS_BUILD", ROOT / "build"))
TIME = (1980, 1, 1, 0, 0, 0)  # the same sources give the same bytes


def _version():
    return re.search(r"project\(dermis VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1)


def _metadata():
    return (f"Metadata-Version: 2.1\nName: dermis\nVersion: {_version()}\nLicense: MIT\nRequires-Python: >=3.9\n"
            "Requires-Dist: numpy\n"
            "Summary: Human skin in real time: several techniques, measured against a reference\n")


def _tag():
    python = "cp%d%d" % sys.version_info[:2]
    return f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _is_configured(python):
    rules, cache = BUILD / "build.ninja", BUILD / "CMakeCache.txt"
    chosen = cache.exists() and re.search("DERMIS_PYTHON_EXECUTABLE:FILEPATH=(.*)", cache.read_text())
    return (chosen and os.path.realpath(chosen.group(1)) == python and rules.exists()
            and "dermis_python_package" in rules.read_text())


def _build_package():
    # The interpreter itself, not the link in a virtual environment that may go.
    python = os.path.realpath(sys.executable)
    if not _is_configured(python):
        options = ["-DDERMIS_PYTHON=ON", f"-DDERMIS_PYTHON_EXECUTABLE={python}"]
        if not (BUILD / "build.ninja").exists():
            options += ["-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DDERMIS_TESTS=OFF", "-DDERMIS_BENCH=OFF"]
        subprocess.run(["cmake", "-S", str(ROOT), "-B", str(BUILD), *options], check=True)
    subprocess.run(["cmake", "--build", str(BUILD), "--target", "dermis_python_package"], check=True)
    return BUILD / "python" / "dermis"


def _record_line(name, content):
    digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(content)}\n"


def get_requires_for_build_wheel(config_settings=None):
    return []


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    name = f"dermis-{_version()}.dist-info"
    folder = pathlib.Path(metadata_directory, name)
    folder.mkdir()
    (folder / "METADATA").write_text(_metadata())
    return name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    if platform.system() != "Linux":
        raise SystemExit("dermis: only Linux is supported")
    package = _build_package()
    suffix = sysconfig.get_config_var("EXT_SUFFIX")
    info = f"dermis-{_version()}.dist-info"
    files = {f"dermis/{path.name}": path.read_bytes() for path in sorted(package.iterdir())
             if path.suffix in (".py", ".pyi") or path.name in ("py.typed", "_dermis" + suffix)}
    files[f"{info}/METADATA"] = _metadata().encode()
    files[f"{info}/WHEEL"] = ("Wheel-Version: 1.0\nGenerator: dermis\nRoot-Is-Purelib: false\n"
                              f"Tag: {_tag()}\n").encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    record = "".join(_record_line(name, content) for name, content in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    wheel = f"dermis-{_version()}-{_tag()}.whl"
    with zipfile.ZipFile(pathlib.Path(wheel_directory, wheel), "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():
            entry = zipfile.ZipInfo(name, TIME)
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = (0o755 if name.endswith(".so") else 0o644) << 16
            archive.writestr(entry, content)
    return wheel
