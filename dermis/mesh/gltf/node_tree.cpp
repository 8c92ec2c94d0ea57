// Walks the default scene first and then what is left: a node's place does not depend on being drawn.

#include "dermis/mesh/gltf/node_tree.h"

#include <fmt/core.h>
#include <Eigen/Geometry>
#include <cmath>
#include <utility>

namespace dermis::inline mesh::gltf {
namespace {

class TreeReader {
  public:
    TreeReader(Document& document, const Affine& to_mm, const NodePoses& poses)
        : document_(document), to_mm_(to_mm), poses_(poses) {}

    NodeTree run() {
        const JsonView nodes = document_.view()["nodes"];
        if (nodes.size() > document_.max_nodes)
            nodes.fail(
                fmt::format("are {}, more than the {} that dermis loads", nodes.size(), document_.max_nodes));
        if (document_.messages.error) return {};
        tree_.world.assign(nodes.size(), Affine{});
        visited_.assign(nodes.size(), false);
        const std::vector<uint64_t> parentless = find_parentless();
        const JsonView scenes = document_.view()["scenes"];
        if (scenes.size() > 0) {
            const JsonView list = scenes[size_t(document_.view()["scene"].integer(0))]["nodes"];
            for (size_t i = 0; i < list.size(); ++i) visit(list[i].integer(0), true);
        }
        for (const uint64_t root : parentless)
            if (!visited_[size_t(root)]) visit(root, scenes.size() == 0);
        return std::move(tree_);
    }

  private:
    std::vector<uint64_t> find_parentless() {
        const JsonView nodes = document_.view()["nodes"];
        std::vector<bool> is_child(nodes.size(), false);
        for (size_t i = 0; i < nodes.size(); ++i) {
            const JsonView children = nodes[i]["children"];
            for (size_t k = 0; k < children.size(); ++k)
                if (const uint64_t child = children[k].integer(0); child < is_child.size())
                    is_child[size_t(child)] = true;
        }
        std::vector<uint64_t> found;
        for (size_t i = 0; i < nodes.size(); ++i)
            if (!is_child[i]) found.push_back(i);
        return found;
    }

    [[nodiscard]] Affine local_transform(const JsonView& node, uint64_t index) const {
        if (node["matrix"].exists())
            return affine_of_matrix(
                node["matrix"].numbers<16>({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}));
        auto t = node["translation"].numbers<3>({0, 0, 0}), s = node["scale"].numbers<3>({1, 1, 1});
        auto q = node["rotation"].numbers<4>({0, 0, 0, 1});
        if (const auto pose = poses_.find(index); pose != poses_.end()) {
            t = pose->second.translation.value_or(t);
            q = pose->second.rotation.value_or(q);
            s = pose->second.scale.value_or(s);
        }
        return affine_of(t, q, s);
    }

    void visit(uint64_t root, bool drawn) {
        std::vector<std::pair<uint64_t, Affine>> open = {{root, to_mm_}};
        while (!open.empty() && !document_.messages.error) {
            const auto [index, parent] = open.back();
            open.pop_back();
            const JsonView node = document_.view()["nodes"][size_t(index)];
            if (node.failed()) return;
            // A node has one parent at most; otherwise a few nodes could unfold into billions.
            if (visited_[size_t(index)]) return node.fail("is reached twice; nodes must form a tree");
            visited_[size_t(index)] = true;
            const Affine world = compose(parent, local_transform(node, index));
            tree_.world[size_t(index)] = world;
            if (drawn && node["mesh"].exists()) tree_.drawn.push_back(index);
            const JsonView children = node["children"];
            for (size_t i = children.size(); i-- > 0;) open.emplace_back(children[i].integer(0), world);
        }
    }

    Document& document_;
    Affine to_mm_;
    const NodePoses& poses_;
    NodeTree tree_;
    std::vector<bool> visited_;
};

}  // namespace

NodeTree read_nodes(Document& document, const Affine& to_mm, const NodePoses& poses) {
    return TreeReader(document, to_mm, poses).run();
}

Affine Affine::for_normals() const {
    Affine normals;
    for (int i = 0; i < 3; ++i)  // the cofactors
        normals.linear.row(i) = linear.row((i + 1) % 3).cross(linear.row((i + 2) % 3));
    // Scaled so that the result stays within a float's range; the sign undoes a mirroring's.
    const double largest = normals.linear.cwiseAbs().maxCoeff();
    if (largest == 0) return {};  // flattened to a line or a point: any normal will do
    normals.linear *= std::copysign(1 / largest, linear.determinant());
    return normals;
}

Affine affine_of(const std::array<double, 3>& translation, const std::array<double, 4>& rotation,
                 const std::array<double, 3>& scale) {
    const Eigen::Matrix3d turn = Eigen::Quaterniond(rotation[3], rotation[0], rotation[1], rotation[2])
                                     .normalized()
                                     .toRotationMatrix();
    return {turn * Eigen::Vector3d(scale.data()).asDiagonal(), Eigen::Vector3d(translation.data())};
}

Affine affine_of_matrix(const std::array<double, 16>& m) {
    const Eigen::Map<const Eigen::Matrix4d> matrix(m.data());
    return {matrix.topLeftCorner<3, 3>(), matrix.topRightCorner<3, 1>()};
}

}  // namespace dermis::inline mesh::gltf
