"""Meshes as arrays, and maps over their atlas."""

import unittest

import numpy

import dermis
from support import TestCase, run_program


def sphere(radius_mm, rings=24):
    """Positions, triangles and UVs of a sphere; the pole's vertices are repeated for their UVs."""
    v, u = numpy.meshgrid(numpy.linspace(0, 1, rings + 1), numpy.linspace(0, 1, 2 * rings + 1), indexing="ij")
    theta, phi = numpy.pi * v, 2 * numpy.pi * u
    positions = radius_mm * numpy.stack([numpy.sin(theta) * numpy.sin(phi), numpy.cos(theta),
                                         numpy.sin(theta) * numpy.cos(phi)], -1)
    positions[:, -1] = positions[:, 0]
    positions[0], positions[-1] = (0, radius_mm, 0), (0, -radius_mm, 0)
    corner = numpy.arange(v.size).reshape(v.shape)
    a, b, c, d = corner[:-1, :-1], corner[1:, :-1], corner[1:, 1:], corner[:-1, 1:]
    triangles = numpy.concatenate([numpy.stack([a, b, c], -1)[:-1].reshape(-1, 3),
                                   numpy.stack([a, c, d], -1)[1:].reshape(-1, 3)])
    return positions.reshape(-1, 3), triangles, numpy.stack([u, v], -1).reshape(-1, 2)


