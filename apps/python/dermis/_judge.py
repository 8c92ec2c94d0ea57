"""Techniques against the reference, and metrics."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy

from dermis import _dermis
from dermis._words import given, scene_arguments, size_text, whole

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping
    from numpy.typing import ArrayLike, NDArray
    from dermis._words import Path, Size, Words


class Comparison:
    """Techniques and the reference of one scene. The arrays are read-only views, no copies."""

    __slots__ = ("_comparison", "_json")

    def __init__(self, handle):
        if not isinstance(handle, _dermis.Comparison):
            raise TypeError("use compare()")
        self._comparison = handle
        self._json = json.loads(handle.json)

    @property
    def scene(self) -> str:
        """The scene's name."""
        return self._json["scene"]

    @property
    def rows(self) -> list[dict]:
        """A dict for each technique: captured (the share of the effect of scattering), captured_error, rmse, ...

        The same as the rows of `dermis compare --json`. A share whose reference is too noisy is None.
        """
        return self._json["rows"]

    @property
    def names(self) -> list[str]:
        """Of the rows: the technique, with its settings in brackets."""
        return self._comparison.names

    @property
    def credit(self) -> str:
        """The line that goes wherever the pictures go, or ""."""
        return self._json["credit"]

    @property
    def warnings(self) -> list[str]:
        """What limits the numbers, a line each."""
        return self._comparison.warnings

    @property
    def reference(self) -> NDArray[numpy.float32]:
        """The reference, linear radiance, float32, height x width x 3."""
        return _dermis.comparison_picture(self._comparison, -1, "radiance")[..., :3]

    @property
    def reference_effect(self) -> NDArray[numpy.float32]:
        """What scattering changes in the reference, float32, height x width x 3: what `effect` is compared with."""
        return _dermis.comparison_picture(self._comparison, -1, "effect")

    @property
    def skin(self) -> NDArray[numpy.float32]:
        """1 where a pixel counts, float32, height x width."""
        return _dermis.comparison_picture(self._comparison, -1, "skin")

    @property
    def regions(self) -> dict[str, NDArray[numpy.float32]]:
        """Parts of the skin by name (relief, terminator, shadow_edge, ...): 1 inside, float32, height x width."""
        names = _dermis.region_names()
        return {name: _dermis.comparison_region(self._comparison, i) for i, name in enumerate(names)}

    def radiance(self, name: str) -> NDArray[numpy.float32]:
        """The picture of one of `names`, linear radiance, float32, height x width x 3."""
        return _dermis.comparison_picture(self._comparison, self._row(name), "radiance")[..., :3]

    def effect(self, name: str) -> NDArray[numpy.float32]:
        """That picture less lambert's, float32, height x width x 3."""
        return _dermis.comparison_picture(self._comparison, self._row(name), "effect")

    def flip(self, name: str) -> NDArray[numpy.float32]:
        """FLIP of the tone-mapped picture against the reference's, 0 to 1, float32, height x width."""
        return _dermis.comparison_picture(self._comparison, self._row(name), "flip")

    def _row(self, name):
        if name not in self.names:
            raise KeyError(f"{name}: none of {', '.join(self.names)}")
        return self.names.index(name)


class ClipComparison:
    """Techniques and the reference over the frames of a clip."""

    __slots__ = ("_frames", "_json", "_times_s")

    def __init__(self, handle):
        if not isinstance(handle, _dermis.ClipComparison):
            raise TypeError("use compare() with frames")
        self._frames = [Comparison(one) for one in handle.take_frames()]
        self._json = json.loads(handle.json)
        self._times_s = handle.times_s

    @property
    def frames(self) -> list[Comparison]:
        """The comparison of each frame, with its pictures."""
        return self._frames

    @property
    def times_s(self) -> list[float]:
        """Of the frames, in the clip, in seconds."""
        return self._times_s

    @property
    def clip(self) -> str:
        """The clip's name."""
        return self._json["clip"]

    @property
    def rows(self) -> list[dict]:
        """A dict for each technique: by each reference ("walk", "surface") mean, mean_error, worst, worst_time_s.

        The same as the rows of `dermis compare --clip NAME --frames N --json`; with fps also motion, the share
        of what scattering changes from frame to frame.
        """
        return self._json["rows"]


