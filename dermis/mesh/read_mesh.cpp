// Reads by extension, then does what every mesh needs: one unit, complete normals, and warnings of
// frequent mistakes (wrong unit, UDIM tiles, missing UVs).

#include "dermis/mesh/read_mesh.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/base/warnings.h"
#include "dermis/mesh/gltf/gltf.h"
#include "dermis/mesh/normals.h"
#include "dermis/mesh/obj.h"
#include "dermis/mesh/subdivide.h"
#include "dermis/mesh/tangents.h"
#include "dermis/mesh/topology.h"
#include "dermis/mesh/uv_report.h"

namespace dermis::inline mesh {
namespace fs = std::filesystem;
namespace {

constexpr double kHeadMin_mm = 150, kHeadMax_mm = 500;

Result<MeshFormat> format_of(const fs::path& path) {
    const std::string extension = to_lower(path.extension().string());
    if (extension == ".obj") return MeshFormat::obj;
    if (extension == ".gltf") return MeshFormat::gltf;
    if (extension == ".glb") return MeshFormat::glb;
    return Error{path.string() + ": a mesh is .obj, .gltf or .glb, not '" + extension + "'"};
}

Result<LoadedMesh> load_obj(std::span<const std::byte> bytes, const fs::path& name,
                            const ReadSibling& read_sibling, const MeshOptions& options) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    DERMIS_TRY_ASSIGN(ObjFile file, parse_obj(text, name, read_sibling, options));
    const auto scale = float(options.unit_mm.value_or(1));
    for (Vec3& p : file.polygons.positions_mm) p *= scale;
    const Result<PolygonMesh> refined = subdivide(file.polygons, options.subdivision_level);
    if (!refined) return Error{name.string() + ": " + refined.error().message};
    return LoadedMesh{.mesh = triangulate(*refined), .warnings = std::move(file.warnings)};
}

// glTF has triangles only: they are the control cage.
Result<LoadedMesh> load_gltf(std::span<const std::byte> bytes, const fs::path& name,
                             const ReadSibling& read_sibling, const MeshOptions& options) {
    Result<LoadedMesh> loaded = gltf::parse_gltf(bytes, name, read_sibling, options);
    if (!loaded || options.subdivision_level == 0) return loaded;
    const Result<PolygonMesh> refined = subdivide(polygons_of(loaded->mesh), options.subdivision_level);
    if (!refined) return Error{name.string() + ": " + refined.error().message};
    if (!loaded->mesh.colors_linear.empty())
        loaded->warnings.push_back(name.string() + ": vertex colours are lost by subdivision");
    loaded->mesh = triangulate(*refined);
    return loaded;
}

// What the readers could not check before scaling and refining.
Result<void> check_finite(Mesh& mesh, const fs::path& name, std::vector<std::string>& warnings) {
    for (const Vec3& p : mesh.positions_mm)
        if (!std::isfinite(p.x + p.y + p.z))
            return Error{name.string() + ": a position is out of range in millimetres; check the unit"};
    size_t bad_uvs = 0;
    for (Vec2& uv : mesh.uvs)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = {}, ++bad_uvs;
    if (bad_uvs > 0)
        warnings.push_back(
            fmt::format("{}: {} UVs were not finite; they get (0, 0)", name.string(), bad_uvs));
    return {};
}

double height_of(const Mesh& mesh) {
    const auto [low, high] = std::ranges::minmax(mesh.positions_mm, {}, &Vec3::y);
    return double(high.y) - low.y;
}

std::string rounded(double value) {
    return fmt::format("{:.4g}", value);
}

// The unit in which a mesh is as tall as a head: centimetres, metres, inches, decimetres, millimetres.
// Nothing where its height of `height` units suits a head, a bust or a person already, or none of them.
std::optional<double> likely_unit(double height, double unit_mm, size_t triangles) {
    constexpr double kPerson_mm = 2300, kUnits_mm[] = {10, 1000, 25.4, 100, 1};
    constexpr size_t kFewestTriangles = 500;  // fewer are not a head
    const double height_mm = height * unit_mm;
    if (triangles < kFewestTriangles || (height_mm >= kHeadMin_mm && height_mm <= kPerson_mm)) return {};
    for (const double other : kUnits_mm)
        if (height * other >= kHeadMin_mm && height * other <= kHeadMax_mm) return other;
    return {};
}

void warn_of_height(const Mesh& mesh, const fs::path& name, const MeshOptions& options, bool is_obj,
                    std::vector<std::string>& warnings) {
    const double height_mm = height_of(mesh) * options.scale_after;
    if (height_mm >= kHeadMin_mm && height_mm <= kHeadMax_mm) return;
    std::string text = name.string() + ": " + rounded(height_mm) + " mm tall; a head is 150 to 500 mm";
    if (options.unit_mm)
        text += ", check the unit of " + to_text(*options.unit_mm) + " mm";
    else
        text += std::string(is_obj ? "; OBJ has no unit:" : "; glTF is in metres, else") +
                " state unit_mm under [[mesh]] of a scene file";
    warnings.push_back(text);
}

void warn_of_tiles(const Mesh& mesh, const fs::path& name, std::vector<std::string>& warnings) {
    if (mesh.uvs.empty()) return;
    std::map<uint32_t, std::set<int>> tiles;
    bool others = false;
    for (const Submesh& submesh : mesh.submeshes)
        for (uint32_t i = submesh.first_index; i < submesh.first_index + submesh.index_count; i += 3) {
            Vec2 middle;
            for (uint32_t k = 0; k < 3; ++k) middle = middle + mesh.uvs[mesh.indices[i + k]] * (1.0f / 3);
            const int tile = udim_tile(middle);
            tiles[submesh.material].insert(tile);
            others |= tile != 1001;
        }
    if (!others) return;
    std::vector<std::string> parts;
    for (const auto& [material, set] : tiles) {
        std::vector<std::string> numbers;
        for (const int tile : set) numbers.push_back(tile == 0 ? "outside" : std::to_string(tile));
        if (numbers.size() > 6) numbers.resize(6), numbers.push_back("...");
        parts.push_back("'" + mesh.materials[material].name + "' " + join(numbers, " "));
    }
    if (parts.size() > 40) parts.resize(40), parts.push_back("...");
    warnings.push_back(name.string() + ": UVs lie in several UDIM tiles: " + join(parts, ", "));
}

void number_vertices(Mesh& mesh) {
    mesh.file_vertices.resize(mesh.positions_mm.size());
    std::iota(mesh.file_vertices.begin(), mesh.file_vertices.end(), 0u);
}

void finish_normals(Mesh& mesh, const fs::path& name, std::vector<std::string>& warnings) {
    if (mesh.normals.empty()) return compute_normals(mesh);
    complete_normals(mesh);
    const double backwards = fraction_facing_backwards(mesh);
    if (backwards > 0.5)
        warnings.push_back(
            fmt::format("{}: {} % of the triangles face against their normals; is the winding reversed?",
                        name.string(), int(std::lround(100 * backwards))));
}

}  // namespace

