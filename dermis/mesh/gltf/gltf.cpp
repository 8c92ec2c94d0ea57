// The node tree of a glTF file, flattened into one mesh: one submesh a primitive and node.

#include "dermis/mesh/gltf/gltf.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "dermis/mesh/gltf/accessor.h"
#include "dermis/mesh/gltf/document.h"
#include "dermis/mesh/gltf/material.h"
#include "dermis/mesh/gltf/transform.h"

namespace dermis::gltf {
namespace {

enum PrimitiveMode : uint64_t { kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6 };

struct Primitive {
    std::vector<float> positions, normals, tangents, uvs;
    std::vector<uint32_t> indices;  // a triangle list
};

std::vector<uint32_t> triangle_list(std::vector<uint32_t> indices, uint64_t mode) {
    if (mode == kTriangles) {
        indices.resize(indices.size() / 3 * 3);
        return indices;
    }
    std::vector<uint32_t> list;
    for (size_t i = 2; i < indices.size(); ++i) {
        if (mode == kTriangleFan)
            list.insert(list.end(), {indices[i - 1], indices[i], indices[0]});
        else if (i % 2 == 0)
            list.insert(list.end(), {indices[i - 2], indices[i - 1], indices[i]});
        else
            list.insert(list.end(), {indices[i - 1], indices[i - 2], indices[i]});
    }
    return list;
}

bool all_finite(std::span<const float> values) {
    return std::ranges::all_of(values, [](float v) { return std::isfinite(v); });
}

class SceneReader {
  public:
    SceneReader(Document& document, double mm_per_unit) : document_(document), mm_per_unit_(mm_per_unit) {
        material_scales_.assign(document.view()["materials"].size(), 0);
    }

    Mesh run() {
        Affine to_mm;
        for (const size_t i : {0, 4, 8}) to_mm.linear[i] = mm_per_unit_;
        for (const uint64_t root : roots()) visit_tree(root, to_mm);
        if (!failed() && document_.view()["nodes"].size() == 0)  // a bare mesh library
            for (size_t i = 0; i < document_.view()["meshes"].size(); ++i) add_mesh(i, "", to_mm);
        finish();
        return std::move(mesh_);
    }

  private:
    [[nodiscard]] bool failed() const { return document_.complaints.error.has_value(); }

    std::vector<uint64_t> roots() {
        std::vector<uint64_t> found;
        const JsonView scenes = document_.view()["scenes"], nodes = document_.view()["nodes"];
        visited_.assign(nodes.size(), false);
        if (scenes.size() > 0) {
            const JsonView list = scenes[size_t(document_.view()["scene"].integer(0))]["nodes"];
            for (size_t i = 0; i < list.size(); ++i) found.push_back(list[i].integer(0));
            return found;
        }
        std::vector<bool> is_child(nodes.size(), false);
        for (size_t i = 0; i < nodes.size(); ++i) {
            const JsonView children = nodes[i]["children"];
            for (size_t k = 0; k < children.size(); ++k)
                if (const uint64_t child = children[k].integer(0); child < is_child.size())
                    is_child[size_t(child)] = true;
        }
        for (size_t i = 0; i < nodes.size(); ++i)
            if (!is_child[i]) found.push_back(i);
        return found;
    }