def compare(scene: Path, techniques: str | Iterable[str] | None=None, *, size: Size | None=None,
            pictures: Mapping[str, tuple[ArrayLike, ArrayLike]] | None=None,
            integrator: str='both', ambient: str='renderer', samples_per_pixel: int | None=None, noise: float=0.25,
            samples: int=2048, timed_frames: int=5, device: str='', camera: Words=None, light: Words=None, keys: Words=None,
            clip: str='', time: float | None=None, morph: Words=None, frames: int | None=None, fps: float=0,
            rest_bakes: str | Iterable[str]='',
            progress: Callable[[float], object] | None=None) -> Comparison | list[Comparison] | ClipComparison:
    """Techniques compared with the reference of the same scene, as `dermis compare`.

    techniques: "lambert,wrap[wrap=0.4]", a list of such texts, or None for all. pictures: of another renderer by
    name, each with and without scattering, linear floats, height x width x 3; size is theirs if it is not given.
    They get rows "picture[NAME]". size: pixels (512x512, of a set
    of test scenes 96x96). noise: of the reference at which it stops, over the effect of scattering. samples:
    of the reference a pixel, at most. samples_per_pixel: points of a pixel that both sides take, a square
    number (4 to 36, by the size). timed_frames: how many are timed. integrator: "walk", "surface", or "both":
    rows have both shares, walk_captured and captured, and the pictures are of walk. The references are kept in
    the cache. clip, time, morph: as in render(). frames: compares so many frames of the clip, evenly over it from
    time on, or fps of them in a second. rest_bakes: more rows, with bakes of the rest pose of a mesh that moves:
    "normals,gain+curvature" or a list of such texts, as --rest-bakes. Returns a Comparison; of a set of scenes,
    such as "unit", a list; with frames a ClipComparison.
    """
    pictures = dict(pictures or {})
    if pictures and size is None:
        height, width = numpy.shape(next(iter(pictures.values()))[0])[:2]
        size = (width, height)
    listed = techniques if isinstance(techniques, str) else ",".join(techniques or [])
    least, most = -2**31, 2**31 - 1
    points = None if samples_per_pixel is None else whole(samples_per_pixel, "samples_per_pixel", least, most)
    options = given(size=None if size is None else size_text(size), integrator=integrator, ambient=ambient,
                    samples_per_pixel=points, noise=noise, samples=whole(samples, "samples", least, most),
                    timed_frames=whole(timed_frames, "timed_frames", least, most), device=device, fps=fps,
                    rest_bakes=rest_bakes if isinstance(rest_bakes, str) else ",".join(rest_bakes),
                    frames=None if frames is None else whole(frames, "frames", least, most))
    arguments = scene_arguments(scene, keys, camera, light, clip, time, morph)
    if frames is not None:
        return ClipComparison(_dermis.compare_clip(arguments, listed, pictures, options, progress))
    made = [Comparison(one) for one in _dermis.compare(arguments, listed, pictures, options, progress)]
    return made[0] if len(made) == 1 else made


def max_abs_error(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """Largest difference of any channel of linear values. Pictures: floats, height x width x 3 (or no 3)."""
    return _dermis.max_abs_error(image, reference, mask)


def rmse(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """Root of the mean square difference of linear values. mask: height x width, above 0 where pixels count."""
    return _dermis.rmse(image, reference, mask)


def rel_mse(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """Mean of (image - reference)^2 / (reference^2 + 0.01) of linear values."""
    return _dermis.rel_mse(image, reference, mask)


def psnr_db(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """10 log10(1 / mean square) in dB of what a display shows: linear values in, clamped to 0..1, as sRGB."""
    return _dermis.psnr_db(image, reference, mask)


def ssim(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """Mean structural similarity of what a display shows, 1 for equal pictures."""
    return _dermis.ssim(image, reference, mask)


def ciede2000(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """Mean CIEDE2000 colour difference of what a display shows; about 1 is just noticeable."""
    return _dermis.ciede2000(image, reference, mask)


def flip(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None,
         pixels_per_degree: float=67.02) -> float:
    """Mean LDR FLIP of what a display shows, 0 (equal) to 1. pixels_per_degree: of the observer's visual angle."""
    return _dermis.flip(image, reference, mask, pixels_per_degree)


def flip_map(image: ArrayLike, reference: ArrayLike, pixels_per_degree: float=67.02) -> NDArray[numpy.float32]:
    """FLIP at each pixel, float32, height x width, an array of its own."""
    return _dermis.flip_map(image, reference, pixels_per_degree)