class Meshes(TestCase):
    def test_curvature_of_a_sphere_from_arrays(self):
        positions, triangles, uvs = sphere(20)
        mesh = dermis.Mesh(positions, triangles, uvs=uvs)
        numpy.testing.assert_array_equal(mesh.positions_mm, positions.astype(numpy.float32))
        numpy.testing.assert_array_equal(mesh.indices, triangles)
        used = numpy.unique(triangles)
        numpy.testing.assert_allclose(mesh.curvature()[used], 1 / 20, rtol=.002)
        numpy.testing.assert_allclose(mesh.normals[used], positions[used] / 20, atol=.01)
        tensors = mesh.curvature_tensors()[used]
        numpy.testing.assert_allclose(tensors[:, :3].sum(1) / 2, 1 / 20, rtol=.002)
        numpy.testing.assert_allclose(mesh.occlusion(16)[used], 1, atol=.01)

    def test_units_are_stated_once(self):
        positions, triangles, uvs = sphere(2)
        dermis.Mesh(positions, triangles, uvs=uvs).save(self.folder / "sphere.obj")
        for unit_mm, radius_mm in ((None, 2), (10, 20)):
            mesh = dermis.load_mesh(self.folder / "sphere.obj", unit_mm)
            self.assertAlmostEqual(float(numpy.linalg.norm(mesh.positions_mm, axis=1).max()), radius_mm, places=4)
            self.assertAlmostEqual(float(numpy.median(mesh.curvature())), 1 / radius_mm, places=4)
        dermis.Mesh(positions, triangles, uvs=uvs).save(self.folder / "sphere.glb")
        mesh = dermis.load_mesh(self.folder / "sphere.glb")
        self.assertAlmostEqual(float(numpy.linalg.norm(mesh.positions_mm, axis=1).max()), 2, places=4)
        self.assertEqual(mesh.tangents.shape, (len(mesh.positions_mm), 4))

    def test_attributes_are_views_that_keep_the_mesh(self):
        mesh = dermis.scene_meshes("spheres")[0]
        positions = mesh.positions_mm
        self.assertTrue(numpy.shares_memory(positions, mesh.positions_mm))
        self.assertFalse(positions.flags.writeable)
        before = positions.copy()
        del mesh
        numpy.testing.assert_array_equal(positions, before)

    def test_arrays_of_any_layout_are_taken(self):
        positions, triangles, _ = sphere(5, 8)
        plain = dermis.Mesh(positions, triangles)
        for other in (numpy.asfortranarray(positions), positions[::-1][::-1], positions.astype(">f8"),
                      numpy.repeat(positions, 2, axis=1)[:, ::2], positions.tolist()):
            numpy.testing.assert_array_equal(dermis.Mesh(other, triangles).positions_mm, plain.positions_mm)
        for other in (triangles.astype(numpy.uint8), numpy.asfortranarray(triangles), triangles.tolist()):
            numpy.testing.assert_array_equal(dermis.Mesh(positions, other).indices, triangles)

    def test_vertices_stay_at_degenerate_and_non_manifold_faces(self):
        corners = numpy.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [0, -1, 0], [5, 5, 5]], float)
        for name, triangles in (
                ("a face without area", [[0, 1, 2], [0, 0, 1], [1, 1, 1]]),
                ("three faces at one edge", [[0, 1, 2], [0, 1, 3], [0, 1, 4]]),
                ("two sides of one face", [[0, 1, 2], [0, 2, 1]]),
                ("faces that touch in a point", [[0, 1, 2], [0, 3, 4]])):
            mesh = dermis.Mesh(corners, triangles)
            numpy.testing.assert_array_equal(mesh.positions_mm, corners.astype(numpy.float32), name)
            numpy.testing.assert_array_equal(mesh.indices, triangles, name)
            self.assertEqual(len(mesh.normals), len(corners), name)
            numpy.testing.assert_allclose(numpy.linalg.norm(mesh.normals, axis=1), 1, atol=1e-6, err_msg=name)
            self.assertEqual(len(mesh.curvature()), len(corners), name)

    def test_a_name_with_a_nul_writes_nothing(self):
        mesh = dermis.Mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        for path in (f"{self.folder}/nul\0x.glb", f"{self.folder}/nul\0x.glb".encode()):
            with self.assertRaisesRegex(dermis.Error, "a file's name has no NUL"):
                mesh.save(path)
        self.assertEqual(list(self.folder.iterdir()), [])
        with self.assertRaisesRegex(dermis.Error, "a file's name has no NUL"):
            dermis.load_mesh("none\0x.glb")

    def test_wrong_arrays_are_errors(self):
        good, triangle = [[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]]
        for sentence, *arguments in (
                ("positions_mm: shape 3 x 2, must be N x 3", [[0, 0], [1, 0], [0, 1]], triangle),
                ("positions_mm: shape 3, must be N x 3", [0, 0, 0], triangle),
                ("positions_mm: is empty", numpy.zeros((0, 3)), triangle),
                ("positions_mm: inf in row 1 is not a finite number", [[0, 0, 0], [1, numpy.inf, 0], [0, 1, 0]], triangle),
                ("positions_mm: 1e+300 is not a finite number", [[1e300, 0, 0], [1, 0, 0], [0, 1, 0]], triangle),
                ("indices: 3 is out of range, there are 3 positions", good, [[0, 1, 3]]),
                ("indices: -1 is not an index", good, [[0, 1, -1]]),
                ("indices: dtype float64, must be whole numbers", good, [[0., 1., 2.]]),
                ("indices: is empty", good, numpy.zeros((0, 3), int)),
                ("normals: 1 rows for 3 positions", good, triangle, [[0, 0, 1]]),
                ("uvs: shape 3 x 3, must be N x 2", good, triangle, None, good)):
            self.assert_error(sentence, dermis.Mesh, *arguments)
        mesh = dermis.Mesh(good, triangle)
        self.assert_error("--smoothing-mm: -1 must be 0 or more", mesh.curvature, -1)
        self.assert_error("--smoothing-mm: nan is not a finite number", mesh.curvature, float("nan"))
        self.assert_error("rays: 0, must be 1 to 65536", mesh.occlusion, 0)
        self.assert_error("x.fbx: a mesh is written as .glb or .obj", mesh.save, "x.fbx")
        self.assert_error(self.program_error("info", "none.obj"), dermis.load_mesh, "none.obj")
        self.assertTrue(numpy.isfinite(mesh.curvature()).all())


