// Meshes as arrays: from files, from scenes, from arrays; their curvature and occlusion.

#include "arrays.h"
#include "catalog/catalog.h"
#include "dermis/base/text.h"
#include "dermis/mesh/curvature.h"
#include "dermis/mesh/normals.h"
#include "dermis/mesh/read_mesh.h"
#include "dermis/mesh/write_mesh.h"
#include "dermis/rays/vertex_occlusion.h"
#include "dermis/scene/load_scene.h"
#include "mesh_object.h"
#include "module.h"

namespace dermis::python {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(float) && sizeof(Vec2) == 2 * sizeof(float) &&
              sizeof(Vec4) == 4 * sizeof(float) && sizeof(CurvatureTensor) == 6 * sizeof(float));

MeshObject read_mesh_file(const std::string& path, double unit_mm) {
    MeshOptions options;
    if (unit_mm != 0) {
        if (!(finite("--unit-mm", unit_mm) > 0))
            throw Failure({"--unit-mm: " + to_text(unit_mm) + " must be above 0"});
        options.unit_mm = unit_mm;
    }
    LoadedMesh loaded = watched(py::none(), [&](Watch&) { return read_mesh(path, options); });
    return {path, std::move(loaded.mesh), std::move(loaded.warnings)};
}

std::vector<MeshObject> of_scene(const std::string& name) {
    Scene scene = watched(
        py::none(), [&](Watch&) { return load_scene(name, {.subjects = built_in_catalog().subjects}); });
    std::vector<MeshObject> meshes;
    for (SceneObject& object : scene.objects)
        meshes.push_back({object.name, std::move(object.mesh), scene.warnings, object.classes});
    return meshes;
}

template <class Vector>
std::vector<Vector> vectors_from(const py::object& array, const std::string& name, size_t columns) {
    const std::vector<float> numbers = floats_from(array, name, columns);
    std::vector<Vector> vectors(numbers.size() / columns);
    std::memcpy(static_cast<void*>(vectors.data()), numbers.data(), numbers.size() * sizeof(float));
    return vectors;
}

void check_count(size_t count, size_t vertices, const std::string& name) {
    if (count != vertices)
        throw Failure(
            {name + ": " + std::to_string(count) + " rows for " + std::to_string(vertices) + " positions"});
}

MeshObject of_arrays(const py::object& positions_mm, const py::object& indices, const py::object& normals,
                     const py::object& uvs) {
    MeshObject made{.name = "mesh", .mesh = {}, .warnings = {}};
    Mesh& mesh = made.mesh;
    mesh.positions_mm = vectors_from<Vec3>(positions_mm, "positions_mm", 3);
    mesh.indices = indices_from(indices, "indices", 3);
    const size_t vertices = mesh.positions_mm.size();
    for (const uint32_t index : mesh.indices)
        if (index >= vertices)
            throw Failure({"indices: " + std::to_string(index) + " is out of range, there are " +
                           std::to_string(vertices) + " positions"});
    if (!uvs.is_none()) {
        mesh.uvs = vectors_from<Vec2>(uvs, "uvs", 2);
        check_count(mesh.uvs.size(), vertices, "uvs");
    }
    mesh.materials.resize(1);
    mesh.submeshes = {{.name = "mesh", .first_index = 0, .index_count = uint32_t(mesh.indices.size())}};
    if (!normals.is_none()) {
        mesh.normals = vectors_from<Vec3>(normals, "normals", 3);
        check_count(mesh.normals.size(), vertices, "normals");
    }
    // compute_normals() would split vertices; the arrays of the caller are by vertex.
    complete_normals(mesh);
    return made;
}

template <class Vector>
py::object rows(const std::vector<Vector>& vectors, const py::object& self) {
    if (vectors.empty()) return py::none();
    return view_of(reinterpret_cast<const float*>(vectors.data()),
                   {py::ssize_t(vectors.size()), py::ssize_t(sizeof(Vector) / sizeof(float))}, self);
}

py::object attribute(const py::object& self, const std::string& what) {
    const Mesh& mesh = self.cast<const MeshObject&>().mesh;
    if (what == "positions_mm") return rows(mesh.positions_mm, self);
    if (what == "normals") return rows(mesh.normals, self);
    if (what == "tangents") return rows(mesh.tangents, self);
    if (what == "uvs") return rows(mesh.uvs, self);
    if (what == "atlas_uvs") return rows(mesh.atlas_uvs, self);
    return view_of(mesh.indices.data(), {py::ssize_t(mesh.triangle_count()), 3}, self);
}

void check_smoothing(double smoothing_mm) {
    if (!(finite("--smoothing-mm", smoothing_mm) >= 0))
        throw Failure({"--smoothing-mm: " + to_text(smoothing_mm) + " must be 0 or more"});
}

py::array_t<float> curvature(const MeshObject& object, double smoothing_mm) {
    check_smoothing(smoothing_mm);
    std::vector<float> values = watched(py::none(), [&](Watch&) -> Result<std::vector<float>> {
        return compute_curvature(object.mesh, smoothing_mm);
    });
    const auto count = py::ssize_t(values.size());
    return array_of(std::move(values), {count});
}

// V x 6: xx, yy, zz, yz, xz, xy.
py::array_t<float> tensors(const MeshObject& object, double smoothing_mm) {
    check_smoothing(smoothing_mm);
    const std::vector<CurvatureTensor> values =
        watched(py::none(), [&](Watch&) -> Result<std::vector<CurvatureTensor>> {
            return compute_curvature_tensors(object.mesh, smoothing_mm);
        });
    std::vector<float> numbers(values.size() * 6);
    std::memcpy(numbers.data(), values.data(), numbers.size() * sizeof(float));
    return array_of(std::move(numbers), {py::ssize_t(values.size()), 6});
}

py::array_t<float> occlusion(const MeshObject& object, int rays) {
    if (rays < 1 || rays > 65536) throw Failure({"rays: " + std::to_string(rays) + ", must be 1 to 65536"});
    std::vector<float> values =
        watched(py::none(), [&](Watch&) { return compute_vertex_occlusion(object.mesh, {.rays = rays}); });
    const auto count = py::ssize_t(values.size());
    return array_of(std::move(values), {count});
}

void write_mesh_file(const MeshObject& object, const std::string& path) {
    const bool glb = to_lower(path).ends_with(".glb"), obj = to_lower(path).ends_with(".obj");
    if (!glb && !obj) throw Failure({path + ": a mesh is written as .glb or .obj"});
    check(unlocked([&] { return glb ? write_glb(path, object.mesh) : write_obj(path, object.mesh); }));
}

}  // namespace

void add_meshes(py::module_& module) {
    py::class_<MeshObject>(module, "Mesh")
        .def_readonly("name", &MeshObject::name)
        .def_readonly("warnings", &MeshObject::warnings);
    module.def("read_mesh", read_mesh_file);
    module.def("scene_meshes", of_scene);
    module.def("mesh_of_arrays", of_arrays);
    module.def("mesh_attribute", attribute);
    module.def("mesh_curvature", curvature);
    module.def("mesh_curvature_tensors", tensors);
    module.def("mesh_occlusion", occlusion);
    module.def("write_mesh", write_mesh_file);
}

}  // namespace dermis::python
