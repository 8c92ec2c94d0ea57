// Wavefront OBJ, one pass over the text: attributes and faces as they come, indices checked when all are
// known. Numbers are read by from_chars, which makes this as fast as the disk; see bench/mesh_bench.cpp.

#include "dermis/mesh/obj.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <unordered_map>

#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/mesh/text_cursor.h"

namespace dermis::inline mesh {
namespace {

constexpr size_t kMaxFaceCorners = 65536;

class ObjParser {
  public:
    ObjParser(std::string_view text, const std::filesystem::path& name, const ReadSibling& read_sibling,
              const MeshOptions& options)
        : lines_(text), name_(name), read_sibling_(read_sibling), options_(options) {}

    Result<ObjFile> run() {
        while (!lines_.done() && !error_) read_line(lines_.next());
        if (!error_) check_indices();
        if (!error_) finish();
        if (error_) return *error_;
        return std::move(file_);
    }

  private:
    void fail(const std::string& text) { fail_at(lines_.line_number(), text); }
    void fail_at(size_t line, const std::string& text) {
        if (!error_) error_ = Error{fmt::format("{}:{}: {}", name_.string(), line, text)};
    }
    void warn(const std::string& text) { file_.warnings.push_back(name_.string() + ": " + text); }

    void read_line(std::string_view line) {
        TextCursor cursor(line);
        const std::string_view keyword = cursor.word();
        if (keyword.empty() || keyword.front() == '#') return;
        if (keyword == "v") return read_position(cursor);
        if (keyword == "vt") return read_uv(cursor);
        if (keyword == "vn") return read_normal(cursor);
        if (keyword == "f") return read_face(cursor);
        if (keyword == "usemtl") return use_material(std::string(trim(cursor.rest())));
        if (keyword == "mtllib") return read_libraries(cursor);
        if (keyword == "curv" || keyword == "curv2" || keyword == "surf") ++free_form_;
    }

    void read_position(TextCursor& cursor) {
        const auto x = cursor.number(), y = cursor.number(), z = cursor.number();
        if (!x || !y || !z) return fail("a vertex needs three numbers, as 'v 1.5 0 -2'");
        if (!std::isfinite(*x) || !std::isfinite(*y) || !std::isfinite(*z))
            return fail("a vertex position must be finite");
        if (polygons_.positions_mm.size() >= options_.max_vertices)
            return fail(fmt::format("more than {} vertices", options_.max_vertices));
        polygons_.positions_mm.push_back({*x, *y, *z});
    }

    void read_uv(TextCursor& cursor) {
        const auto u = cursor.number();
        if (!u) return fail("a texture coordinate needs numbers, as 'vt 0.5 0.5'");
        const float v = cursor.number().value_or(0);
        const bool finite = std::isfinite(*u) && std::isfinite(v);
        bad_uvs_ += !finite;
        // OBJ's UV origin is bottom-left, ours top-left.
        polygons_.uvs.push_back(finite ? Vec2{*u, 1 - v} : Vec2{});
    }

    void read_normal(TextCursor& cursor) {
        const auto x = cursor.number(), y = cursor.number(), z = cursor.number();
        if (!x || !y || !z) return fail("a normal needs three numbers, as 'vn 0 0 1'");
        const Vec3 n = normalize({*x, *y, *z});
        // An invalid direction stays zero; compute_normals fills it.
        polygons_.normals.push_back(std::isfinite(n.x + n.y + n.z) ? n : Vec3{});
    }

    // From 1, or negative from the end; kNoIndex after an error.
    uint32_t resolve(int64_t index, size_t count, const char* what) {
        if (index > 0 && index <= int64_t{UINT32_MAX} - 1) return uint32_t(index - 1);
        if (index < 0 && uint64_t(-(index + 1)) < count) return uint32_t(int64_t(count) + index);
        fail(fmt::format("{} index {} is out of range ({} so far)", what, index, count));
        return kNoIndex;
    }

    struct Corner {
        uint32_t position = kNoIndex, uv = kNoIndex, normal = kNoIndex;
    };

    // "7", "7/3", "7//2" or "7/3/2"
    bool read_corner(TextCursor& cursor, Corner& corner) {
        const auto position = cursor.integer();
        if (!position) return fail("a face corner is a vertex index, as in 'f 1/1 2/2 3/3'"), false;
        corner.position = resolve(*position, polygons_.positions_mm.size(), "vertex");
        if (!cursor.skip('/')) return !error_;
        if (const auto uv = cursor.integer()) corner.uv = resolve(*uv, polygons_.uvs.size(), "UV");
        if (!cursor.skip('/')) return !error_;
        if (const auto normal = cursor.integer())
            corner.normal = resolve(*normal, polygons_.normals.size(), "normal");
        return !error_;
    }

    void read_face(TextCursor& cursor) {
        corners_.clear();
        while (!cursor.at_end() && cursor.rest().front() != '#') {
            Corner corner;
            if (!read_corner(cursor, corner)) return;
            // Exporters write faces that touch one vertex twice in a row; skip the second.
            if (corners_.empty() || corners_.back().position != corner.position) corners_.push_back(corner);
        }
        if (corners_.size() > 1 && corners_.front().position == corners_.back().position) corners_.pop_back();
        if (corners_.size() < 3) return void(++small_faces_);
        if (corners_.size() > kMaxFaceCorners) return fail("a face with more than 65536 corners");
        for (const Corner& corner : corners_) {
            polygons_.corner_positions.push_back(corner.position);
            polygons_.corner_uvs.push_back(corner.uv);
            polygons_.corner_normals.push_back(corner.normal);
            without_uv_ += corner.uv == kNoIndex;
            without_normal_ += corner.normal == kNoIndex;
        }
        if (material_ == kNoIndex) use_material("");
        polygons_.face_sizes.push_back(uint32_t(corners_.size()));
        polygons_.face_materials.push_back(material_);
        face_lines_.push_back(uint32_t(lines_.line_number()));
    }