class Maps(TestCase):
    def test_files_are_the_command_lines_to_the_byte(self):
        for kind, bake, words, options in (
                ("curvature", dermis.bake_curvature, ("--smoothing-mm", 2), {"smoothing_mm": 2}),
                ("thickness", dermis.bake_thickness, ("--rays", 4, "--ray-size", 32), {"rays": 4, "ray_size": 32}),
                ("kernel-size", dermis.bake_kernel_size, ("--rays", 4, "--profile", "jensen_skin1"),
                 {"rays": 4, "profile": "jensen_skin1"}),
                ("stretch", dermis.bake_stretch, (), {}),
                ("gain", dermis.bake_gain, ("--walks-per-mm2", 2), {"walks_per_mm2": 2}),
                ("occlusion", dermis.bake_occlusion, ("--rays", 4), {"rays": 4})):
            path, mine = self.folder / f"{kind}.exr", self.folder / f"{kind}_python.exr"
            result = run_program("bake", kind, "spheres", "--size", 64, *words, "-o", path)
            self.assertEqual(result.returncode, 0, result.stderr)
            made = bake("spheres", size=64, **options)
            made.save(mine)
            self.assert_same_bytes(path, mine)
            self.assert_same_bytes(f"{path}.json", f"{mine}.json")
            self.assertEqual(made.values.shape, (64, 64, 3) if kind in ("stretch", "curvature", "gain") else (64, 64))
            self.assertTrue(made.coverage.any())

    def test_thickness_of_a_sphere_from_arrays(self):
        positions, triangles, uvs = sphere(10)
        mesh = dermis.Mesh(positions, triangles, uvs=uvs)
        told = []
        made = dermis.bake_thickness(mesh, size=64, rays=64, cone_rad=.01, progress=told.append)
        inside = made.values[made.coverage > 0]
        self.assertAlmostEqual(float(numpy.median(inside)), 20, delta=.2)
        self.assertEqual(made.unit, "mm")
        self.assertEqual(told[-1], 1)

    def test_a_mesh_without_uvs_is_baked_over_an_atlas(self):
        positions, triangles, uvs = sphere(10, 24)
        self.assertIsNone(dermis.bake_stretch(dermis.Mesh(positions, triangles, uvs=uvs), size=64).atlas_mesh)
        plain = self.folder / "plain.obj"
        dermis.Mesh(positions, triangles).save(plain)
        files = ("map.exr", "map_atlas.glb")
        run_program("bake", "curvature", plain, "--size", 64, "-o", self.folder / files[0])
        by_command = [(self.folder / name).read_bytes() for name in files]
        dermis.bake_curvature(plain, size=64).save(self.folder / files[0])
        for name, content in zip(files, by_command):
            self.assertEqual((self.folder / name).read_bytes(), content, name)
        atlas = dermis.bake_curvature(dermis.Mesh(positions, triangles), size=64).atlas_mesh
        self.assertEqual(atlas.atlas_uvs.shape, (len(atlas.positions_mm), 2))
        self.assertTrue(0 <= atlas.atlas_uvs.min() and atlas.atlas_uvs.max() <= 1)

    def test_errors_are_the_command_lines(self):
        out = ("-o", self.folder / "x.exr")
        for words, call in ((("--size", 3), lambda: dermis.bake_curvature("spheres", size=3)),
                            (("--material", "x", "--size", 32),
                             lambda: dermis.bake_curvature("spheres", material="x", size=32)),
                            (("--gutter", 999), lambda: dermis.bake_curvature("spheres", gutter=999))):
            self.assert_error(self.program_error("bake", "curvature", "spheres", *words, *out), call)
        positions, triangles, _ = sphere(10, 6)
        with self.assertRaisesRegex(dermis.Error, "UV"):
            dermis.bake_curvature(dermis.Mesh(positions, triangles), size=32, uvs="file")
        with self.assertRaises(TypeError):
            dermis.bake_curvature(dermis.Mesh(positions, triangles), size=2.5)

    def test_what_progress_raises_ends_the_work(self):
        def raise_at_once(done):
            raise ValueError("enough")
        with self.assertRaisesRegex(ValueError, "enough"):
            dermis.bake_thickness("bust", size=2048, ray_size=2048, rays=64, progress=raise_at_once)


if __name__ == "__main__":
    unittest.main()
