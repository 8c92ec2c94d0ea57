"""Pictures: render() by a technique, reference() by integration."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

from dermis import _dermis
from dermis._words import given, profile_text, scene_arguments, size_text, text_path, whole, words

if TYPE_CHECKING:
    from dermis._profiles import Profile
    from collections.abc import Callable
    import numpy
    from numpy.typing import NDArray
    from dermis._words import Path, Size, Words


class Picture:
    """What render() drew."""

    __slots__ = ("_picture", "_linear")

    def __init__(self, handle):
        if not isinstance(handle, _dermis.Picture):
            raise TypeError("use render()")
        self._picture = handle
        self._linear = None

    def _rgba(self):
        if self._linear is None:
            self._linear = self._picture.linear
            self._linear.setflags(write=False)
        return self._linear

    @property
    def radiance(self) -> NDArray[numpy.float32]:
        """Linear radiance, float32, height x width x 3; of a debug view its numbers. Read-only.

        The renderer's 16-bit floats become 32-bit ones once, at the first use; this is a view of them.
        """
        values = self._rgba()
        return values[..., :3] if values.ndim == 3 else values

    @property
    def coverage(self) -> NDArray[numpy.float32] | None:
        """How much of each pixel a surface covers, 0 to 1, float32, height x width; None of debug views."""
        values = self._rgba()
        return values[..., 3] if values.ndim == 3 and values.shape[2] == 4 else None

    @property
    def display(self) -> NDArray:
        """The tone-mapped picture as its PNG has it, sRGB codes, uint8 (uint16), height x width x 3. A view."""
        return self._picture.display[..., :3]

    @property
    def technique(self) -> str:
        """Its id."""
        return self._picture.technique

    @property
    def credit(self) -> str:
        """The line that goes wherever the picture goes, or ""."""
        return self._picture.credit

    @property
    def warnings(self) -> list[str]:
        """What is doubtful in the scene or the picture, a line each."""
        return self._picture.warnings

    def save(self, path: Path) -> None:
        """Writes the file that `dermis render -o PATH` writes: .png (tone-mapped) or .exr (linear)."""
        _dermis.write_rendered(self._picture, text_path(path))


def render(scene: Path='bust', technique: str='', *, settings: Words=None, size: Size='1024x1024', view: str='final',
           samples: int=1, bits: int=8, camera: Words=None, light: Words=None, keys: Words=None,
           clip: str='', time: float | None=None, morph: Words=None, frames: int | None=None, fps: float=0,
           turn: float=0, device: str='', progress: Callable[[float], object] | None=None) -> Picture | list[Picture]:
    """A scene drawn by a technique, as `dermis render`.

    scene: name, scene file or mesh file. technique: its id (the scene's, or lambert). settings: {name: value},
    what --set takes; parameters() lists them. size: pixels, "1024x768", (1024, 768) or 512. view: final,
    diffuse, specular, normal, curvature, ... samples: 1 or 4 a pixel. bits: 8 or 16 of the PNG. camera: {key:
    value} of --camera, such as {"yaw_deg": 30, "distance_mm": 600}. light: the same of --light. keys: {key:
    value} of --scene, such as {"light.key.intensity": 2} or {"skin.profile": a Profile}. clip: an animation of the
    mesh file, and time in it in s. morph: {target: weight} of --morph, such as {"jawOpen": 0.6}. Mappings may be
    the command line's text instead. frames: a list of that many pictures of the clip, fps of them in a second,
    from time on; lights and camera stay. turn: angle in degrees that the camera turns over all frames; without fps the pose stays. device:
    text in the Vulkan device's name.
    """
    least, most = -2**31, 2**31 - 1
    options = given(size=size_text(size), view=view, samples=whole(samples, "samples", least, most),
                    bits=whole(bits, "bits", least, most), device=device, fps=fps, turn=turn,
                    frames=None if frames is None else whole(frames, "frames", least, most))
    drawn = _dermis.render(scene_arguments(scene, keys, camera, light, clip, time, morph), technique,
                           words(settings, "settings"), options, progress)
    pictures = [Picture(one) for one in drawn]
    return pictures[0] if frames is None else pictures


class ReferencePicture:
    """What reference() integrated. The arrays are read-only views, no copies."""

    __slots__ = ("_picture",)

    def __init__(self, handle):
        if not isinstance(handle, _dermis.ReferencePicture):
            raise TypeError("use reference()")
        self._picture = handle

    @property
    def radiance(self) -> NDArray[numpy.float32]:
        """Linear radiance, float32, height x width x 3."""
        return _dermis.reference_layer(self._picture, "radiance")[..., :3]

    @property
    def coverage(self) -> NDArray[numpy.float32]:
        """How much of each pixel a surface covers, 0 to 1, float32, height x width."""
        return _dermis.reference_layer(self._picture, "radiance")[..., 3]

    @property
    def diffuse(self) -> NDArray[numpy.float32]:
        """The part of the radiance that left by scattering, with emission, float32, height x width x 3."""
        return _dermis.reference_layer(self._picture, "diffuse")

    @property
    def specular(self) -> NDArray[numpy.float32]:
        """The part that was reflected, float32, height x width x 3."""
        return _dermis.reference_layer(self._picture, "specular")

    @property
    def variance(self) -> NDArray[numpy.float32]:
        """Of each pixel's mean, float32, height x width x 3."""
        return _dermis.reference_layer(self._picture, "variance")

    @property
    def samples(self) -> NDArray[numpy.float32]:
        """How many samples each pixel took, float32, height x width."""
        return _dermis.reference_layer(self._picture, "samples")

    @property
    def skin(self) -> NDArray[numpy.float32]:
        """The share of each pixel that is skin, 0 to 1, float32, height x width."""
        return _dermis.reference_layer(self._picture, "skin")

    @property
    def description(self) -> dict:
        """Scene, settings, passes, relative_error, noise_reached, warnings: what the file's header has, a dict."""
        return json.loads(self._picture.description)

    @property
    def credit(self) -> str:
        """The line that goes wherever the picture goes, or ""."""
        return self._picture.credit

    @property
    def time_ms(self) -> float:
        """How long it took."""
        return self._picture.time_ms

    def save(self, path: Path, preview: Path='') -> None:
        """Writes the files that `dermis reference -o PATH --preview PREVIEW` writes: .exr, and .png."""
        _dermis.write_reference(self._picture, text_path(path), text_path(preview))


def reference(scene: Path, *, size: Size='512x512', integrator: str='surface', samples: int | None=None,
              noise: float | None=None, seed: int=1, probes: int | None=None,
              profile: Profile | str | None=None, medium: Words=None,
              width_scale: float=1.0, normalisation: str='area', cavities: str='flesh', filter: str='box',
              shadows: str='scene', ambient: str='traced', specular: str='ggx', penumbra_mm: float=2.0,
              camera: Words=None, light: Words=None, keys: Words=None,
              clip: str='', time: float | None=None, morph: Words=None,
              progress: Callable[[float], object] | None=None) -> ReferencePicture:
    """The reference of a scene, as `dermis reference`. The same seed gives the same picture.

    integrator: surface, walk, lambert. samples: at most so many a pixel (64; with noise as many as it needs).
    noise: stop at this relative error, such as 0.01. probes: of each sample (3); of walk, its walks (16).
    profile: a Profile or its name, instead of the scene's.
    medium: for walk, {"sigma_s": (r, g, b), "sigma_a": (r, g, b), "g": 0, "eta": 1.4} in 1/mm.
    width_scale: factor on the lengths of profile or medium, 0 is Lambert. penumbra_mm: width of the key light's
    shadow edge. camera, light, keys, clip, time, morph: as in render().
    """
    options = given(size=size_text(size), integrator=integrator, noise=noise, profile=profile_text(profile),
                    width_scale=width_scale, normalisation=normalisation, cavities=cavities, filter=filter,
                    shadows=shadows, ambient=ambient, specular=specular, penumbra_mm=penumbra_mm,
                    seed=whole(seed, "seed", 0, 2**32 - 1),
                    probes=None if probes is None else whole(probes, "probes", -2**31, 2**31 - 1),
                    samples=None if samples is None else whole(samples, "samples", -2**31, 2**31 - 1),
                    medium=None if medium is None else " ".join(words(medium, "medium")))
    arguments = scene_arguments(scene, keys, camera, light, clip, time, morph)
    return ReferencePicture(_dermis.reference(arguments, options, progress))


def parameters(technique: str) -> list[dict]:
    """The parameters of a technique: a list of dicts with name, unit, min, max, choices, default, doc."""
    return json.loads(_dermis.technique_parameters(technique))


def read_image(path: Path) -> NDArray[numpy.float32]:
    """A picture's file (.png, .jpg, .exr, .hdr, .dds, .ktx2) as linear light, float32, height x width x channels."""
    return _dermis.read_image(text_path(path))


def technique_names() -> list[str]:
    """The techniques that render() and compare() know."""
    return _dermis.technique_names()


def scene_names() -> list[str]:
    """The scenes that have a name: files of the folder scenes/ (of the sources, or as they are installed)."""
    return _dermis.scene_names()


def subject_names() -> list[str]:
    """The scenes that are made by code, which are always there: "builtin:bust", ..."""
    return _dermis.subject_names()
