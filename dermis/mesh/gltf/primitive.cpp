#include "dermis/mesh/gltf/primitive.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "dermis/mesh/gltf/accessor.h"

namespace dermis::inline mesh::gltf {
namespace {

// glTF 2.0, section 3.7.3: a skinned vertex is the weighted sum of its joints' world matrices times their
// inverse bind matrices; the transform of the mesh's own node does not count.
constexpr size_t kMaxInfluenceSets = 16;

// Messages are of `view`.
void normalize_weights(Influences& influences, const JsonView& view) {
    constexpr double kOf8Bits = 0.01;  // four weights, each rounded
    size_t scaled = 0, without = 0;
    for (size_t first = 0; first < influences.weights.size(); first += influences.per_vertex) {
        const std::span<float> weights = std::span(influences.weights).subspan(first, influences.per_vertex);
        double sum = 0;
        for (float& weight : weights) {
            if (!(weight > 0) || !std::isfinite(weight)) weight = 0;
            sum += weight;
        }
        scaled += sum > 0 && std::abs(sum - 1) > kOf8Bits;
        without += !(sum > 0);
        if (sum > 0)
            for (float& weight : weights) weight = float(weight / sum);
    }
    if (scaled > 0)
        view.warn(fmt::format("the weights of {} vertices do not sum to 1; scaled to it", scaled));
    if (without > 0) view.warn(std::to_string(without) + " vertices have no weight; they follow no joint");
}

}  // namespace

std::vector<Affine> inverse_bind_matrices(Document& document, const JsonView& skin, size_t joints) {
    std::vector<Affine> matrices(joints);
    if (!skin["inverseBindMatrices"].exists()) return matrices;
    const uint64_t accessor = skin["inverseBindMatrices"].integer(0);
    if (skin.failed()) return {};
    const std::vector<float> numbers = read_floats(document, accessor, 16);
    if (skin.failed()) return {};
    if (numbers.size() / 16 < joints)
        return skin["inverseBindMatrices"].fail(
                   fmt::format("has {} matrices for {} joints", numbers.size() / 16, joints)),
               std::vector<Affine>{};
    for (size_t joint = 0; joint < joints; ++joint) {
        std::array<double, 16> m{};
        for (size_t i = 0; i < 16; ++i) {
            m[i] = numbers[16 * joint + i];
            if (!std::isfinite(m[i]))
                return skin["inverseBindMatrices"].fail("must be finite"), std::vector<Affine>{};
        }
        matrices[joint] = affine_of_matrix(m);
    }
    return matrices;
}

std::vector<Affine> joint_matrices(Document& document, uint64_t index, std::span<const Affine> world) {
    const JsonView skin = document.view()["skins"][size_t(index)];
    const JsonView joints = skin["joints"];
    if (skin.failed()) return {};
    if (joints.size() == 0) return skin.fail("has no joints"), std::vector<Affine>{};
    std::vector<Affine> matrices = inverse_bind_matrices(document, skin, joints.size());
    for (size_t i = 0; i < matrices.size(); ++i) {
        const uint64_t node = joints[i].integer(0);
        if (skin.failed()) return {};
        if (node >= world.size())
            return joints[i].fail(fmt::format("node {} does not exist", node)), std::vector<Affine>{};
        matrices[i] = compose(world[size_t(node)], matrices[i]);
    }
    return matrices;
}

Influences read_influences(Document& document, const JsonView& attributes, size_t vertex_count,
                           size_t joint_count) {
    size_t sets = 0;
    while (sets < kMaxInfluenceSets && attributes[("JOINTS_" + std::to_string(sets)).c_str()].exists())
        ++sets;
    Influences influences{.per_vertex = 4 * sets, .joints = {}, .weights = {}};
    influences.joints.resize(vertex_count * influences.per_vertex);
    influences.weights.resize(vertex_count * influences.per_vertex);
    for (size_t set = 0; set < sets; ++set) {
        const JsonView joint_view = attributes[("JOINTS_" + std::to_string(set)).c_str()],
                       weight_view = attributes[("WEIGHTS_" + std::to_string(set)).c_str()];
        if (!weight_view.exists()) return joint_view.fail("has no WEIGHTS beside it"), Influences{};
        const std::vector<float> joints = read_floats(document, joint_view.integer(0), 4),
                                 weights = read_floats(document, weight_view.integer(0), 4);
        if (attributes.failed()) return {};
        if (joints.size() != 4 * vertex_count || weights.size() != 4 * vertex_count)
            return joint_view.fail("and its weights need one element a position"), Influences{};
        for (size_t i = 0; i < joints.size(); ++i) {
            const size_t at = i / 4 * influences.per_vertex + 4 * set + i % 4;
            influences.weights[at] = weights[i];
            if (weights[i] != 0 && !(joints[i] >= 0 && joints[i] < float(joint_count)))
                return joint_view.fail(fmt::format("a joint is out of range (the skin has {})", joint_count)),
                       Influences{};
            if (weights[i] != 0) influences.joints[at] = uint32_t(joints[i]);
        }
    }
    if (sets > 0) normalize_weights(influences, attributes["WEIGHTS_0"]);
    return influences;
}

Affine blend(std::span<const Affine> joints, const Influences& influences, size_t vertex,
             const Affine& unskinned) {
    Affine sum{Eigen::Matrix3d::Zero(), Eigen::Vector3d::Zero()};
    bool any = false;
    for (size_t i = vertex * influences.per_vertex; i < (vertex + 1) * influences.per_vertex; ++i) {
        const double weight = influences.weights[i];
        if (weight == 0) continue;
        any = true;
        const Affine& joint = joints[influences.joints[i]];
        sum.linear += weight * joint.linear;
        sum.offset += weight * joint.offset;
    }
    return any ? sum : unskinned;
}

namespace {

enum PrimitiveMode : uint64_t { kTriangles = 4, kTriangleStrip = 5, kTriangleFan = 6 };

// One run of indices without a restart.
void append_triangles(std::span<const uint32_t> run, uint64_t mode, std::vector<uint32_t>& list) {
    if (mode == kTriangles) {
        list.insert(list.end(), run.begin(), run.begin() + std::ptrdiff_t(run.size() / 3 * 3));
        return;
    }
    for (size_t i = 2; i < run.size(); ++i) {
        if (mode == kTriangleFan)
            list.insert(list.end(), {run[i - 1], run[i], run[0]});
        else if (i % 2 == 0)
            list.insert(list.end(), {run[i - 2], run[i - 1], run[i]});
        else
            list.insert(list.end(), {run[i - 1], run[i - 2], run[i]});
    }
}

std::vector<uint32_t> triangle_list(std::span<const uint32_t> indices, uint64_t mode) {
    std::vector<uint32_t> list;
    for (size_t first = 0; first < indices.size();) {
        const auto rest = indices.subspan(first);
        const auto run = size_t(std::ranges::find(rest, kRestart) - rest.begin());
        append_triangles(rest.first(run), mode, list);
        first += run + 1;
    }
    return list;
}

bool all_finite(std::span<const float> values) {
    return std::ranges::all_of(values, [](float v) { return std::isfinite(v); });
}

// As many elements as there are positions, or none and an error; any number if `count` is 0.
std::vector<float> read_elements(Document& document, const JsonView& view, size_t components, size_t count) {
    if (!view.exists() || view.failed()) return {};
    const uint64_t accessor = view.integer(0);
    if (view.failed()) return {};
    std::vector<float> values = read_floats(document, accessor, components);
    const size_t found = values.size() / components;
    if (count == 0 || found == count) return values;
    if (!view.failed()) view.fail(fmt::format("has {} elements for {} positions", found, count));
    return {};
}

class PrimitiveReader {
  public:
    PrimitiveReader(Document& document, const JsonView& source, const PrimitiveOptions& options,
                    Primitive& primitive)
        : document_(document),
          source_(source),
          attributes_(source["attributes"]),
          options_(options),
          primitive_(primitive) {}

