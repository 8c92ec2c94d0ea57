// glTF 2.0, section 3.7.3: a skinned vertex is the weighted sum of its joints' world matrices times their
// inverse bind matrices; the transform of the mesh's own node does not count.

#include "dermis/mesh/gltf/skin.h"

#include <cmath>

#include "dermis/mesh/gltf/accessor.h"

namespace dermis::inline mesh::gltf {
namespace {

constexpr size_t kMaxInfluenceSets = 16;

std::vector<Affine> inverse_bind_matrices(Document& document, const JsonView& skin, size_t joints) {
    std::vector<Affine> matrices(joints);
    if (!skin["inverseBindMatrices"].exists()) return matrices;
    const uint64_t accessor = skin["inverseBindMatrices"].integer(0);
    if (skin.failed()) return {};
    const std::vector<float> numbers = read_floats(document, accessor, 16);
    if (skin.failed()) return {};
    if (numbers.size() / 16 < joints)
        return skin["inverseBindMatrices"].fail("has " + std::to_string(numbers.size() / 16) +
                                                " matrices for " + std::to_string(joints) + " joints"),
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
        view.warn("the weights of " + std::to_string(scaled) + " vertices do not sum to 1; scaled to it");
    if (without > 0) view.warn(std::to_string(without) + " vertices have no weight; they follow no joint");
}

}  // namespace

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
            return joints[i].fail("node " + std::to_string(node) + " does not exist"), std::vector<Affine>{};
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
                return joint_view.fail("a joint is out of range (the skin has " +
                                       std::to_string(joint_count) + ")"),
                       Influences{};
            if (weights[i] != 0) influences.joints[at] = uint32_t(joints[i]);
        }
    }
    if (sets > 0) normalize_weights(influences, attributes["WEIGHTS_0"]);
    return influences;
}

Affine blend(std::span<const Affine> joints, const Influences& influences, size_t vertex,
             const Affine& unskinned) {
    Affine sum{.linear = {}, .offset = {}};
    bool any = false;
    for (size_t i = vertex * influences.per_vertex; i < (vertex + 1) * influences.per_vertex; ++i) {
        const double weight = influences.weights[i];
        if (weight == 0) continue;
        any = true;
        const Affine& joint = joints[influences.joints[i]];
        for (size_t k = 0; k < 9; ++k) sum.linear[k] += weight * joint.linear[k];
        for (size_t k = 0; k < 3; ++k) sum.offset[k] += weight * joint.offset[k];
    }
    return any ? sum : unskinned;
}

}  // namespace dermis::inline mesh::gltf
