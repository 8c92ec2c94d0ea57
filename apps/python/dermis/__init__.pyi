# Written by apps/python/make_stub.py.
import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

import numpy
from numpy.typing import ArrayLike, NDArray

Path = str | os.PathLike[str]
Size = int | str | tuple[int, int]
Words = Mapping[str, object] | Iterable[str] | str | None

__version__: str


class Error(Exception):
    """What the command line would print: what is wrong, where, and how to correct it."""


class Comparison:
    """Techniques and the reference of one scene. The arrays are read-only views, no copies."""

    @property
    def scene(self) -> str:
        """The scene's name."""

    @property
    def rows(self) -> list[dict]:
        """A dict for each technique: captured (the share of the effect of scattering), captured_error, rmse, ...

        The same as the rows of `dermis compare --json`. A share whose reference is too noisy is None.
        """

    @property
    def names(self) -> list[str]:
        """Of the rows: the technique, with its settings in brackets."""

    @property
    def credit(self) -> str:
        """The line that goes wherever the pictures go, or ""."""

    @property
    def warnings(self) -> list[str]:
        """What limits the numbers, a line each."""

    @property
    def reference(self) -> NDArray[numpy.float32]:
        """The reference, linear radiance, float32, height x width x 3."""

    @property
    def reference_effect(self) -> NDArray[numpy.float32]:
        """What scattering changes in the reference, float32, height x width x 3: what `effect` is compared with."""

    @property
    def skin(self) -> NDArray[numpy.float32]:
        """1 where a pixel counts, float32, height x width."""

    def radiance(self, name: str) -> NDArray[numpy.float32]:
        """The picture of one of `names`, linear radiance, float32, height x width x 3."""

    def effect(self, name: str) -> NDArray[numpy.float32]:
        """That picture less lambert's, float32, height x width x 3."""

    def flip(self, name: str) -> NDArray[numpy.float32]:
        """FLIP of the tone-mapped picture against the reference's, 0 to 1, float32, height x width."""


def compare(scene: Path, techniques: str | Iterable[str] | None=None, *, size: Size | None=None, integrator: str='surface', ambient: str='renderer', samples_per_pixel: int=36, noise: float=0.2, samples: int=2048, frames: int=5, device: str='', camera: Words=None, light: Words=None, keys: Words=None, progress: Callable[[float], object] | None=None) -> Comparison | list[Comparison]:
    """Techniques compared with the reference of the same scene, as `dermis compare`.

    techniques: "lambert,wrap[wrap=0.4]", a list of such texts, or None for all. size: pixels (512x512, of a set
    of test scenes 96x96). noise: of the reference at which it stops, over the effect of scattering. samples:
    of the reference a pixel, at most. samples_per_pixel: points of a pixel that both sides take, a square
    number. frames: that are timed. The reference is kept in the cache. Returns a Comparison; of a set of
    scenes, such as "unit", a list.
    """