    bool run() {
        const uint64_t mode = source_["mode"].integer(kTriangles);
        if (mode < kTriangles) return source_.warn("is points or lines; skipped"), false;
        if (mode > kTriangleFan) return source_["mode"].fail("must be 0 to 6"), false;
        if (!attributes_["POSITION"].exists()) return source_.warn("has no POSITION; skipped"), false;
        primitive_.positions = read(attributes_["POSITION"], 3);
        if (source_.failed()) return false;
        count_ = primitive_.positions.size() / 3;
        primitive_.normals = read(attributes_["NORMAL"], 3);
        // Without normals tangents do not count (section 3.7.2.1).
        if (attributes_["NORMAL"].exists()) primitive_.tangents = read(attributes_["TANGENT"], 4);
        read_uvs();
        read_colors();
        if (options_.joint_count > 0 && !source_.failed())
            primitive_.influences = read_influences(document_, attributes_, count_, options_.joint_count);
        if (source_.failed()) return false;
        read_triangles(mode);
        return !source_.failed();
    }

  private:
    std::vector<float> read(const JsonView& view, size_t components) {
        return read_elements(document_, view, components, count_);
    }

    void read_uvs() {
        const UvMapping& mapping = options_.uv_mapping;
        primitive_.uvs = read(attributes_[("TEXCOORD_" + std::to_string(mapping.set)).c_str()], 2);
        for (size_t i = 0; i + 1 < primitive_.uvs.size(); i += 2) {
            const Vec2 uv = mapping.apply({primitive_.uvs[i], primitive_.uvs[i + 1]});
            primitive_.uvs[i] = uv.x, primitive_.uvs[i + 1] = uv.y;
        }
        // The file's tangents follow the UVs before they are turned.
        if (!mapping.keeps_directions()) primitive_.tangents.clear();
    }

