"""Diffusion profiles."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy

from dermis import _dermis
from dermis._words import number_text, words

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray
    from dermis._words import Words


class Profile:
    """A diffusion profile: how much of the light that enters at one point leaves at the distance r.

    Made by profile(), gaussian_profile(), burley_profile() and table_profile().
    """

    __slots__ = ("_profile",)

    def __init__(self, handle):
        if not isinstance(handle, _dermis.Profile):
            raise TypeError("use profile(), gaussian_profile(), burley_profile() or table_profile()")
        self._profile = handle

    def __repr__(self):
        return f"<dermis.Profile {self.name}: {self.model}>"

    @property
    def name(self) -> str:
        """Its name, or the file it came from."""
        return self._profile.name

    @property
    def source(self) -> str:
        """Author, year and place; or the file it came from."""
        return self._profile.source

    @property
    def model(self) -> str:
        """sum of Gaussians, Burley, dipole or table."""
        return self._profile.model

    @property
    def albedo(self) -> NDArray[numpy.float64]:
        """Diffuse albedo of red, green, blue, 0 to 1: the integral of R over the plane. float64 array of 3."""
        return _dermis.profile_property(self._profile, "albedo")

    @property
    def mean_radius_mm(self) -> NDArray[numpy.float64]:
        """Mean distance in mm at which light leaves. float64 array of 3."""
        return _dermis.profile_property(self._profile, "mean_radius_mm")

    @property
    def mean_square_radius_mm2(self) -> NDArray[numpy.float64]:
        """Mean square of that distance in mm^2. float64 array of 3."""
        return _dermis.profile_property(self._profile, "mean_square_radius_mm2")

    @property
    def burley_d_mm(self) -> NDArray[numpy.float64]:
        """Burley's d in mm of the same mean radius (d = mean / 2.5). float64 array of 3."""
        return _dermis.profile_burley_d_mm(self._profile)

    def _curve(self, what, argument, at):
        at = numpy.asarray(at)
        return _dermis.profile_curve(self._profile, what, argument, at.reshape(-1)).reshape(at.shape + (3,))

    def reflectance_per_mm2(self, r_mm: ArrayLike) -> NDArray[numpy.float64]:
        """R(r) in 1/mm^2 at distances in mm, 0 or more. Array of any shape S to float64 of S x 3."""
        return self._curve("reflectance_per_mm2", "r_mm", r_mm)

    def cdf(self, r_mm: ArrayLike) -> NDArray[numpy.float64]:
        """The part of the reflected light, 0 to 1, that leaves within r_mm. Shape S to float64 of S x 3."""
        return self._curve("cdf", "r_mm", r_mm)

    def inverse_cdf_mm(self, u: ArrayLike) -> NDArray[numpy.float64]:
        """The radius in mm within which the part u, 0 to 1, of the light leaves; inf at 1, but for tables.

        Shape S to float64 of S x 3.
        """
        return self._curve("inverse_cdf_mm", "u", u)

    def slab_transmittance(self, thickness_mm: ArrayLike) -> NDArray[numpy.float64]:
        """The part of the light, 0 to 1, that passes a slab of this thickness in mm. Shape S to S x 3."""
        return self._curve("slab_transmittance", "thickness_mm", thickness_mm)

    def fit(self, terms: int=6) -> GaussianFit:
        """A GaussianFit of 1 to 12 Gaussians a channel. A sum of Gaussians comes back as it is."""
        variances, weights, max_error, rms_error, fitted = _dermis.fit_profile(self._profile, terms)
        return GaussianFit(variances, weights, max_error, rms_error, Profile(fitted))

    def scaled(self, factor: float) -> Profile:
        """The profile with all its lengths times `factor`, above 0."""
        return Profile(_dermis.stretch_profile(self._profile, factor))

    def report(self, terms: int=6) -> dict:
        """What `dermis profile show --json` prints, as a dict."""
        return json.loads(_dermis.profile_report(self._profile, terms))

    def csv(self, r_mm: ArrayLike) -> str:
        """Text of a profile file, which profile() reads: a table over r_mm, or the Gaussians of a sum."""
        return _dermis.profile_csv(self._profile, r_mm)


@dataclass(frozen=True)
class GaussianFit:
    """A sum of Gaussians for a profile.

    variances_mm2: float64, N, in mm^2. weights: float64, N x 3; the sum of a channel is its albedo. max_error,
    rms_error: float64, 3: the part of the light at a wrong distance. profile: the fit itself.
    """

    variances_mm2: numpy.ndarray
    weights: numpy.ndarray
    max_error: numpy.ndarray
    rms_error: numpy.ndarray
    profile: Profile


def profile_names() -> list[str]:
    """The names of the published skins that profile() knows."""
    return _dermis.profile_names()


def profile(name: str) -> Profile:
    """A published skin by name, a CSV file, or "burley:R,G,B" with Burley's d in mm."""
    return Profile(_dermis.find_profile(name))


def skin_profile(melanin: float=0.02, blood: float=0.015, oxygen: float=0.75, **others: float) -> Profile:
    """A skin from its pigments: volume fractions and oxygen saturation, 0 to 1; `dermis profile skin --help` has all.

    profile.albedo is its colour, linear Rec. 709. Others by name: pheomelanin, epidermis_mm, scattering_per_mm, ...
    """
    values = {"melanin": melanin, "blood": blood, "oxygen": oxygen, **others}
    return profile("skin:" + ",".join(f"{key}={float(value)!r}" for key, value in values.items()))


def gaussian_profile(variances_mm2: ArrayLike, weights: ArrayLike, name: str='gaussians') -> Profile:
    """A sum of Gaussians: variances in mm^2, N; weights, N x 3, whose sum in a channel is its albedo."""
    return Profile(_dermis.profile_of_gaussians(name, variances_mm2, weights))


def burley_profile(d_mm: ArrayLike, albedo: ArrayLike=(1, 1, 1), name: str='burley') -> Profile:
    """Burley's normalised diffusion: d in mm and albedo, 0 to 1, of red, green, blue."""
    return Profile(_dermis.profile_of_burley(name, d_mm, albedo))


def table_profile(r_mm: ArrayLike, reflectance_per_mm2: ArrayLike, name: str='table') -> Profile:
    """A measured profile: increasing radii in mm, N; R(r) in 1/mm^2, N x 3. Linear in between, 0 beyond."""
    return Profile(_dermis.profile_of_table(name, r_mm, reflectance_per_mm2))


def convert(profile: Profile | str | None=None, *, to: str, from_tool: str='', settings: Words=None,
            albedo: ArrayLike | float | None=None) -> dict:
    """A profile's parameters in other tools, as `dermis profile convert --json` prints them, as a dict.

    profile: a Profile or its name; or none, and from_tool the tool whose `settings` {key: number or (r, g, b)}
    are converted. to: a tool ("hdrp", "unreal", ...) or "all". albedo: one number or three that replace the
    albedo and keep Burley's d.
    """
    handle = None if profile is None else _handle(profile)
    text = "" if albedo is None else number_text(albedo)
    return json.loads(_dermis.convert_profile(handle, from_tool, to, text, words(settings, "settings")))


def _handle(value):
    """Of a Profile, or of a name."""
    if isinstance(value, Profile):
        return value._profile
    return _dermis.find_profile(value)