def max_abs_error(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """Largest difference of any channel of linear values. Pictures: floats, height x width x 3 (or no 3)."""


def rmse(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """Root of the mean square difference of linear values. mask: height x width, above 0 where pixels count."""


def rel_mse(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """Mean of (image - reference)^2 / (reference^2 + 0.01) of linear values."""


def psnr_db(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """10 log10(1 / mean square) in dB of what a display shows: linear values in, clamped to 0..1, as sRGB."""


def ssim(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """Mean structural similarity of what a display shows, 1 for equal pictures."""


def ciede2000(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None) -> float:
    """Mean CIEDE2000 colour difference of what a display shows; about 1 is just noticeable."""


def flip(image: ArrayLike, reference: ArrayLike, mask: ArrayLike | None=None, pixels_per_degree: float=67.02) -> float:
    """Mean LDR FLIP of what a display shows, 0 (equal) to 1. pixels_per_degree: of the observer's visual angle."""


def flip_map(image: ArrayLike, reference: ArrayLike, pixels_per_degree: float=67.02) -> NDArray[numpy.float32]:
    """FLIP at each pixel, float32, height x width, an array of its own."""


class Mesh:
    """A triangle mesh in mm, right-handed, Y up, counter-clockwise fronts, UV origin top-left.

    From arrays: positions_mm V x 3, indices T x 3 (whole numbers), normals V x 3 (computed if None), uvs V x 2
    or None. The arrays are copied; V and its order stay. From files: load_mesh(), scene_meshes().
    """

    def __init__(self, positions_mm: ArrayLike, indices: ArrayLike, normals: ArrayLike | None=None, uvs: ArrayLike | None=None):
        ...

    @property
    def name(self) -> str:
        """The file, or the object's name in its scene."""

    @property
    def warnings(self) -> list[str]:
        """What was doubtful in the file, a line each."""

    @property
    def positions_mm(self) -> NDArray[numpy.float32]:
        """float32, V x 3, in mm. A read-only view, no copy."""

    @property
    def normals(self) -> NDArray[numpy.float32]:
        """Unit normals, float32, V x 3. A read-only view, no copy."""

    @property
    def tangents(self) -> NDArray[numpy.float32] | None:
        """Unit tangents along +u and the bitangent's sign, float32, V x 4, or None. A read-only view, no copy."""

    @property
    def uvs(self) -> NDArray[numpy.float32] | None:
        """float32, V x 2, origin top-left, or None. A read-only view, no copy."""

    @property
    def indices(self) -> NDArray[numpy.uint32]:
        """Three vertices a triangle, uint32, T x 3. A read-only view, no copy."""

    def curvature(self, smoothing_mm: float=1.8) -> NDArray[numpy.float32]:
        """Signed mean curvature at each vertex in 1/mm, positive where convex: 1/R on a sphere. float32, V.

        smoothing_mm: averages features narrower than about twice this, 0 for none.
        """

    def curvature_tensors(self, smoothing_mm: float=1.8) -> NDArray[numpy.float32]:
        """The curvature tensor at each vertex in 1/mm: xx, yy, zz, yz, xz, xy. float32, V x 6."""

    def occlusion(self, rays: int=64) -> NDArray[numpy.float32]:
        """The share of a white sky's light that arrives at each vertex, 0 to 1. float32, V."""

    def save(self, path: Path) -> None:
        """Writes .glb (metres, as glTF has it) or .obj (mm)."""


def load_mesh(path: Path, unit_mm: float | None=None) -> Mesh:
    """A .obj, .gltf or .glb file. unit_mm: length of one unit of the file in mm (None: glTF 1000, OBJ 1)."""


def scene_meshes(scene: Path) -> list[Mesh]:
    """The meshes of a scene by its name or file, placed as the scene has them, in mm."""


class Map:
    """A map of a mesh over its UV atlas, gutter included, rows from the top. Made by bake_curvature() and others."""

    @property
    def values(self) -> NDArray[numpy.float32]:
        """float32, size x size (stretch: x 3), in `unit`. A read-only view, no copy."""

    @property
    def coverage(self) -> NDArray[numpy.uint8]:
        """uint8, size x size: 255 where a triangle lies. A read-only view, no copy."""

    @property
    def unit(self) -> str:
        """"1/mm", "mm", or "1" for ratios."""

    @property
    def min(self) -> float:
        """Least value over the covered texels (of the first channel)."""

    @property
    def max(self) -> float:
        """Largest value over the covered texels (of the first channel)."""

    @property
    def warnings(self) -> list[str]:
        """What limits the map, a line each."""

    def save(self, path: Path) -> None:
        """Writes the files of `dermis bake ... -o PATH`: PATH (.exr, half), PATH.json and a preview."""


def bake_curvature(mesh: Mesh | Path, *, size: int=2048, gutter: int=16, material: str | None=None, unit_mm: float | None=None, smoothing_mm: float=1.8, progress: Callable[[float], object] | None=None) -> Map:
    """Curvature in 1/mm, positive where convex, as `dermis bake curvature`: mean; half of that along the tangent
    less that along the bitangent; twist. mesh: a Mesh, a mesh file or a scene.

    size: texels a side. gutter: texels around UV islands. unit_mm: of a mesh file. smoothing_mm: averages
    features narrower than about twice this.
    """


def bake_thickness(mesh: Mesh | Path, *, size: int=2048, gutter: int=16, material: str | None=None, unit_mm: float | None=None, rays: int=32, ray_size: int=1024, max_mm: float=200.0, cone_rad: float=0.7853982, progress: Callable[[float], object] | None=None) -> Map:
    """Thickness of the body behind the surface in mm, as `dermis bake thickness`.

    rays: a texel. ray_size: largest side of the grid that rays are traced on. max_mm: thickness where no ray
    finds the far side. cone_rad: half angle of the cone of inward rays.
    """


def bake_kernel_size(mesh: Mesh | Path, *, size: int=2048, gutter: int=16, material: str | None=None, unit_mm: float | None=None, rays: int=32, ray_size: int=1024, max_mm: float=200.0, cone_rad: float=0.7853982, profile: str | None=None, progress: Callable[[float], object] | None=None) -> Map:
    """Kernel size for texture_space, 0 to 0.996, as `dermis bake kernel-size`. profile: a name (None: the scene's)."""


def bake_stretch(mesh: Mesh | Path, *, size: int=2048, gutter: int=16, material: str | None=None, unit_mm: float | None=None, progress: Callable[[float], object] | None=None) -> Map:
    """Stretch: mm per unit of u, mm per unit of v, cosine between both directions, as `dermis bake stretch`."""


def bake_occlusion(mesh: Mesh | Path, *, size: int=2048, gutter: int=16, material: str | None=None, unit_mm: float | None=None, rays: int=32, ray_size: int=1024, max_mm: float=0.0, progress: Callable[[float], object] | None=None) -> Map:
    """Ambient visibility, 0 to 1, as `dermis bake occlusion`. max_mm: how far it looks in mm, 0 for no limit."""


class Picture:
    """What render() drew."""

    @property
    def radiance(self) -> NDArray[numpy.float32]:
        """Linear radiance, float32, height x width x 3; of a debug view its numbers. Read-only.

        The renderer's 16-bit floats become 32-bit ones once, at the first use; this is a view of them.
        """

    @property
    def coverage(self) -> NDArray[numpy.float32] | None:
        """How much of each pixel a surface covers, 0 to 1, float32, height x width; None of debug views."""

    @property
    def display(self) -> NDArray:
        """The tone-mapped picture as its PNG has it, sRGB codes, uint8 (uint16), height x width x 3. A view."""

    @property
    def technique(self) -> str:
        """Its id."""

    @property
    def credit(self) -> str:
        """The line that goes wherever the picture goes, or ""."""

    @property
    def warnings(self) -> list[str]:
        """What is doubtful in the scene or the picture, a line each."""

    def save(self, path: Path) -> None:
        """Writes the file that `dermis render -o PATH` writes: .png (tone-mapped) or .exr (linear)."""


def render(scene: Path='bust', technique: str='', *, settings: Words=None, size: Size='1024x1024', view: str='final', samples: int=1, bits: int=8, camera: Words=None, light: Words=None, keys: Words=None, device: str='') -> Picture:
    """A scene drawn by a technique, as `dermis render`.

    scene: name, scene file or mesh file. technique: its id (the scene's, or lambert). settings: {name: value},
    what --set takes; parameters() lists them. size: pixels, "1024x768", (1024, 768) or 512. view: final,
    diffuse, specular, normal, curvature, ... samples: 1 or 4 a pixel. bits: 8 or 16 of the PNG. camera: {key:
    value} of --camera, such as {"yaw_deg": 30, "distance_mm": 600}. light: the same of --light. keys: {key:
    value} of --scene, such as {"light.key.intensity": 2}. Each may be the command line's text instead. device:
    text in the Vulkan device's name.
    """


class ReferencePicture:
    """What reference() integrated. The arrays are read-only views, no copies."""

    @property
    def radiance(self) -> NDArray[numpy.float32]:
        """Linear radiance, float32, height x width x 3."""

    @property
    def coverage(self) -> NDArray[numpy.float32]:
        """How much of each pixel a surface covers, 0 to 1, float32, height x width."""

    @property
    def diffuse(self) -> NDArray[numpy.float32]:
        """The part of the radiance that left by scattering, with emission, float32, height x width x 3."""

    @property
    def specular(self) -> NDArray[numpy.float32]:
        """The part that was reflected, float32, height x width x 3."""

    @property
    def variance(self) -> NDArray[numpy.float32]:
        """Of each pixel's mean, float32, height x width x 3."""

    @property
    def samples(self) -> NDArray[numpy.float32]:
        """How many samples each pixel took, float32, height x width."""

    @property
    def skin(self) -> NDArray[numpy.float32]:
        """The share of each pixel that is skin, 0 to 1, float32, height x width."""

    @property
    def description(self) -> dict:
        """Scene, settings, passes, relative_error, noise_reached, warnings: what the file's header has, a dict."""

    @property
    def credit(self) -> str:
        """The line that goes wherever the picture goes, or ""."""

    @property
    def time_ms(self) -> float:
        """How long it took."""

    def save(self, path: Path, preview: Path='') -> None:
        """Writes the files that `dermis reference -o PATH --preview PREVIEW` writes: .exr, and .png."""


def reference(scene: Path, *, size: Size='512x512', integrator: str='surface', samples: int | None=None, noise: float | None=None, seed: int=1, probes: int=16, profile: str | None=None, medium: Words=None, width_scale: float=1.0, normalisation: str='area', cavities: str='flesh', filter: str='box', shadows: str='scene', ambient: str='traced', specular: str='ggx', penumbra_mm: float=2.0, camera: Words=None, light: Words=None, keys: Words=None, progress: Callable[[float], object] | None=None) -> ReferencePicture:
    """The reference of a scene, as `dermis reference`. The same seed gives the same picture.

    integrator: surface, walk, lambert. samples: at most so many a pixel (64; with noise as many as it needs).
    noise: stop at this relative error, such as 0.01. probes: for each sample, even. profile: a name instead of
    the scene's. medium: for walk, {"sigma_s": (r, g, b), "sigma_a": (r, g, b), "g": 0, "eta": 1.4} in 1/mm.
    width_scale: factor on the lengths of profile or medium, 0 is Lambert. penumbra_mm: width of the key light's
    shadow edge. camera, light, keys: as in render().
    """


def parameters(technique: str) -> list[dict]:
    """The parameters of a technique: a list of dicts with name, unit, min, max, choices, default, doc."""


def read_image(path: Path) -> NDArray[numpy.float32]:
    """A picture's file (.png, .jpg, .exr, .hdr, .dds, .ktx2) as linear light, float32, height x width x channels."""


def technique_names() -> list[str]:
    """The techniques that render() and compare() know."""


def scene_names() -> list[str]:
    """The scenes that have a name: files of the folder scenes/ (of the sources, or as they are installed)."""


def subject_names() -> list[str]:
    """The scenes that are made by code, which are always there: "builtin:bust", ..."""


class Profile:
    """A diffusion profile: how much of the light that enters at one point leaves at the distance r.

    Made by profile(), gaussian_profile(), burley_profile() and table_profile().
    """

    @property
    def name(self) -> str:
        """Its name, or the file it came from."""

    @property
    def source(self) -> str:
        """Author, year and place; or the file it came from."""

    @property
    def model(self) -> str:
        """sum of Gaussians, Burley, dipole or table."""

    @property
    def albedo(self) -> NDArray[numpy.float64]:
        """Diffuse albedo of red, green, blue, 0 to 1: the integral of R over the plane. float64 array of 3."""

    @property
    def mean_radius_mm(self) -> NDArray[numpy.float64]:
        """Mean distance in mm at which light leaves. float64 array of 3."""

    @property
    def mean_square_radius_mm2(self) -> NDArray[numpy.float64]:
        """Mean square of that distance in mm^2. float64 array of 3."""

    @property
    def burley_d_mm(self) -> NDArray[numpy.float64]:
        """Burley's d in mm of the same mean radius (d = mean / 2.5). float64 array of 3."""

    def reflectance_per_mm2(self, r_mm: ArrayLike) -> NDArray[numpy.float64]:
        """R(r) in 1/mm^2 at distances in mm, 0 or more. Array of any shape S to float64 of S x 3."""

    def cdf(self, r_mm: ArrayLike) -> NDArray[numpy.float64]:
        """The part of the reflected light, 0 to 1, that leaves within r_mm. Shape S to float64 of S x 3."""

    def inverse_cdf_mm(self, u: ArrayLike) -> NDArray[numpy.float64]:
        """The radius in mm within which the part u, 0 to 1, of the light leaves; inf at 1, but for tables.

        Shape S to float64 of S x 3.
        """

    def slab_transmittance(self, thickness_mm: ArrayLike) -> NDArray[numpy.float64]:
        """The part of the light, 0 to 1, that passes a slab of this thickness in mm. Shape S to S x 3."""

    def fit(self, terms: int=6) -> GaussianFit:
        """A GaussianFit of 1 to 12 Gaussians a channel. A sum of Gaussians comes back as it is."""

    def scaled(self, factor: float) -> Profile:
        """The profile with all its lengths times `factor`, above 0."""

    def report(self, terms: int=6) -> dict:
        """What `dermis profile show --json` prints, as a dict."""

    def csv(self, r_mm: ArrayLike) -> str:
        """Text of a profile file, which profile() reads: a table over r_mm, or the Gaussians of a sum."""


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


def profile(name: str) -> Profile:
    """A published skin by name, a CSV file, or "burley:R,G,B" with Burley's d in mm."""


def gaussian_profile(variances_mm2: ArrayLike, weights: ArrayLike, name: str='gaussians') -> Profile:
    """A sum of Gaussians: variances in mm^2, N; weights, N x 3, whose sum in a channel is its albedo."""


def burley_profile(d_mm: ArrayLike, albedo: ArrayLike=(1, 1, 1), name: str='burley') -> Profile:
    """Burley's normalised diffusion: d in mm and albedo, 0 to 1, of red, green, blue."""


def table_profile(r_mm: ArrayLike, reflectance_per_mm2: ArrayLike, name: str='table') -> Profile:
    """A measured profile: increasing radii in mm, N; R(r) in 1/mm^2, N x 3. Linear in between, 0 beyond."""


def convert(profile: Profile | str | None=None, *, to: str, from_tool: str='', settings: Words=None, albedo: ArrayLike | float | None=None) -> dict:
    """A profile's parameters in other tools, as `dermis profile convert --json` prints them, as a dict.

    profile: a Profile or its name; or none, and from_tool the tool whose `settings` {key: number or (r, g, b)}
    are converted. to: a tool ("hdrp", "unreal", ...) or "all". albedo: one number or three that replace the
    albedo and keep Burley's d.
    """


class Table:
    """A baked table and its convention: what the numbers mean, along which axes.

    Made by bake_lut(), bake_zh(), bake_shadow() and read_table().
    """

    @property
    def values(self) -> NDArray[numpy.float32]:
        """float32, height x width x 3 (or 1): decoded values, row 0 at the least v. A read-only view, no copy."""

    @property
    def convention(self) -> dict:
        """What is written beside every table's file, as a dict: kind, axes with their units, construction, ..."""

    @property
    def description(self) -> str:
        """One line: size, kind, construction, profile, axes."""

    @property
    def note(self) -> str:
        """What was done to the profile before it was integrated, or ""."""

    @property
    def u(self) -> NDArray[numpy.float64]:
        """Axis value of each column, in the unit that convention["axes"][0] names. float64, width."""

    @property
    def v(self) -> NDArray[numpy.float64]:
        """Axis value of each row, in the unit that convention["axes"][1] names. float64, height."""

    def lookup(self, u: ArrayLike, v: ArrayLike) -> NDArray[numpy.float64]:
        """Bilinear lookup at axis values, clamped at the borders, as a texture unit does it.

        u and v are broadcast against each other to a shape S. Returns float64, S x 3.
        """

    def save(self, path: Path, storage: str='auto') -> None:
        """Writes the file that `dermis bake -o PATH` writes, and PATH.json with the convention.

        path: .exr, .png, .ktx2, .dds, .h or .csv. storage: auto, 8, 16 (PNG), half, float (EXR).
        """


def bake_lut(profile: Profile | str | None=None, *, convention: str='dermis', construction: str='', ring_weights: str='', variance_scale: float | None=None, size: Size='256', axis: str='', range: tuple[float, float] | str | None=None, warp: str='', progress: Callable[[float], object] | None=None) -> Table:
    """Pre-integrated diffuse light over N.L (columns) and curvature or radius (rows), as `dermis bake lut`.

    profile: a Profile or its name (gpu_gems_3). convention: dermis (exact, sphere), penner, unity_2011,
    faceworks. construction: sphere, ring, half_ring. ring_weights: line, area. axis: curvature (1/mm) or radius
    (mm). range: (min, max) in that unit. warp: linear, squared. size: pixels, 256, "256x64" or (256, 64).
    """


def bake_zh(profile: Profile | str | None=None, *, construction: str='sphere', axis: str='curvature', range: tuple[float, float] | str | None=None, size: int=256, layout: str='float', progress: Callable[[float], object] | None=None) -> Table:
    """Zonal harmonics 0, 1, 2 of pre-integrated skin over curvature (1/mm) or radius (mm), as `dermis bake zh`.

    size: columns. layout: float (3 rows, one an order), remapped (2 rows, 0.75..1.05, 8 bit).
    """


def bake_shadow(profile: Profile | str | None=None, *, size: Size='256x64', range: tuple[float, float] | str | None=(1, 40), warp: str='linear', sharpening: float=3.0, progress: Callable[[float], object] | None=None) -> Table:
    """Light that scatters into a penumbra, over position and width, as `dermis bake shadow`.

    range: least and largest width in mm. sharpening: filter's width over the width of the light's edge.
    """


def read_table(path: Path) -> Table:
    """A table's file, decoded, with its convention from the file or from PATH.json."""


class ClosedForm:
    """Pre-integrated diffuse light without a table: D(t) = (a t + s sqrt(q^2 + t^2) + k0 + k1 t^2) / 2, t = N.L.

    Made by bake_closed_form().
    """

    @property
    def coefficients(self) -> NDArray[numpy.float64]:
        """a, q, s, k0, k1 of red, green, blue at each curvature. float64, rows x 5 x 3."""

    @property
    def curvature_per_mm(self) -> NDArray[numpy.float64]:
        """Curvature of each row of the coefficients in 1/mm, from 0 in even steps. float64, rows."""

    @property
    def max_error(self) -> float:
        """Largest difference from the integral at the fitted curvatures."""

    def __call__(self, n_dot_l: ArrayLike, curvature_per_mm: ArrayLike) -> NDArray[numpy.float64]:
        """D at N.L, -1 to 1, and curvature in 1/mm, 0 or more; both are broadcast to S. float64, S x 3."""


def bake_closed_form(profile: Profile | str='gpu_gems_3', *, construction: str='sphere', max_curvature: float=1.0, rows: int=257, progress: Callable[[float], object] | None=None) -> ClosedForm:
    """Coefficients of the closed form over curvature, 0 to max_curvature in 1/mm, as `dermis bake closed_form`."""