    void read_colors() {
        const JsonView view = attributes_["COLOR_0"];
        if (!view.exists() || view.failed()) return;
        const JsonView accessor = document_.view()["accessors"][size_t(view.integer(0))];
        const bool alpha = !accessor.failed() && accessor["type"].text("") == "VEC4";
        const std::vector<float> values = read(view, alpha ? 4 : 3);
        if (view.failed()) return;
        for (size_t i = 0; i < values.size(); i += alpha ? 4 : 3) {
            for (size_t c = 0; c < 3; ++c) primitive_.colors.push_back(values[i + c]);
            primitive_.colors.push_back(alpha ? values[i + 3] : 1.0f);
        }
        size_t wrong = 0;
        for (float& value : primitive_.colors)
            if (!(value >= 0 && std::isfinite(value))) value = 0, ++wrong;
        if (wrong > 0) view.warn(std::to_string(wrong) + " numbers are below 0 or not finite; they are 0");
    }

    void read_triangles(uint64_t mode) {
        std::vector<uint32_t> indices;
        if (source_["indices"].exists()) {
            const uint64_t accessor = source_["indices"].integer(0);
            if (source_.failed()) return;
            indices = read_indices(document_, accessor);
            for (const uint32_t index : indices)
                if (index >= count_ && index != kRestart)
                    return source_["indices"].fail(
                        fmt::format("index {} is out of range ({} vertices)", index, count_));
        } else {
            for (uint32_t i = 0; i < count_; ++i) indices.push_back(i);
        }
        primitive_.indices = triangle_list(indices, mode);
    }

    Document& document_;
    JsonView source_, attributes_;
    const PrimitiveOptions& options_;
    Primitive& primitive_;
    size_t count_ = 0;
};

}  // namespace

namespace {

MorphTarget read_target(Document& document, const JsonView& target, size_t count) {
    MorphTarget read{.has_normals = target["NORMAL"].exists()};
    const std::vector<float> changes = read_elements(document, target["POSITION"], 3, count);
    for (size_t i = 0; i + 2 < changes.size(); i += 3) {
        const Vec3 change = {changes[i], changes[i + 1], changes[i + 2]};
        if (change == Vec3{}) continue;
        read.moved.push_back(uint32_t(i / 3));
        read.changes.push_back(change);
    }
    read.normals = read_elements(document, target["NORMAL"], 3, count);
    read.tangents = read_elements(document, target["TANGENT"], 3, count);
    return read;
}

void add_changes(const MorphTarget& target, float weight, std::vector<float>& positions) {
    for (size_t i = 0; i < target.moved.size(); ++i) {
        float* p = &positions[3 * size_t(target.moved[i])];
        const Vec3 change = weight * target.changes[i];
        p[0] += change.x, p[1] += change.y, p[2] += change.z;
    }
}

void add_scaled(const std::vector<float>& change, float weight, std::vector<float>& values,
                size_t components) {
    for (size_t i = 0; i < change.size() && i / 3 * components < values.size(); ++i)
        values[i / 3 * components + i % 3] += weight * change[i];
}

}  // namespace

const MorphTarget& morph_target(Document& document, const JsonView& source, Primitive& primitive,
                                size_t index) {
    primitive.targets.resize(std::max(primitive.targets.size(), index + 1));
    std::optional<MorphTarget>& target = primitive.targets[index];
    if (!target) target = read_target(document, source["targets"][index], primitive.positions.size() / 3);
    return *target;
}

MorphedVertices morph(Document& document, const JsonView& source, Primitive& primitive,
                      std::span<const float> weights) {
    MorphedVertices morphed{.positions = primitive.positions,
                            .normals = primitive.normals,
                            .tangents = primitive.tangents,
                            .unmorphed = {}};
    const size_t count = std::min(source["targets"].size(), weights.size());
    for (size_t i = 0; i < count && !source.failed(); ++i) {
        const float weight = weights[i];
        if (weight == 0) continue;
        const MorphTarget& target = morph_target(document, source, primitive, i);
        if (!target.has_normals && morphed.unmorphed.empty()) morphed.unmorphed = morphed.positions;
        add_changes(target, weight, morphed.positions);
        if (target.has_normals && !morphed.unmorphed.empty()) add_changes(target, weight, morphed.unmorphed);
        add_scaled(target.normals, weight, morphed.normals, 3);
        add_scaled(target.tangents, weight, morphed.tangents, 4);
    }
    if (!source.failed() && !all_finite(morphed.positions))
        source["attributes"]["POSITION"].fail("must be finite");
    return morphed;
}

bool read_primitive(Document& document, const JsonView& source, const PrimitiveOptions& options,
                    Primitive& primitive) {
    return PrimitiveReader(document, source, options, primitive).run();
}

}  // namespace dermis::inline mesh::gltf
