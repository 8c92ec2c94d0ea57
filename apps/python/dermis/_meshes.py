"""Meshes as arrays, and maps over their UV atlas."""

from __future__ import annotations

from typing import TYPE_CHECKING

from dermis import _dermis
from dermis._words import given, profile_text, text_path, whole, words

if TYPE_CHECKING:
    from dermis._profiles import Profile
    from collections.abc import Callable
    import numpy
    from numpy.typing import ArrayLike, NDArray
    from dermis._words import Path, Words


class Mesh:
    """A triangle mesh in mm, right-handed, Y up, counter-clockwise fronts, UV origin top-left.

    From arrays: positions_mm V x 3, indices T x 3 (whole numbers), normals V x 3 (computed if None), uvs V x 2
    or None. The arrays are copied; V and its order stay. From files: load_mesh(), scene_meshes().
    """

    __slots__ = ("_mesh",)

    def __init__(self, positions_mm: ArrayLike, indices: ArrayLike, normals: ArrayLike | None=None,
                 uvs: ArrayLike | None=None):
        self._mesh = _dermis.mesh_of_arrays(positions_mm, indices, normals, uvs)

    @classmethod
    def _of(cls, handle):
        mesh = cls.__new__(cls)
        mesh._mesh = handle
        return mesh

    def __repr__(self):
        return f"<dermis.Mesh {self.name}: {len(self.positions_mm)} vertices, {len(self.indices)} triangles>"

    @property
    def name(self) -> str:
        """The file, or the object's name in its scene."""
        return self._mesh.name

    @property
    def warnings(self) -> list[str]:
        """What was doubtful in the file, a line each."""
        return self._mesh.warnings

    @property
    def positions_mm(self) -> NDArray[numpy.float32]:
        """float32, V x 3, in mm. A read-only view, no copy."""
        return _dermis.mesh_attribute(self._mesh, "positions_mm")

    @property
    def normals(self) -> NDArray[numpy.float32]:
        """Unit normals, float32, V x 3. A read-only view, no copy."""
        return _dermis.mesh_attribute(self._mesh, "normals")

    @property
    def tangents(self) -> NDArray[numpy.float32] | None:
        """Unit tangents along +u and the bitangent's sign, float32, V x 4, or None. A read-only view, no copy."""
        return _dermis.mesh_attribute(self._mesh, "tangents")

    @property
    def uvs(self) -> NDArray[numpy.float32] | None:
        """float32, V x 2, origin top-left, or None. A read-only view, no copy."""
        return _dermis.mesh_attribute(self._mesh, "uvs")

    @property
    def atlas_uvs(self) -> NDArray[numpy.float32] | None:
        """Of Map.atlas_mesh: the UVs of the map, float32, V x 2, origin top-left. A read-only view, no copy."""
        return _dermis.mesh_attribute(self._mesh, "atlas_uvs")

    @property
    def indices(self) -> NDArray[numpy.uint32]:
        """Three vertices a triangle, uint32, T x 3. A read-only view, no copy."""
        return _dermis.mesh_attribute(self._mesh, "indices")

    def curvature(self, smoothing_mm: float=1.8) -> NDArray[numpy.float32]:
        """Signed mean curvature at each vertex in 1/mm, positive where convex: 1/R on a sphere. float32, V.

        smoothing_mm: averages features narrower than about twice this, 0 for none.
        """
        return _dermis.mesh_curvature(self._mesh, smoothing_mm)

    def curvature_tensors(self, smoothing_mm: float=1.8) -> NDArray[numpy.float32]:
        """The curvature tensor at each vertex in 1/mm: xx, yy, zz, yz, xz, xy. float32, V x 6."""
        return _dermis.mesh_curvature_tensors(self._mesh, smoothing_mm)

    def occlusion(self, rays: int=64) -> NDArray[numpy.float32]:
        """The share of a white sky's light that arrives at each vertex, 0 to 1. float32, V."""
        return _dermis.mesh_occlusion(self._mesh, rays)

    def save(self, path: Path) -> None:
        """Writes .glb (metres, as glTF has it) or .obj (mm)."""
        _dermis.write_mesh(self._mesh, text_path(path))


def load_mesh(path: Path, unit_mm: float | None=None) -> Mesh:
    """A .obj, .gltf or .glb file. unit_mm: length of one unit of the file in mm (None: glTF 1000, OBJ 1)."""
    return Mesh._of(_dermis.read_mesh(text_path(path), 0 if unit_mm is None else unit_mm))


