"""Packages for engines, web pages and shading functions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from dermis import _dermis
from dermis._words import given, profile_text, scene_arguments, text_path

if TYPE_CHECKING:
    from dermis._profiles import Profile
    from collections.abc import Iterable

    from dermis._words import Path, Words


@dataclass(frozen=True)
class Exported:
    """What export() wrote."""

    files: list[str]
    """Paths, the output before them."""
    warnings: list[str]
    """What the package does not have of the scene, a line each."""


def export(output: Path, scene: Path='', *, engine: str='', language: str='', functions: Iterable[str]=(),
           web: bool=False, native: bool=False, profile: Profile | str | None=None, unit_mm: float | None=None,
           camera: Words=None, light: Words=None, keys: Words=None, clip: str='', time: float | None=None,
           morph: Words=None) -> Exported:
    """A skin for other programs, as `dermis export`. One of engine, language and web.

    output: a folder; with one language a file. engine: unity, unreal, godot, three or babylon: a package, with a
    scene its head too; with native=True the profile of the engine's own skin (unity_hdrp, unreal, babylon, godot).
    language: the shading functions as text: glsl, essl, hlsl, msl, wgsl, gdshader, cpp, or all of them in a folder;
    functions: the names of those that are needed. web: a page. profile: a Profile or its name (None: the scene's).
    unit_mm: of a mesh file. camera, light, keys, clip, time, morph: as of render().
    """
    names = [functions] if isinstance(functions, str) else list(functions)
    options = given(output=text_path(output), engine=engine, language=language, functions=",".join(names), web=web,
                    native=native, profile=profile_text(profile), unit_mm=unit_mm)
    files, warnings = _dermis.export_files(scene_arguments(scene, keys, camera, light, clip, time, morph), options)
    return Exported(files, warnings)