bool is_mesh_file(const fs::path& path) {
    return bool(format_of(path));
}

bool stays_inside(std::string_view path) {
    if (path.empty() || path.size() > 4096) return false;
    if (path.find_first_of("\\:") != std::string_view::npos || path.find('\0') != std::string_view::npos)
        return false;
    if (path.front() == '/') return false;
    const auto parts = split(path, '/');
    return std::ranges::none_of(parts, [](std::string_view part) { return part == ".."; });
}

Result<LoadedMesh> parse_mesh(std::span<const std::byte> bytes, MeshFormat format, const fs::path& name,
                              const ReadSibling& read_sibling, const MeshOptions& options) {
    if (options.unit_mm && !(*options.unit_mm > 0 && std::isfinite(*options.unit_mm)))
        return Error{name.string() + ": the unit must be a positive number of millimetres"};
    const bool is_obj = format == MeshFormat::obj;
    const double unit_mm = options.unit_mm.value_or(is_obj ? 1 : 1000);
    Result<LoadedMesh> loaded =
        is_obj ? load_obj(bytes, name, read_sibling, options) : load_gltf(bytes, name, read_sibling, options);
    if (!loaded) return Error{printable_line(loaded.error().message)};
    Mesh& mesh = loaded->mesh;
    std::vector<std::string>& warnings = loaded->warnings;
    loaded->unit_mm = unit_mm;
    DERMIS_TRY(check_finite(mesh, name, warnings));
    if (const double height_mm = height_of(mesh); options.guess_unit && !options.unit_mm)
        if (const auto unit = likely_unit(height_mm / unit_mm, unit_mm, mesh.triangle_count())) {
            MeshOptions with_unit = options;
            with_unit.unit_mm = unit;
            DERMIS_TRY_ASSIGN(LoadedMesh again, parse_mesh(bytes, format, name, read_sibling, with_unit));
            again.warnings.push_back(name.string() + ": " + rounded(height_mm) + " mm tall in units of " +
                                     to_text(unit_mm) + " mm; taken as units of " + to_text(*unit) +
                                     " mm, so " + rounded(height_mm / unit_mm * *unit) +
                                     " mm tall; --unit-mm states another");
            return again;
        }
    if (!options.keep_vertices) {
        if (!loaded->motion.empty() && options.subdivision_level == 0) number_vertices(mesh);
        drop_unused_vertices(mesh);
    }
    if (mesh.uvs.empty()) warnings.push_back(name.string() + ": no UVs; maps cannot be used");
    warn_of_height(mesh, name, options, is_obj, warnings);
    warn_of_tiles(mesh, name, warnings);
    if (options.keep_vertices) mesh.normals.resize(mesh.positions_mm.size());
    finish_normals(mesh, name, warnings);
    if (options.keep_vertices)
        mesh.tangents.clear();
    else
        complete_tangents(mesh);
    tidy_warnings(warnings);
    return loaded;
}

Result<LoadedMesh> read_mesh(const fs::path& path, const MeshOptions& options) {
    DERMIS_TRY_ASSIGN(const MeshFormat format, format_of(path));
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> bytes, read_file(path));
    std::vector<fs::path> files = {path};
    const ReadSibling read_sibling = [&](const std::string& relative_path) {
        return read_file(files.emplace_back(path.parent_path() / utf8_path(relative_path)));
    };
    Result<LoadedMesh> loaded = parse_mesh(bytes, format, path, read_sibling, options);
    if (loaded) loaded->files = std::move(files);
    return loaded;
}

}  // namespace dermis::inline mesh