def scene_meshes(scene: Path) -> list[Mesh]:
    """The meshes of a scene by its name or file, placed as the scene has them, in mm."""
    return [Mesh._of(handle) for handle in _dermis.scene_meshes(text_path(scene))]


class Map:
    """A map of a mesh over its UV atlas, gutter included, rows from the top. Made by bake_curvature() and others."""

    __slots__ = ("_map",)

    def __init__(self, handle):
        if not isinstance(handle, _dermis.Map):
            raise TypeError("use bake_curvature(), bake_thickness(), ...")
        self._map = handle

    @property
    def values(self) -> NDArray[numpy.float32]:
        """float32, size x size (curvature, stretch, gain: x 3), in `unit`. A read-only view, no copy."""
        return self._map.values

    @property
    def coverage(self) -> NDArray[numpy.uint8]:
        """uint8, size x size: 255 where a triangle lies. A read-only view, no copy."""
        return self._map.coverage

    @property
    def atlas_mesh(self) -> Mesh | None:
        """The skin with the UVs of the map as atlas_uvs; None where the map is over the mesh's own UVs."""
        handle = self._map.atlas_mesh
        return None if handle is None else Mesh._of(handle)

    @property
    def unit(self) -> str:
        """"1/mm", "mm", or "1" for ratios."""
        return self._map.unit

    @property
    def min(self) -> float:
        """Least value over the covered texels (of the first channel)."""
        return self._map.min

    @property
    def max(self) -> float:
        """Largest value over the covered texels (of the first channel)."""
        return self._map.max

    @property
    def warnings(self) -> list[str]:
        """What limits the map, a line each."""
        return self._map.warnings

    def save(self, path: Path) -> None:
        """Writes the files of `dermis bake ... -o PATH`: PATH (.exr, half), PATH.json, a preview, the atlas's mesh."""
        _dermis.write_map(self._map, text_path(path))


def _bake(kind, mesh, progress, **options):
    chosen = given(**options)
    if isinstance(mesh, Mesh):
        return Map(_dermis.bake_map_of_mesh(kind, mesh._mesh, chosen, progress))
    return Map(_dermis.bake_map_of_scene(kind, text_path(mesh), chosen, progress))


def bake_curvature(mesh: Mesh | Path, *, size: int=2048, gutter: int=16, material: str | None=None,
                   uvs: str | None=None, unit_mm: float | None=None, smoothing_mm: float=1.8,
                   progress: Callable[[float], object] | None=None) -> Map:
    """Curvature in 1/mm, positive where convex, as `dermis bake curvature`: mean; half of that along the tangent
    less that along the bitangent; twist. mesh: a Mesh, a mesh file or a scene.

    size: texels a side. gutter: texels around UV islands. unit_mm: of a mesh file. smoothing_mm: averages
    features narrower than about twice this. uvs: "file", "atlas", or None: the file's if no two places of the
    skin share texels.
    """
    return _bake("curvature", mesh, progress, size=size, gutter=gutter, material=material, uvs=uvs, unit_mm=unit_mm,
                 smoothing_mm=smoothing_mm)


def bake_thickness(mesh: Mesh | Path, *, size: int=2048, gutter: int=16, material: str | None=None,
                   uvs: str | None=None, unit_mm: float | None=None,
                   rays: int=32, ray_size: int=1024, max_mm: float=200.0,
                   cone_rad: float=0.7853982, progress: Callable[[float], object] | None=None) -> Map:
    """Thickness of the body behind the surface in mm, as `dermis bake thickness`.

    rays: a texel. ray_size: largest side of the grid that rays are traced on. max_mm: thickness where no ray
    finds the far side. cone_rad: half angle of the cone of inward rays.
    """
    return _bake("thickness", mesh, progress, size=size, gutter=gutter, material=material, uvs=uvs, unit_mm=unit_mm,
                 rays=rays, ray_size=ray_size, max_mm=max_mm, cone_rad=cone_rad)


def bake_kernel_size(mesh: Mesh | Path, *, size: int=2048, gutter: int=16, material: str | None=None,
                     uvs: str | None=None, unit_mm: float | None=None,
                     rays: int=32, ray_size: int=1024, max_mm: float=200.0,
                     cone_rad: float=0.7853982, profile: Profile | str | None=None,
                     progress: Callable[[float], object] | None=None) -> Map:
    """Kernel size for texture_space, 0 to 0.996, as `dermis bake kernel-size`.

    profile: a Profile or its name (None: the scene's).
    """
    return _bake("kernel-size", mesh, progress, size=size, gutter=gutter, material=material, uvs=uvs, unit_mm=unit_mm,
                 rays=rays, ray_size=ray_size, max_mm=max_mm, cone_rad=cone_rad, profile=profile_text(profile))


