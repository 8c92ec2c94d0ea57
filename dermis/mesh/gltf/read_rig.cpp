// The rig of a glTF file for vertices that were read of it: Mesh::file_vertices say which is which.

#include <fmt/core.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "dermis/mesh/follow_normals.h"
#include "dermis/mesh/gltf/accessor.h"
#include "dermis/mesh/gltf/animation.h"
#include "dermis/mesh/gltf/document.h"
#include "dermis/mesh/gltf/instances.h"
#include "dermis/mesh/normals.h"
#include "dermis/mesh/rig.h"

namespace dermis::inline mesh {
namespace gltf {
namespace {

constexpr size_t kSet = 4;  // joints of an attribute JOINTS_n

using Influence = std::pair<uint16_t, float>;  // joint of the skin, weight

// What the file states of the vertices that one node draws, in units of the file.
struct NodeVertices {
    std::vector<Vec3> positions, normals;  // normals: zero where the file has none
    std::vector<Affine> world;
    std::vector<std::vector<Influence>> influences;
    std::vector<RigTarget> targets;
    std::vector<std::vector<bool>> follows;  // by target: vertices that it moves without a normal
};

Vec3 vec3_at(const std::vector<float>& numbers, size_t i) {
    return numbers.empty() ? Vec3{} : Vec3{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
}

Vec4 local_tangent(Vec4 tangent, Vec3 normal, const Affine& world) {
    const Eigen::Vector3d t(tangent.x, tangent.y, tangent.z);
    const Eigen::Matrix3d& m = world.linear;
    const double volume = m.determinant();
    const Eigen::Vector3d v = volume == 0 ? t : Eigen::Vector3d(m.inverse() * t);
    Vec3 along = {float(v.x()), float(v.y()), float(v.z())};
    along = along - normal * dot(normal, along);
    if (!(length(along) > 0))
        along = cross(normal, std::abs(normal.x) < 0.9f ? Vec3{1, 0, 0} : Vec3{0, 1, 0});
    along = normalize(along);
    return {along.x, along.y, along.z, volume < 0 ? -tangent.w : tangent.w};
}

// The others turn with the surface, which a target moves without saying how they turn.
void follow_surface(const Mesh& mesh, const std::vector<bool>& follows, RigTarget& target) {
    Mesh moved = mesh;
    std::vector<Vec3> before = mesh.positions_mm;
    for (size_t v = 0; v < before.size(); ++v) {
        moved.positions_mm[v] += target.moves_mm[v];
        moved.normals[v] += target.turns[v];
        if (!follows[v]) before[v] = moved.positions_mm[v];
    }
    moved.tangents.resize(before.size());
    turn_normals(before, moved);
    for (size_t v = 0; v < before.size(); ++v) target.turns[v] = moved.normals[v] - mesh.normals[v];
}

class RigReader {
  public:
    RigReader(Document& document, const Mesh& mesh, const Pose& pose, const RigNode& root)
        : document_(document),
          mesh_(mesh),
          pose_(pose),
          instances_(document, affine_of(root.translation, root.rotation, root.scale)) {
        rig_.nodes.push_back(root);
    }

    Rig run() {
        const std::vector<Instance> instances = instances_.in_pose(pose_);
        if (failed()) return {};
        add_nodes();
        add_skins();
        const auto of_one_node = [](const Instance& a, const Instance& b) {
            return a.placement == b.placement;
        };
        for (auto first = instances.begin(); first != instances.end();) {
            const auto end = std::find_if(first, instances.end(),
                                          [&](const Instance& one) { return !of_one_node(*first, one); });
            add_part({first, end});
            first = end;
        }
        add_clips();
        size_t found = 0;
        for (const RigPart& part : rig_.parts) found += part.mesh.submeshes.size();
        if (found != mesh_.submeshes.size()) document_.messages.fail("", "has other vertices than before");
        return std::move(rig_);
    }

  private:
    [[nodiscard]] bool failed() const { return document_.messages.error.has_value(); }

    void add_nodes() {
        const JsonView nodes = document_.view()["nodes"];
        std::vector<bool> is_child(nodes.size(), false);
        for (size_t i = 0; i < nodes.size() && !failed(); ++i) {
            RigNode node = {.name = nodes[i]["name"].text("")};
            const JsonView children = nodes[i]["children"];
            for (size_t k = 0; k < children.size(); ++k) {
                const uint64_t child = children[k].integer(0);
                node.children.push_back(uint32_t(child + 1));
                is_child.at(size_t(child)) = true;  // read_nodes() has checked it
            }
            const auto posed = instances_.node_poses().find(i);
            const NodePose pose = posed == instances_.node_poses().end() ? NodePose{} : posed->second;
            if (nodes[i]["matrix"].exists()) node.matrix = nodes[i]["matrix"].numbers<16>({});
            node.translation = pose.translation.value_or(nodes[i]["translation"].numbers<3>({0, 0, 0}));
            node.rotation = pose.rotation.value_or(nodes[i]["rotation"].numbers<4>({0, 0, 0, 1}));
            node.scale = pose.scale.value_or(nodes[i]["scale"].numbers<3>({1, 1, 1}));
            rig_.nodes.push_back(std::move(node));
        }
        for (size_t i = 0; i < is_child.size(); ++i)
            if (!is_child[i]) rig_.nodes[0].children.push_back(uint32_t(i + 1));
    }

    void add_skins() {
        const JsonView skins = document_.view()["skins"];
        for (size_t i = 0; i < skins.size() && !failed(); ++i) {
            const JsonView joints = skins[i]["joints"];
            (void)joint_matrices(document_, i, instances_.tree().world);  // checks the joints
            if (failed()) return;
            RigSkin& skin = rig_.skins.emplace_back();
            const std::vector<Affine> binds = inverse_bind_matrices(document_, skins[i], joints.size());
            for (size_t k = 0; k < joints.size(); ++k)
                add_joint(skin, uint32_t(joints[k].integer(0) + 1), binds.at(k));
        }
    }

    static uint16_t add_joint(RigSkin& skin, uint32_t node, const Affine& inverse_bind) {
        std::array<float, 16>& m = skin.inverse_binds.emplace_back();
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                m[size_t(4 * column + row)] = float(inverse_bind.linear(row, column));
        for (int row = 0; row < 3; ++row) m[size_t(12 + row)] = float(inverse_bind.offset[row]);
        m[15] = 1;
        skin.joints.push_back(node);
        return uint16_t(skin.joints.size() - 1);
    }

    // What follows no joint of its skin follows a joint of its own: a node as it stands.
    static uint16_t joint_of_node(RigSkin& skin, size_t own_joints, uint32_t node) {
        for (size_t i = own_joints; i < skin.joints.size(); ++i)
            if (skin.joints[i] == node) return uint16_t(i);
        return add_joint(skin, node, Affine{});
    }

    // What one node draws.
    void add_part(std::span<const Instance> instances) {
        if (failed() || !instances.front().node) return;
        const auto index = uint32_t(*instances.front().node);
        const JsonView node = document_.view()["nodes"][index];
        const JsonView source = document_.view()["meshes"][size_t(node["mesh"].integer(0))];
        std::optional<uint32_t> skin;
        if (node["skin"].exists()) skin = uint32_t(node["skin"].integer(0));
        const size_t first = next_vertex_;
        const NodeVertices all = vertices_of(instances, skin, target_names(source));
        next_vertex_ += all.positions.size();
        std::vector<size_t> submeshes;
        for (size_t i = 0; i < mesh_.submeshes.size() && !failed(); ++i) {
            const uint32_t from = mesh_.file_vertices[mesh_.indices[mesh_.submeshes[i].first_index]];
            if (mesh_.submeshes[i].index_count > 0 && from >= first && from < next_vertex_)
                submeshes.push_back(i);
        }
        if (submeshes.empty()) return;
        RigPart part = part_of(mesh_, submeshes);
        part.node = index + 1;
        part.skin = skin;
        part.mesh.submeshes.front().name = source["name"].text("");
        fill(part, all, first);
        part.target_weights = instances.front().morph;
        part.target_weights.resize(part.targets.size());
        rig_.parts.push_back(std::move(part));
    }

    NodeVertices vertices_of(std::span<const Instance> instances, std::optional<uint32_t> skin,
                             std::vector<std::string> targets) {
        NodeVertices all;
        for (std::string& name : targets) all.targets.push_back({.name = std::move(name)});
        all.follows.resize(all.targets.size());
        for (const Instance& instance : instances) {
            const Primitive& primitive = *instance.primitive;
            if (primitive.indices.empty() || failed()) continue;
            const size_t count = primitive.positions.size() / 3;
            for (size_t v = 0; v < count; ++v) {
                all.positions.push_back(vec3_at(primitive.positions, v));
                all.normals.push_back(vec3_at(primitive.normals, v));
                all.world.push_back(
                    primitive.influences.per_vertex == 0
                        ? instance.world
                        : blend(instance.joints, primitive.influences, v, instances_.to_mm()));
                if (skin) all.influences.push_back(influences_of(instance, v, *skin));
            }
            add_targets(instance.source["targets"], count, all);
        }
        return all;
    }

    std::vector<Influence> influences_of(const Instance& instance, size_t vertex, size_t skin) {
        const Influences& from = instance.primitive->influences;
        std::vector<Influence> found;
        for (size_t i = vertex * from.per_vertex; i < (vertex + 1) * from.per_vertex; ++i) {
            if (!(from.weights[i] > 0)) continue;
            const auto known = std::ranges::find(found, uint16_t(from.joints[i]), &Influence::first);
            if (known == found.end())
                found.emplace_back(uint16_t(from.joints[i]), from.weights[i]);
            else
                known->second += from.weights[i];
        }
        std::ranges::stable_sort(found, std::greater(), &Influence::second);
        if (found.empty())
            found.emplace_back(
                joint_of_node(rig_.skins[skin], instance.joints.size(),
                              from.per_vertex == 0 ? uint32_t(instance.node.value_or(0) + 1) : 0),
                1.0f);
        return found;
    }

    void add_targets(const JsonView& targets, size_t count, NodeVertices& all) {
        for (size_t t = 0; t < all.targets.size() && !failed(); ++t) {
            if (t >= targets.size()) return targets.fail("a primitive has fewer than the first one");
            const std::vector<float> moves = changes(targets[t]["POSITION"], count),
                                     turns = changes(targets[t]["NORMAL"], count);
            for (size_t v = 0; v < count; ++v) {
                all.targets[t].moves_mm.push_back(vec3_at(moves, v) * 1000.0f);
                all.targets[t].turns.push_back(vec3_at(turns, v));
                all.follows[t].push_back(turns.empty());
            }
        }
    }

    std::vector<float> changes(const JsonView& accessor, size_t count) {
        if (!accessor.exists() || failed()) return {};
        std::vector<float> numbers = read_floats(document_, accessor.integer(0), 3);
        if (!failed() && numbers.size() != 3 * count)
            accessor.fail(fmt::format("has {} elements for {} positions", numbers.size() / 3, count));
        if (!std::ranges::all_of(numbers, [](float x) { return std::isfinite(x); }))
            accessor.fail("must be finite");
        return failed() ? std::vector<float>() : std::move(numbers);
    }

    void fill(RigPart& part, const NodeVertices& all, size_t first) {
        Mesh& mesh = part.mesh;
        const size_t count = part.vertices.size();
        std::vector<size_t> from;
        double volume = 0;
        for (const uint32_t v : part.vertices) {
            from.push_back(size_t(mesh_.file_vertices[v]) - first);
            if (from.back() >= all.positions.size())
                return document_.messages.fail("", "has other vertices than before");
            volume += all.world[from.back()].linear.determinant();
        }
        // Turned round on loading; a reader does that again.
        for (size_t i = 0; volume < 0 && i < mesh.indices.size(); i += 3)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
        for (size_t v = 0; v < count; ++v) {
            mesh.positions_mm[v] = all.positions[from[v]] * 1000.0f;
            mesh.normals[v] = all.normals[from[v]];
        }
        complete_normals(mesh);
        for (size_t v = 0; v < mesh.tangents.size(); ++v)
            mesh.tangents[v] = local_tangent(mesh.tangents[v], mesh.normals[v], all.world[from[v]]);
        fill_influences(part, all, from);
        for (size_t t = 0; t < all.targets.size(); ++t) {
            RigTarget target = {.name = all.targets[t].name};
            std::vector<bool> follows;
            for (const size_t v : from) {
                target.moves_mm.push_back(all.targets[t].moves_mm[v]);
                target.turns.push_back(all.targets[t].turns[v]);
                follows.push_back(all.follows[t][v] && target.moves_mm.back() != Vec3{});
            }
            if (std::ranges::count(follows, true) > 0) follow_surface(mesh, follows, target);
            part.targets.push_back(std::move(target));
        }
    }

    static void fill_influences(RigPart& part, const NodeVertices& all, const std::vector<size_t>& from) {
        if (all.influences.empty()) return;
        size_t most = 1;
        for (const size_t v : from) most = std::max(most, all.influences[v].size());
        part.influences = (most + kSet - 1) / kSet * kSet;
        part.joints.resize(from.size() * part.influences);
        part.weights.resize(from.size() * part.influences);
        for (size_t v = 0; v < from.size(); ++v)
            for (size_t i = 0; i < all.influences[from[v]].size(); ++i)
                std::tie(part.joints[v * part.influences + i], part.weights[v * part.influences + i]) =
                    all.influences[from[v]][i];
    }

    void add_clips() {
        const JsonView clips = document_.view()["animations"];
        for (size_t i = 0; i < clips.size() && !failed(); ++i) {
            RigClip clip = {.name = clip_name(clips[i], i)};
            std::vector<Channel> channels = read_channels(document_, clips[i]);
            // Loading has warned of it.
            if (document_.messages.error) {
                document_.messages.error.reset();
                continue;
            }
            for (Channel& channel : channels) {
                const auto node = uint32_t(channel.node + 1);
                if (channel.path == "weights" && std::ranges::count(rig_.parts, node, &RigPart::node) == 0)
                    continue;
                clip.channels.push_back({node, std::move(channel.path), std::move(channel.keys)});
            }
            if (!clip.channels.empty()) rig_.clips.push_back(std::move(clip));
        }
    }

    Document& document_;
    const Mesh& mesh_;
    const Pose& pose_;
    Instances instances_;
    size_t next_vertex_ = 0;  // its number in the file
    Rig rig_;
};

}  // namespace
}  // namespace gltf

RigPart part_of(const Mesh& mesh, std::span<const size_t> submeshes) {
    RigPart part;
    constexpr uint32_t kNone = ~0u;
    std::vector<uint32_t> number(mesh.positions_mm.size(), kNone);
    for (const size_t i : submeshes) {
        Submesh submesh = mesh.submeshes[i];
        submesh.first_index = uint32_t(part.mesh.indices.size());
        for (uint32_t k = 0; k < submesh.index_count; ++k) {
            const uint32_t v = mesh.indices[mesh.submeshes[i].first_index + k];
            if (number[v] == kNone) {
                number[v] = uint32_t(part.vertices.size());
                part.vertices.push_back(v);
            }
            part.mesh.indices.push_back(number[v]);
        }
        part.mesh.submeshes.push_back(std::move(submesh));
    }
    const auto take = [&](const auto& from, auto& to) {
        for (size_t i = 0; !from.empty() && i < part.vertices.size(); ++i)
            to.push_back(from[part.vertices[i]]);
    };
    take(mesh.positions_mm, part.mesh.positions_mm);
    take(mesh.normals, part.mesh.normals);
    take(mesh.tangents, part.mesh.tangents);
    take(mesh.uvs, part.mesh.uvs);
    take(mesh.atlas_uvs, part.mesh.atlas_uvs);
    return part;
}

void make_keys_linear(Rig& rig) {
    constexpr double kStep_s = 1.0 / 60;
    for (RigClip& clip : rig.clips)
        for (RigChannel& channel : clip.channels)
            channel.keys = gltf::linear_keys(channel.keys, kStep_s, channel.path == "rotation");
}

Result<Rig> read_rig(std::span<const std::byte> bytes, const std::filesystem::path& name,
                     const ReadSibling& read_sibling, const Mesh& mesh, const Pose& pose,
                     const RigNode& root) {
    gltf::Document document;
    gltf::open_document(bytes, name, read_sibling, {}, document);
    Rig rig;
    if (!document.messages.error) rig = gltf::RigReader(document, mesh, pose, root).run();
    if (document.messages.error) return *document.messages.error;
    return rig;
}

}  // namespace dermis::inline mesh