    void use_material(const std::string& name) {
        const auto [at, is_new] = material_numbers_.try_emplace(name, uint32_t(material_numbers_.size()));
        if (is_new) {
            Material& material = polygons_.materials.emplace_back();
            material.name = name.empty() ? "default" : name;
        }
        material_ = at->second;
    }

    // One line may name several libraries, and a name may have blanks: each ends with ".mtl".
    void read_libraries(TextCursor& cursor) {
        const std::string_view line = trim(cursor.rest());
        const std::string lower = to_lower(line);
        size_t from = 0;
        for (size_t at = 0; (at = lower.find(".mtl", at)) != std::string::npos;) {
            at += 4;
            if (at < line.size() && line[at] != ' ' && line[at] != '\t') continue;
            read_library(std::string(trim(line.substr(from, at - from))));
            from = at;
        }
        if (const std::string_view rest = trim(line.substr(from)); !rest.empty() || from == 0)
            read_library(std::string(rest));
    }

    void read_library(const std::string& library) {
        if (!libraries_read_.insert(library).second || !read_sibling_) return;
        if (libraries_read_.size() > 64) return;
        if (!stays_inside(library))
            return warn("material library '" + library + "' lies outside the mesh's directory; not read");
        const auto bytes = read_sibling_(library);
        if (!bytes) {
            if (!options_.ignore_missing_materials)
                warn("material library not read: " + bytes.error().message);
            return;
        }
        const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
        const std::filesystem::path path = name_.parent_path() / utf8_path(library);
        for (Material& material : parse_mtl(text, path.generic_string(), path.parent_path(), file_.warnings))
            library_.insert_or_assign(material.name, std::move(material));
    }

    void check_indices() {
        size_t corner = 0;
        for (size_t face = 0; face < polygons_.face_count(); ++face) {
            for (uint32_t i = 0; i < polygons_.face_sizes[face]; ++i, ++corner) {
                check_index(face, polygons_.corner_positions[corner], polygons_.positions_mm.size(),
                            "vertex");
                check_index(face, polygons_.corner_uvs[corner], polygons_.uvs.size(), "UV");
                check_index(face, polygons_.corner_normals[corner], polygons_.normals.size(), "normal");
            }
            if (error_) return;
        }
    }

    void check_index(size_t face, uint32_t index, size_t count, const char* what) {
        if (index == kNoIndex || index < count) return;
        fail_at(face_lines_[face], fmt::format("{} index {} is out of range (the file has {})", what,
                                               uint64_t{index} + 1, count));
    }

    void finish() {
        if (polygons_.positions_mm.empty())
            return fail_at(lines_.line_number(), "no vertices; is this an OBJ file?");
        if (polygons_.face_sizes.empty()) return fail_at(lines_.line_number(), "no faces");
        const size_t corners = polygons_.corner_positions.size();
        if (without_uv_ == corners) polygons_.corner_uvs.clear();
        if (without_normal_ == corners) polygons_.corner_normals.clear();
        if (without_uv_ > 0 && without_uv_ < corners)
            warn(std::to_string(without_uv_) + " face corners have no UV; they get (0, 0)");
        if (small_faces_ > 0)
            warn(std::to_string(small_faces_) + " faces with fewer than three corners skipped");
        if (bad_uvs_ > 0) warn(std::to_string(bad_uvs_) + " UVs were not finite; they get (0, 0)");
        const auto fans =
            std::ranges::count_if(polygons_.face_sizes, [](uint32_t size) { return size > kMaxEarClipping; });
        if (fans > 0)
            warn(fmt::format(
                "{} faces of more than {} corners are cut as fans, which is right only if they are convex",
                fans, kMaxEarClipping));
        if (free_form_ > 0) warn(std::to_string(free_form_) + " free-form curves or surfaces skipped");
        std::vector<std::string> unknown;
        for (Material& material : polygons_.materials) {
            const auto found = library_.find(material.name);
            if (found != library_.end())
                material = found->second;
            else if (!libraries_read_.empty() && !library_.empty())
                unknown.push_back("'" + material.name + "'");
        }
        if (!unknown.empty()) warn("materials not in the MTL: " + join(unknown, ", "));
        file_.polygons = std::move(polygons_);
    }

    LineReader lines_;
    std::filesystem::path name_;
    const ReadSibling& read_sibling_;
    const MeshOptions& options_;
    ObjFile file_;
    PolygonMesh polygons_;
    std::optional<Error> error_;
    std::vector<Corner> corners_;
    std::vector<uint32_t> face_lines_;
    std::unordered_map<std::string, uint32_t> material_numbers_;
    std::map<std::string, Material> library_;
    std::set<std::string> libraries_read_;
    uint32_t material_ = kNoIndex;
    size_t without_uv_ = 0, without_normal_ = 0, small_faces_ = 0, bad_uvs_ = 0, free_form_ = 0;
};

}  // namespace

Result<ObjFile> parse_obj(std::string_view text, const std::filesystem::path& name,
                          const ReadSibling& read_sibling, const MeshOptions& options) {
    return ObjParser(text, name, read_sibling, options).run();
}

}  // namespace dermis::inline mesh