def bake_gain(mesh: Mesh | Path, *, size: int=2048, gutter: int=16, material: str | None=None,
              uvs: str | None=None, unit_mm: float | None=None, walks_per_mm2: float=32.0,
              profile: Profile | str | None=None,
              progress: Callable[[float], object] | None=None) -> Map:
    """Uniform light that each place returns, over flat skin, of each channel, as `dermis bake gain`.

    walks_per_mm2: random walks that start on each mm^2 of the skin. profile: a Profile or its name (None: the scene's).
    """
    return _bake("gain", mesh, progress, size=size, gutter=gutter, material=material, uvs=uvs, unit_mm=unit_mm,
                 walks_per_mm2=walks_per_mm2, profile=profile_text(profile))


def bake_stretch(mesh: Mesh | Path, *, size: int=2048, gutter: int=16, material: str | None=None,
                 uvs: str | None=None, unit_mm: float | None=None,
                 progress: Callable[[float], object] | None=None) -> Map:
    """Stretch: mm per unit of u, mm per unit of v, cosine between both directions, as `dermis bake stretch`."""
    return _bake("stretch", mesh, progress, size=size, gutter=gutter, material=material, uvs=uvs, unit_mm=unit_mm)


def bake_occlusion(mesh: Mesh | Path, *, size: int=2048, gutter: int=16, material: str | None=None,
                   uvs: str | None=None, unit_mm: float | None=None,
                   rays: int=32, ray_size: int=1024, max_mm: float=0.0,
                   progress: Callable[[float], object] | None=None) -> Map:
    """Ambient visibility, 0 to 1, as `dermis bake occlusion`. max_mm: how far it looks in mm, 0 for no limit."""
    return _bake("occlusion", mesh, progress, size=size, gutter=gutter, material=material, uvs=uvs, unit_mm=unit_mm,
                 rays=rays, ray_size=ray_size, max_mm=max_mm)


class NormalMaps:
    """Mean normals of the skin over a UV atlas, in the scene's axes, rows from the top. Made by bake_normals()."""

    __slots__ = ("_maps",)

    def __init__(self, handle):
        if not isinstance(handle, _dermis.NormalMaps):
            raise TypeError("use bake_normals()")
        self._maps = handle

    @property
    def red(self) -> NDArray[numpy.float32]:
        """float32, size x size x 3: the mean of the normals, weighted by red's profile; shorter than 1."""
        return self._maps.red

    @property
    def green(self) -> NDArray[numpy.float32]:
        """float32, size x size x 3: the same of green; blue takes it too."""
        return self._maps.green

    @property
    def uneven(self) -> NDArray[numpy.float32]:
        """float32, size x size x 2: p and q of the spread [[1 + p, q], [q, 1 - p]] of red's normals around the mean."""
        return self._maps.uneven

    @property
    def atlas_mesh(self) -> Mesh | None:
        """The skin with the UVs of the maps as atlas_uvs; None where they are over the mesh's own UVs."""
        handle = self._maps.atlas_mesh
        return None if handle is None else Mesh._of(handle)

    @property
    def warnings(self) -> list[str]:
        """What limits the maps, a line each."""
        return self._maps.warnings

    def save(self, path: Path) -> None:
        """Writes the files of `dermis bake normals ... -o PATH`: NAME_red and NAME_green, .exr or .png, with texts."""
        _dermis.write_normals(self._maps, text_path(path))


def bake_normals(mesh: Path, *, size: int=1024, profile: Profile | str | None=None,
                 unit_mm: float | None=None, clip: str='',
                 time: float | None=None, morph: Words=None) -> NormalMaps:
    """Mean of the normals that each colour's scattering covers, as `dermis bake normals`. mesh: a mesh file or a scene.

    profile: a Profile or its name (None: the scene's). unit_mm: of a mesh file. clip, time, morph: as of render().
    """
    options = given(size=whole(size, "size", -2**31, 2**31 - 1), profile=profile_text(profile), unit_mm=unit_mm)
    return NormalMaps(_dermis.bake_normals(text_path(mesh), (clip, time, words(morph, "morph")), options))
