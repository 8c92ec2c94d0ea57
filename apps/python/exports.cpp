// Packages for engines, pages and functions, as `dermis export` writes them, and baked normals.

#include "arrays.h"
#include "dermis/mesh/write_mesh.h"
#include "dermis/scene/skin_atlas.h"
#include "export_options.h"
#include "mesh_object.h"
#include "module.h"
#include "normals_options.h"
#include "scene_arguments.h"

namespace dermis::python {
namespace {

py::tuple export_files(const SceneArguments& scene, const py::dict& given) {
    cli::ExportOptions options{.scene = scene_choice(scene)};
    take(options.output, given, "output");
    take(options.engine, given, "engine");
    take(options.language, given, "language");
    take(options.functions, given, "functions");
    take(options.profile, given, "profile");
    take(options.web, given, "web");
    take(options.native, given, "native");
    take(options.scene.unit_mm, given, "unit_mm");
    if (given.contains("unit_mm"))
        check(cli::check_number("--unit-mm", options.scene.unit_mm, cli::kUnitRangeMm));
    check(check_outputs(value_of(options.files())));
    const cli::Exported made = watched(py::none(), [&](Watch&) { return cli::make_export(options); });
    check(unlocked([&] { return cli::write_export(made); }));
    std::vector<std::string> paths;
    for (const PackageFile& file : made.files) paths.push_back(file.path);
    return py::make_tuple(paths, made.warnings);
}

cli::MadeNormals bake_normals(const std::string& mesh, const PoseArguments& pose, const py::dict& given) {
    cli::NormalsOptions options{.mesh = mesh, .pose = pose_choice(pose)};
    take(options.profile, given, "profile");
    take(options.size, given, "size");
    take(options.unit_mm, given, "unit_mm");
    if (given.contains("unit_mm")) check(cli::check_number("--unit-mm", options.unit_mm, cli::kUnitRangeMm));
    check(cli::check_number("--size", options.size, cli::kNormalsSizeRange));
    return watched(py::none(), [&](Watch&) { return options.make(FileUse{}); });
}

// Parts first .. first + count - 1 of each texel, -1 to 1.
py::array parts_of(const cli::MadeNormals& made, bool red, size_t first, size_t count) {
    const DiffusedNormals& normals = made.normals;
    std::vector<float> values;
    for (const DiffusedNormals::Texel& texel : red ? normals.red : normals.green)
        for (size_t c = first; c < first + count; ++c) values.push_back(float(texel[c]) * (2 / 65535.0f) - 1);
    return array_of(std::move(values), {normals.size, normals.size, py::ssize_t(count)});
}

py::array uneven_of(const cli::MadeNormals& made) {
    return py::module_::import("numpy").attr("concatenate")(
        py::make_tuple(parts_of(made, true, 3, 1), parts_of(made, false, 3, 1)), 2);
}

void write_normal_files(const cli::MadeNormals& made, const std::string& path) {
    const cli::NormalsOptions options{.mesh = made.origin.mesh, .profile = made.origin.profile_name};
    const Result<FileUse> files = options.files(path);
    check(check_outputs(value_of(files)));
    check(cli::keep_scene_files(made.scene, files));
    check(unlocked([&]() -> Result<void> {
        DERMIS_TRY(cli::write_normals(path, made));
        return made.layout.is_atlas() ? write_glb(cli::atlas_mesh_path(path), skin_with_atlas(made.scene))
                                      : Result<void>{};
    }));
}

}  // namespace

void add_exports(py::module_& module) {
    module.def("export_files", export_files);
    py::class_<cli::MadeNormals>(module, "NormalMaps")
        .def_property_readonly("red", [](const cli::MadeNormals& made) { return parts_of(made, true, 0, 3); })
        .def_property_readonly("green",
                               [](const cli::MadeNormals& made) { return parts_of(made, false, 0, 3); })
        .def_property_readonly("uneven", uneven_of)
        .def_property_readonly(
            "atlas_mesh",
            [](const cli::MadeNormals& made) -> py::object {
                if (!made.layout.is_atlas()) return py::none();
                return py::cast(MeshObject{made.origin.mesh, skin_with_atlas(made.scene), {}});
            })
        .def_readonly("warnings", &cli::MadeNormals::warnings);
    module.def("bake_normals", bake_normals);
    module.def("write_normals", write_normal_files);
}

}  // namespace dermis::python
