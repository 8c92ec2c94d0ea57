"""Tables of techniques, and the closed form that needs none."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING

import numpy

from dermis import _dermis
from dermis._profiles import _handle
from dermis._words import number_text, range_text, size_text, text_path

if TYPE_CHECKING:
    from collections.abc import Callable
    from numpy.typing import ArrayLike, NDArray
    from dermis._words import Path, Size


class Table:
    """A baked table and its convention: what the numbers mean, along which axes.

    Made by bake_lut(), bake_zh(), bake_shadow() and read_table().
    """

    __slots__ = ("_table",)

    def __init__(self, handle):
        if not isinstance(handle, _dermis.Table):
            raise TypeError("use bake_lut(), bake_zh(), bake_shadow() or read_table()")
        self._table = handle

    def __repr__(self):
        return f"<dermis.Table {self.description}>"

    @property
    def values(self) -> NDArray[numpy.float32]:
        """float32, height x width x 3 (or 1): decoded values, row 0 at the least v. A read-only view, no copy."""
        return self._table.values

    @property
    def convention(self) -> dict:
        """What is written beside every table's file, as a dict: kind, axes with their units, construction, ..."""
        return json.loads(self._table.convention)

    @property
    def description(self) -> str:
        """One line: size, kind, construction, profile, axes."""
        return self._table.description

    @property
    def note(self) -> str:
        """What was done to the profile before it was integrated, or ""."""
        return self._table.note.strip()

    @property
    def u(self) -> NDArray[numpy.float64]:
        """Axis value of each column, in the unit that convention["axes"][0] names. float64, width."""
        return _dermis.table_axis(self._table, 0)

    @property
    def v(self) -> NDArray[numpy.float64]:
        """Axis value of each row, in the unit that convention["axes"][1] names. float64, height."""
        return _dermis.table_axis(self._table, 1)

    def lookup(self, u: ArrayLike, v: ArrayLike) -> NDArray[numpy.float64]:
        """Bilinear lookup at axis values, clamped at the borders, as a texture unit does it.

        u and v are broadcast against each other to a shape S. Returns float64, S x 3.
        """
        u, v = numpy.broadcast_arrays(u, v)
        return _dermis.table_lookup(self._table, u.reshape(-1), v.reshape(-1)).reshape(u.shape + (3,))

    def save(self, path: Path, storage: str='auto') -> None:
        """Writes the file that `dermis bake -o PATH` writes, and PATH.json with the convention.

        path: .exr, .png, .ktx2, .dds, .h or .csv. storage: auto, 8, 16 (PNG), half, float (EXR).
        """
        _dermis.write_table(self._table, text_path(path), storage)


def _profile(value):
    return None if value is None else _handle(value)


def bake_lut(profile: Profile | str | None=None, *, convention: str='dermis', construction: str='',
             ring_weights: str='', variance_scale: float | None=None, size: Size='256', axis: str='',
             range: tuple[float, float] | str | None=None, warp: str='',
             progress: Callable[[float], object] | None=None) -> Table:
    """Pre-integrated diffuse light over N.L (columns) and curvature or radius (rows), as `dermis bake lut`.

    profile: a Profile or its name (gpu_gems_3). convention: dermis (exact, sphere), penner, unity_2011,
    faceworks. construction: sphere, full_ring, half_ring. ring_weights: line, area. axis: curvature (1/mm) or radius
    (mm). range: (min, max) in that unit. warp: linear, squared. size: pixels, 256, "256x64" or (256, 64).
    """
    texts = [convention, construction, ring_weights, size_text(size), axis, range_text(range), warp]
    return Table(_dermis.bake_lut(_profile(profile), texts, variance_scale, progress))


def bake_zh(profile: Profile | str | None=None, *, construction: str='sphere', axis: str='curvature',
            range: tuple[float, float] | str | None=None, size: int=256, layout: str='float',
            progress: Callable[[float], object] | None=None) -> Table:
    """Zonal harmonics 0, 1, 2 of pre-integrated skin over curvature (1/mm) or radius (mm), as `dermis bake zh`.

    size: columns. layout: float (3 rows, one an order), remapped (2 rows, 0.75..1.05, 8 bit).
    """
    texts = [construction, axis, range_text(range), layout]
    return Table(_dermis.bake_zh(_profile(profile), texts, size, progress))


def bake_shadow(profile: Profile | str | None=None, *, size: Size='256x64',
                range: tuple[float, float] | str | None=(1, 40), warp: str='linear', sharpening: float=3.0,
                progress: Callable[[float], object] | None=None) -> Table:
    """Light that scatters into a penumbra, over position and width, as `dermis bake shadow`.

    range: least and largest width in mm. sharpening: filter's width over the width of the light's edge.
    """
    texts = [size_text(size), range_text(range), warp]
    return Table(_dermis.bake_shadow(_profile(profile), texts, sharpening, progress))


def read_table(path: Path) -> Table:
    """A table's file, decoded, with its convention from the file or from PATH.json."""
    return Table(_dermis.read_table(text_path(path)))


class ClosedForm:
    """Pre-integrated diffuse light without a table: D(t) = (a t + s sqrt(q^2 + t^2) + k0 + k1 t^2) / 2, t = N.L.

    Made by bake_closed_form().
    """

    __slots__ = ("_form",)

    def __init__(self, handle):
        if not isinstance(handle, _dermis.ClosedForm):
            raise TypeError("use bake_closed_form()")
        self._form = handle

    @property
    def coefficients(self) -> NDArray[numpy.float64]:
        """a, q, s, k0, k1 of red, green, blue at each curvature. float64, rows x 5 x 3."""
        return _dermis.closed_form_coefficients(self._form)

    @property
    def curvature_per_mm(self) -> NDArray[numpy.float64]:
        """Curvature of each row of the coefficients in 1/mm, from 0 in even steps. float64, rows."""
        return numpy.linspace(0, self._form.max_curvature_per_mm, self._form.rows)

    @property
    def max_error(self) -> float:
        """Largest difference from the integral at the fitted curvatures."""
        return self._form.max_error

    def __call__(self, n_dot_l: ArrayLike, curvature_per_mm: ArrayLike) -> NDArray[numpy.float64]:
        """D at N.L, -1 to 1, and curvature in 1/mm, 0 or more; both are broadcast to S. float64, S x 3."""
        n_dot_l, curvature = numpy.broadcast_arrays(n_dot_l, curvature_per_mm)
        values = _dermis.evaluate_closed_form(self._form, n_dot_l.reshape(-1), curvature.reshape(-1))
        return values.reshape(n_dot_l.shape + (3,))


def bake_closed_form(profile: Profile | str='gpu_gems_3', *, construction: str='sphere', max_curvature: float=1.0,
                     rows: int=257, progress: Callable[[float], object] | None=None) -> ClosedForm:
    """Coefficients of the closed form over curvature, 0 to max_curvature in 1/mm, as `dermis bake closed_form`."""
    return ClosedForm(_dermis.bake_closed_form(_handle(profile), construction, max_curvature, rows, progress))