    static Affine local_transform(const JsonView& node) {
        if (node["matrix"].exists())
            return affine_of_matrix(
                node["matrix"].numbers<16>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
        return affine_of_trs(node["translation"].numbers<3>({0, 0, 0}),
                             node["rotation"].numbers<4>({0, 0, 0, 1}), node["scale"].numbers<3>({1, 1, 1}));
    }

    void visit_tree(uint64_t root, const Affine& to_mm) {
        std::vector<std::pair<uint64_t, Affine>> open = {{root, to_mm}};
        while (!open.empty() && !failed()) {
            const auto [index, parent] = open.back();
            open.pop_back();
            const JsonView node = document_.view()["nodes"][size_t(index)];
            if (failed()) return;
            // A node has one parent at most; otherwise a few nodes could unfold into billions.
            if (visited_[size_t(index)]) return node.fail("is reached twice; nodes must form a tree");
            visited_[size_t(index)] = true;
            const Affine world = compose(parent, local_transform(node));
            const bool skinned = node["skin"].exists();
            if (skinned) node.warn("is skinned; its bind pose is shown");
            if (node["mesh"].exists())  // a skinned mesh ignores its node's transform (section 3.7.3.3)
                add_mesh(node["mesh"].integer(0), node["name"].text(""), skinned ? to_mm : world);
            const JsonView children = node["children"];
            for (size_t i = children.size(); i-- > 0;) open.emplace_back(children[i].integer(0), world);
        }
    }

    void add_mesh(uint64_t index, const std::string& node_name, const Affine& world) {
        const JsonView mesh = document_.view()["meshes"][size_t(index)];
        const JsonView primitives = mesh["primitives"];
        const std::string name = mesh["name"].text(node_name);
        for (size_t i = 0; i < primitives.size() && !failed(); ++i) {
            Primitive primitive;
            if (read_primitive(primitives[i], primitive)) append(primitives[i], name, primitive, world);
        }
    }

    std::vector<float> read_attribute(const JsonView& view, size_t components) {
        if (!view.exists()) return {};
        const uint64_t accessor = view.integer(0);
        return view.failed() ? std::vector<float>{} : read_floats(document_, accessor, components);
    }

    bool read_primitive(const JsonView& source, Primitive& primitive) {
        const uint64_t mode = source["mode"].integer(kTriangles);
        if (mode < kTriangles) return source.warn("is points or lines; skipped"), false;
        if (mode > kTriangleFan) return source["mode"].fail("must be 0 to 6"), false;
        if (source["targets"].exists()) source.warn("has morph targets, which are ignored");
        const JsonView attributes = source["attributes"];
        if (!attributes["POSITION"].exists()) return source.warn("has no POSITION; skipped"), false;
        primitive.positions = read_attribute(attributes["POSITION"], 3);
        primitive.normals = read_attribute(attributes["NORMAL"], 3);
        primitive.tangents = read_attribute(attributes["TANGENT"], 4);
        primitive.uvs = read_attribute(attributes["TEXCOORD_0"], 2);
        if (failed()) return false;
        if (!all_finite(primitive.positions)) return attributes["POSITION"].fail("must be finite"), false;
        const size_t count = primitive.positions.size() / 3;
        vertices_read_ += count;
        if (vertices_read_ > document_.max_vertices)
            return source.fail("more vertices than dermis loads"), false;
        check_count(attributes["NORMAL"], primitive.normals.size() / 3, count);
        check_count(attributes["TANGENT"], primitive.tangents.size() / 4, count);
        check_count(attributes["TEXCOORD_0"], primitive.uvs.size() / 2, count);
        read_indices_of(source, mode, count, primitive);
        return !failed();
    }

    static void check_count(const JsonView& attribute, size_t count, size_t expected) {
        if (attribute.exists() && count != expected)
            attribute.fail("has " + std::to_string(count) + " elements for " + std::to_string(expected) +
                           " positions");
    }

    void read_indices_of(const JsonView& source, uint64_t mode, size_t vertex_count, Primitive& primitive) {
        std::vector<uint32_t> indices;
        if (source["indices"].exists()) {
            const uint64_t accessor = source["indices"].integer(0);
            if (failed()) return;
            indices = read_indices(document_, accessor);
            for (const uint32_t index : indices)
                if (index >= vertex_count)
                    return source["indices"].fail("index " + std::to_string(index) + " is out of range (" +
                                                  std::to_string(vertex_count) + " vertices)");
        } else {
            for (uint32_t i = 0; i < vertex_count; ++i) indices.push_back(i);
        }
        primitive.indices = triangle_list(std::move(indices), mode);
    }

    uint32_t material_of(const JsonView& source, const Affine& world) {
        if (!source["material"].exists()) return kDefaultMaterial;
        const uint64_t material = source["material"].integer(0);
        if (material >= material_scales_.size())
            return source["material"].fail("material " + std::to_string(material) + " does not exist"), 0;
        double& scale = material_scales_[size_t(material)];
        if (scale == 0) scale = std::cbrt(std::abs(world.determinant())) / mm_per_unit_;
        return uint32_t(material);
    }

    void append(const JsonView& source, const std::string& name, Primitive& primitive, const Affine& world) {
        if (primitive.indices.empty()) return;
        const size_t first = mesh_.positions_mm.size(), count = primitive.positions.size() / 3;
        if (mesh_.indices.size() + primitive.indices.size() > 6 * document_.max_vertices)
            return source.fail("more triangles than dermis loads");
        const Affine to_normal = world.for_normals();
        const bool mirrored = world.determinant() < 0;
        const auto vec3 = [](const std::vector<float>& v, size_t at) {
            return Vec3{v[at], v[at + 1], v[at + 2]};
        };
        for (size_t i = 0; i < count; ++i) {
            mesh_.positions_mm.push_back(world.point(vec3(primitive.positions, 3 * i)));
            const Vec3 n =
                primitive.normals.empty() ? Vec3{} : to_normal.direction(vec3(primitive.normals, 3 * i));
            mesh_.normals.push_back(n);
            mesh_.uvs.push_back(primitive.uvs.empty() ? Vec2{}
                                                      : Vec2{primitive.uvs[2 * i], primitive.uvs[2 * i + 1]});
            Vec4 tangent;
            if (!primitive.tangents.empty()) {
                const Vec3 t = world.direction(vec3(primitive.tangents, 4 * i));
                const float sign = primitive.tangents[4 * i + 3] < 0 ? -1.0f : 1.0f;
                tangent = {t.x, t.y, t.z, mirrored ? -sign : sign};
            }
            mesh_.tangents.push_back(tangent);
        }
        any_normals_ |= !primitive.normals.empty();
        any_uvs_ |= !primitive.uvs.empty();
        all_tangents_ &= !primitive.tangents.empty();
        if (primitive.uvs.empty()) without_uvs_ += count;
        mesh_.submeshes.push_back({.name = name,
                                   .first_index = uint32_t(mesh_.indices.size()),
                                   .index_count = uint32_t(primitive.indices.size()),
                                   .material = material_of(source, world)});
        // A mirrored triangle shows its back; turning it round keeps fronts outside.
        for (size_t i = 0; i < primitive.indices.size(); i += 3) {
            if (mirrored) std::swap(primitive.indices[i + 1], primitive.indices[i + 2]);
            for (size_t k = 0; k < 3; ++k)
                mesh_.indices.push_back(uint32_t(first) + primitive.indices[i + k]);
        }
    }

    void finish() {
        if (failed()) return;
        if (mesh_.indices.empty()) return document_.complaints.fail("", "no triangles in the default scene");
        if (!any_normals_) mesh_.normals.clear();
        if (!any_uvs_) mesh_.uvs.clear();
        if (!all_tangents_) mesh_.tangents.clear();
        if (any_uvs_ && without_uvs_ > 0)
            document_.complaints.warn("",
                                      std::to_string(without_uvs_) + " vertices have no UV; they get (0, 0)");
        mesh_.materials = read_materials(document_, mm_per_unit_, material_scales_);
        const auto default_number = uint32_t(mesh_.materials.size());
        for (Submesh& submesh : mesh_.submeshes)
            if (submesh.material == kDefaultMaterial) submesh.material = default_number;
        const bool uses_default = std::ranges::any_of(
            mesh_.submeshes, [&](const Submesh& submesh) { return submesh.material == default_number; });
        if (uses_default) mesh_.materials.emplace_back().name = "default";
    }

    static constexpr uint32_t kDefaultMaterial = ~0u;
    Document& document_;
    double mm_per_unit_;
    Mesh mesh_;
    std::vector<bool> visited_;
    std::vector<double> material_scales_;  // of the first node that uses each; 0 while unused
    bool any_normals_ = false, any_uvs_ = false, all_tangents_ = true;
    size_t vertices_read_ = 0, without_uvs_ = 0;
};

}  // namespace

Result<LoadedMesh> parse_gltf(std::span<const std::byte> bytes, const std::filesystem::path& name,
                              const ReadSibling& read_sibling, const MeshOptions& options) {
    Document document;
    open_document(bytes, name, read_sibling, options, document);
    LoadedMesh loaded;
    if (!document.complaints.error) loaded.mesh = SceneReader(document, options.unit_mm.value_or(1000)).run();
    if (document.complaints.error) return *document.complaints.error;
    loaded.warnings = std::move(document.complaints.warnings);
    return loaded;
}

}  // namespace dermis::gltf
