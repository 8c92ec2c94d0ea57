// Maps of a mesh over its UV atlas, as `dermis bake curvature` and its neighbours make them.

#include "arrays.h"
#include "dermis/base/stop.h"
#include "dermis/mesh/write_mesh.h"
#include "dermis/rays/map_file.h"
#include "dermis/scene/skin_atlas.h"
#include "map_layout.h"
#include "map_options.h"
#include "mesh_object.h"
#include "module.h"

namespace dermis::python {
namespace {

struct MadeMap {
    BakedMap map;
    MapOrigin origin;
    cli::LayoutOfMap layout;
    MeshObject atlas;  // where the map is laid out by one
};

MapKind kind_of(const std::string& name) {
    constexpr MapKind kAll[] = {MapKind::curvature, MapKind::thickness, MapKind::kernel_size,
                                MapKind::stretch,   MapKind::occlusion, MapKind::gain};
    return *std::ranges::find_if(kAll, [&](MapKind kind) { return map_kind_name(kind) == name; });
}

cli::MapChoice choice_of(const std::string& kind, const py::dict& options) {
    cli::MapChoice choice;
    BakeMapSettings& s = choice.settings = cli::usual_map_settings(kind_of(kind));
    take(choice.uvs, options, "uvs");
    take(choice.profile, options, "profile");
    take(choice.material, options, "material");
    take(choice.unit_mm, options, "unit_mm");
    take(s.size, options, "size");
    take(s.gutter_texels, options, "gutter");
    take(s.rays, options, "rays");
    take(s.ray_size, options, "ray_size");
    take(s.max_mm, options, "max_mm");
    take(s.cone_rad, options, "cone_rad");
    take(s.smoothing_mm, options, "smoothing_mm");
    take(s.walks_per_mm2, options, "walks_per_mm2");
    return choice;
}

MadeMap made_of(const cli::MapRequest& request, const std::string& mesh, const py::object& progress) {
    BakedMap map = watched(progress, [&](Watch& watch) {
        return bake_map(request.scene.objects, request.settings, [&](double done) {
            watch.report(done);
            leave_if_stopped();
        });
    });
    MadeMap made{std::move(map), {.mesh = mesh, .settings = request.settings}, request.layout, {}};
    if (made.layout.is_atlas()) made.atlas = {mesh, skin_with_atlas(request.scene), {}};
    return made;
}

MadeMap bake_of_scene(const std::string& kind, const std::string& mesh, const py::dict& options,
                      const py::object& progress) {
    cli::MapChoice choice = choice_of(kind, options);
    choice.mesh = mesh;
    const cli::MapRequest request = watched(py::none(), [&](Watch&) { return choice.request(); });
    return made_of(request, mesh, progress);
}

MadeMap bake_of_mesh(const std::string& kind, const MeshObject& mesh, const py::dict& options,
                     const py::object& progress) {
    const cli::MapChoice choice = choice_of(kind, options);
    if (choice.unit_mm != 0) throw Failure({"unit_mm: a Mesh is in mm already; give it to load_mesh()"});
    cli::MapRequest request{
        .scene = {}, .settings = value_of(choice.settings_for(Skin{}.profile)), .layout = {}};
    request.scene.objects.push_back(scene_object(mesh));
    request.layout = value_of(choice.lay_out(request.scene));
    request.settings.uvs = request.layout.uvs;
    return made_of(request, mesh.name, progress);
}

void write_map_file(const MadeMap& made, const std::string& path) {
    check(unlocked([&]() -> Result<void> {
        MapOrigin origin = made.origin;
        origin.uv_file = cli::atlas_mesh_name(made.layout, path);
        DERMIS_TRY(write_map(path, made.map, origin));
        return made.layout.is_atlas() ? write_glb(cli::atlas_mesh_path(path), made.atlas.mesh)
                                      : Result<void>{};
    }));
}

}  // namespace

void add_maps(py::module_& module) {
    py::class_<MadeMap>(module, "Map")
        .def_property_readonly(
            "values",
            [](const py::object& self) { return view_of(self.cast<const MadeMap&>().map.values, self); })
        .def_property_readonly(
            "coverage",
            [](const py::object& self) { return view_of(self.cast<const MadeMap&>().map.coverage, self); })
        .def_property_readonly("atlas_mesh",
                               [](const MadeMap& made) -> py::object {
                                   if (!made.layout.is_atlas()) return py::none();
                                   return py::cast(made.atlas);
                               })
        .def_property_readonly("unit", [](const MadeMap& made) { return made.map.unit; })
        .def_property_readonly("min", [](const MadeMap& made) { return made.map.min; })
        .def_property_readonly("max", [](const MadeMap& made) { return made.map.max; })
        .def_property_readonly("warnings", [](const MadeMap& made) { return made.map.warnings; });
    module.def("bake_map_of_scene", bake_of_scene);
    module.def("bake_map_of_mesh", bake_of_mesh);
    module.def("write_map", write_map_file);
}

}  // namespace dermis::python
