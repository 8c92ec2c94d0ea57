// 1. Vertices of the file that move together in every pose get a place, and targets changes by blocks of
// places.
// 2. Every vertex of the scene's mesh gets the places around it, in rings.

#include "dermis/render/deformed_mesh.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string_view>

#include "dermis/mesh/normals.h"
#include "dermis/mesh/surface_frame.h"
#include "dermis/mesh/topology.h"
#include "shaders/include/posing.h"

namespace dermis::inline render {
namespace {

// Appends numbers as 32-bit words.
struct Words {
    std::vector<uint32_t> all;

    template <class... Values>
    void add(Values... values) {
        (put(values), ...);
    }

  private:
    void put(uint32_t value) { all.push_back(value); }
    void put(float value) { all.push_back(std::bit_cast<uint32_t>(value)); }
    void put(Vec3 v) { add(v.x, v.y, v.z); }
    void put(Vec4 v) { add(v.x, v.y, v.z, v.w); }
};

template <class Element>
size_t hash_of(const std::vector<Element>& list, uint32_t first, uint32_t end) {
    return std::hash<std::string_view>()(
        {reinterpret_cast<const char*>(list.data() + first), (end - first) * sizeof(Element)});
}

// By position, changes and influences; the lists by a hash of 64 bits.
Weld weld_motion(const VertexMotion& motion) {
    std::vector<uint32_t> words;
    for (size_t v = 0; v < motion.positions.size(); ++v) {
        const Vec3 p = motion.positions[v];
        for (const float value : {p.x, p.y, p.z}) words.push_back(weld_key(value));
        for (const size_t hash :
             {hash_of(motion.changes, motion.first_change[v], motion.first_change[v + 1]),
              hash_of(motion.influences, motion.first_influence[v], motion.first_influence[v + 1])}) {
            words.push_back(uint32_t(hash));
            words.push_back(uint32_t(uint64_t(hash) >> 32));
        }
    }
    return weld_records(words, 7);
}

// The triangle of each file's corner among the scene's, which are in the same order, some hidden: its corner
// there, or kHidden.
constexpr uint32_t kHidden = ~0u;
std::vector<uint32_t> drawn_corners(const VertexMotion& motion, const Mesh& mesh) {
    std::vector<uint32_t> drawn(motion.indices.size(), kHidden);
    size_t next = 0;
    for (size_t i = 0; i < drawn.size() && next < mesh.indices.size(); i += 3) {
        const auto is_same = [&](size_t k) {
            return mesh.file_vertices[mesh.indices[next + k]] == motion.indices[i + k];
        };
        if (!is_same(0) || !is_same(1) || !is_same(2)) continue;
        for (size_t k = 0; k < 3; ++k) drawn[i + k] = uint32_t(next++);
    }
    return drawn;
}

// A triangle at a vertex, by its corner in the file and in the scene (kHidden: in that list it is not).
struct FanCorner {
    uint32_t in_file = kHidden, in_scene = kHidden;
    uint32_t kinds = 0;
    uint32_t next = 0, previous = 0;  // places
    Vec2 direction, du, dv;           // how UVs change over it (pose_vertices.comp)
};

// The order in which each triangle follows the one with which it shares an edge, if there is one.
std::vector<size_t> ring_order(std::span<const FanCorner> fan) {
    std::vector<size_t> order;
    std::vector<bool> taken(fan.size());
    const auto take = [&](size_t i) {
        taken[i] = true;
        order.push_back(i);
    };
    const auto is_first = [&](size_t i) {
        return std::ranges::none_of(fan, [&](const FanCorner& one) { return one.previous == fan[i].next; });
    };
    const auto follow = [&](size_t i) {
        for (take(i);;) {
            const uint32_t place = fan[order.back()].previous;
            size_t k = 0;
            while (k < fan.size() && (taken[k] || fan[k].next != place)) ++k;
            if (k == fan.size()) return;
            take(k);
        }
    };
    for (size_t i = 0; i < fan.size(); ++i)
        if (!taken[i] && is_first(i)) follow(i);
    for (size_t i = 0; i < fan.size(); ++i)
        if (!taken[i]) follow(i);
    return order;
}

// Whether the UVs of the file and of the atlas have one direction over all triangles.
bool is_along_atlas(std::span<const FanCorner> fan) {
    constexpr float kSame = 1e-6f;
    float of_file = 0, of_atlas = 0;
    for (const FanCorner& corner : fan) {
        of_file += std::abs(corner.direction.x) + std::abs(corner.direction.y);
        of_atlas += std::abs(corner.du.x) + std::abs(corner.du.y);
    }
    if (!(of_file > 0) || !(of_atlas > 0)) return of_file == of_atlas;
    const float scale = of_file / of_atlas;
    return std::ranges::all_of(fan, [&](const FanCorner& corner) {
        const Vec2 off = corner.direction - corner.du * scale;
        const float size = std::abs(corner.direction.x) + std::abs(corner.direction.y);
        return std::abs(off.x) + std::abs(off.y) <= kSame * size;
    });
}

class ArrayMaker {
  public:
    ArrayMaker(const VertexMotion& motion, const Mesh& mesh, const SurfaceAtRest& rest,
               std::span<const Vec3> at_rest_mm)
        : motion_(motion), mesh_(mesh), rest_(rest), at_rest_mm_(at_rest_mm), weld_(weld_motion(motion)) {}

    DeformArrays run() {
        made_.places = weld_.count();
        made_.vertices = uint32_t(mesh_.positions_mm.size());
        add_places();
        made_.has_normal_changes = !motion_.normal_changes.empty();
        made_.of_places = add_blocks(
            "changes", made_.places, [&](uint32_t place) { return weld_.first[place]; }, motion_.first_change,
            motion_.changes);
        made_.of_vertices = add_blocks(
            "normal changes", made_.vertices, [&](uint32_t v) { return mesh_.file_vertices[v]; },
            motion_.first_normal_change, motion_.normal_changes);
        made_.of_vertices.moves_around.resize(made_.of_vertices.firsts.size());
        add_vertices();
        return std::move(made_);
    }

  private:
    void put(const std::string& name, Words& words) {
        made_.constant.push_back({name, std::move(words.all)});
    }
    [[nodiscard]] uint32_t place_of(uint32_t vertex) const { return weld_.ids[mesh_.file_vertices[vertex]]; }

    void add_places() {
        Words places, lists;
        uint32_t count = 0;
        for (const uint32_t v : weld_.first) {
            const std::span<const VertexMotion::Influence> all =
                std::span(motion_.influences)
                    .subspan(motion_.first_influence[v],
                             motion_.first_influence[v + 1] - motion_.first_influence[v]);
            if (all.size() == 1 && all[0].share == 1) {
                influences_.push_back(posing::kOneMatrix | all[0].matrix);
            } else {
                influences_.push_back(count);
                lists.add(uint32_t(all.size()), 0.0f);
                for (const VertexMotion::Influence& one : all) lists.add(one.matrix, one.share);
                count += 1 + uint32_t(all.size());
            }
            places.add(motion_.positions[v], influences_.back());
        }
        put("places", places), put("influences", lists);
    }

    // The changes of `count` places or vertices, whose lists are those of the file's vertex `file_vertex(i)`.
    ChangedBlocks add_blocks(const std::string& name, uint32_t count, const auto& file_vertex,
                             const std::vector<uint32_t>& first_change,
                             const std::vector<VertexMotion::Change>& all_changes) {
        ChangedBlocks made = {.blocks = (count + posing::kPoseBlock - 1) / posing::kPoseBlock};
        made.firsts.assign(motion_.has_normals.size() * made.blocks, ChangedBlocks::kUnchanged);
        Words words;
        std::vector<Vec3> changes;
        for (uint32_t i = 0; i < count; ++i) {
            const uint32_t v = file_vertex(i);
            for (uint32_t k = first_change[v]; k < first_change[v + 1]; ++k) {
                uint32_t& first = made.firsts[all_changes[k].weight * made.blocks + i / posing::kPoseBlock];
                if (first == ChangedBlocks::kUnchanged) {
                    first = uint32_t(changes.size());
                    changes.resize(changes.size() + posing::kPoseBlock);
                }
                changes[first + i % posing::kPoseBlock] += all_changes[k].change;
            }
        }
        for (const Vec3 change : changes) words.add(change);
        put(name, words);
        return made;
    }

    // The set of joined corners of each file's corner, and the corners of each set.
    void join() {
        const JoinedCorners joined = join_corners(weld_, motion_.indices);
        std::vector<uint32_t> set_of_corner(motion_.indices.size());
        for (uint32_t place = 0; place < weld_.count(); ++place) {
            const auto around = joined.table.corners(place), leaders = joined.leaders_around(place);
            for (size_t i = 0; i < around.size(); ++i) set_of_corner[around[i]] = around[leaders[i]];
        }
        set_of_vertex_.assign(motion_.positions.size(), kHidden);
        for (size_t corner = set_of_corner.size(); corner-- > 0;)
            set_of_vertex_[motion_.indices[corner]] = set_of_corner[corner];
        joined_ = CornerTable(set_of_corner, set_of_corner.size());
    }

    // Vertices that differ in their normals alone share a number.
    [[nodiscard]] std::vector<uint32_t> number_uvs(const std::vector<Vec2>& uvs) const {
        std::vector<uint32_t> words;
        for (uint32_t v = 0; v < uvs.size(); ++v)
            for (const uint32_t word : {place_of(v), weld_key(uvs[v].x), weld_key(uvs[v].y)})
                words.push_back(word);
        return weld_records(words, 3).ids;
    }

    void add_vertices() {
        join();
        const std::vector<uint32_t> drawn = drawn_corners(motion_, mesh_);
        std::vector<uint32_t> place_of_corner, beside(mesh_.positions_mm.size());
        for (const uint32_t vertex : mesh_.indices) place_of_corner.push_back(place_of(vertex));
        for (size_t i = mesh_.indices.size(); i-- > 0;)
            beside[mesh_.indices[i]] = place_of_corner[next_corner(uint32_t(i))];
        const CornerTable around(place_of_corner, weld_.count());
        uvs_ = {.direction = number_uvs(mesh_.uvs), .atlas = number_uvs(atlas_uvs_of(mesh_))};
        std::vector<FanCorner> fan;
        for (uint32_t v = 0; v < made_.vertices; ++v) {
            fan.clear();
            if (const uint32_t set = set_of_vertex_[mesh_.file_vertices[v]]; set != kHidden)
                for (const uint32_t corner : joined_.corners(set))
                    fan.push_back({corner, drawn[corner], posing::kCornerJoined});
            for (const uint32_t corner : around.corners(place_of(v))) {
                auto same = std::ranges::find(fan, corner, &FanCorner::in_scene);
                if (same == fan.end()) same = fan.insert(fan.end(), FanCorner{.in_scene = corner});
                same->kinds |= posing::kCornerDrawn;
            }
            add_vertex(v, beside[v], fan);
        }
        vertices_.add(0u, entries_, stencil_entries(), 0u, 0u, 0u, 0.0f, Vec3{}, Vec4{}, Vec3{}, Vec3{},
                      Vec3{}, Vec3{});
        put("vertices", vertices_), put("rings", rings_), put("directions", directions_);
        put("stencils", stencils_);
    }

    void add_vertex(uint32_t v, uint32_t beside, std::span<FanCorner> fan) {
        const uint32_t first = entries_, file_vertex = mesh_.file_vertices[v], place = place_of(v);
        float rest_area = 0;
        for (FanCorner& corner : fan) rest_area += measure_corner(v, corner);
        const bool along_atlas = is_along_atlas(fan);
        const uint32_t directions = along_atlas ? posing::kAlongAtlas : uint32_t(directions_.all.size() / 2);
        add_ring(fan, !along_atlas);
        note_movers(v, place, fan);
        const SurfaceFrame frame(rest_.normals[v], rest_.directions[v]), axes({0, 0, 1}, {1, 0, 0});
        const Vec4 t = rest_.tangents.empty() ? Vec4{1, 0, 0, 1} : rest_.tangents[v];
        const auto in_axes = [&](const std::vector<CurvatureTensor>& tensors) {
            return tensors.empty() ? CurvatureTensor{} : moved(frame, axes, tensors[v]);
        };
        const CurvatureTensor s = in_axes(rest_.curvature.tensors_per_mm),
                              stencil = in_axes(rest_.curvature.stencil_tensors_per_mm);
        vertices_.add(place, first, stencil_entries(), influences_[place], directions, beside, rest_area,
                      motion_.normals[file_vertex], moved(frame, axes, Vec3{t.x, t.y, t.z}), t.w, s.diagonal,
                      s.mixed, stencil.diagonal, stencil.mixed);
        add_stencil(v);
    }

    [[nodiscard]] uint32_t stencil_entries() const { return uint32_t(stencils_.all.size() / 6); }

    void add_stencil(uint32_t v) {
        if (rest_.curvature.tensors_per_mm.empty()) return;
        for (const CurvatureStencils::Entry& entry : rest_.curvature.stencils.around(v)) {
            const auto& w = entry.weights;
            stencils_.add(place_of(entry.vertex), w[0], w[1], w[2], w[3], w[4]);
        }
    }

    void add_ring(std::span<const FanCorner> fan, bool with_directions) {
        size_t last = fan.size();
        for (size_t i = 0; i < fan.size(); ++i)
            if (fan[i].kinds & posing::kCornerJoined) last = i;
        const auto add = [&](uint32_t place, const FanCorner& steps) {
            rings_.add(place, steps.du.x, steps.du.y, steps.dv.x, steps.dv.y);
            if (with_directions) directions_.add(steps.direction.x, steps.direction.y);
            ++entries_;
        };
        std::optional<uint32_t> before;
        for (const size_t i : ring_order(fan)) {
            if (before != fan[i].next) add(fan[i].next, {});
            add(fan[i].previous | fan[i].kinds | (i == last ? posing::kCornerLast : 0), fan[i]);
            before = fan[i].previous;
        }
    }

    // The targets that move the places around a vertex.
    void note_movers(uint32_t v, uint32_t place, std::span<const FanCorner> fan) {
        const uint32_t block = v / posing::kPoseBlock;
        const auto note = [&](uint32_t moved) {
            const uint32_t from = weld_.first[moved];
            for (uint32_t k = motion_.first_change[from]; k < motion_.first_change[from + 1]; ++k)
                made_.of_vertices.moves_around[motion_.changes[k].weight * made_.of_vertices.blocks + block] =
                    true;
        };
        note(place);
        for (const FanCorner& corner : fan) note(corner.next), note(corner.previous);
    }

    // Returns twice its area at rest, if the scene draws it.
    float measure_corner(uint32_t v, FanCorner& corner) {
        const auto file_vertex = [&](uint32_t (*step)(uint32_t)) {
            return corner.in_file != kHidden ? motion_.indices[step(corner.in_file)]
                                             : mesh_.file_vertices[mesh_.indices[step(corner.in_scene)]];
        };
        const uint32_t next = file_vertex(next_corner), previous = file_vertex(previous_corner);
        corner.next = weld_.ids[next], corner.previous = weld_.ids[previous];
        if (!(corner.kinds & posing::kCornerDrawn)) return 0;
        Vec2 unused;
        if (same_uvs(uvs_.direction, v, corner.in_scene))
            take_steps(mesh_.uvs, corner.in_scene, corner.direction, unused);
        if (same_uvs(uvs_.atlas, v, corner.in_scene) &&
            take_steps(atlas_uvs_of(mesh_), corner.in_scene, corner.du, corner.dv))
            corner.kinds |= posing::kCornerInAtlas;
        const Vec3 p = at_rest_mm_[mesh_.file_vertices[v]];
        return length(cross(at_rest_mm_[next] - p, at_rest_mm_[previous] - p));
    }

    [[nodiscard]] bool same_uvs(const std::vector<uint32_t>& numbers, uint32_t v, uint32_t corner) const {
        return !numbers.empty() && numbers[v] == numbers[mesh_.indices[corner]];
    }

    // False, and no steps, for a triangle without area in UV (vertex_uv_derivatives).
    bool take_steps(const std::vector<Vec2>& uvs, uint32_t corner, Vec2& du, Vec2& dv) const {
        const Vec2 uv = uvs[mesh_.indices[corner]], uv1 = uvs[mesh_.indices[next_corner(corner)]] - uv,
                   uv2 = uvs[mesh_.indices[previous_corner(corner)]] - uv;
        const float det = cross(uv1, uv2);
        if (!(std::abs(det) > 1e-20f)) return false;
        du = {uv2.y / det, -uv1.y / det};
        dv = {-uv2.x / det, uv1.x / det};
        return true;
    }

    const VertexMotion& motion_;
    const Mesh& mesh_;
    const SurfaceAtRest& rest_;
    std::span<const Vec3> at_rest_mm_;
    Weld weld_;                            // joins equal vertices of the file
    std::vector<uint32_t> set_of_vertex_;  // by vertex of the file: the set whose normal it has
    CornerTable joined_ = {{}, 0};
    struct {
        std::vector<uint32_t> direction, atlas;
    } uvs_;
    Words vertices_, rings_, directions_, stencils_;
    std::vector<uint32_t> influences_;  // by place, as shaders have them
    uint32_t entries_ = 0;              // number of entries in all rings
    DeformArrays made_;
};

}  // namespace

std::vector<uint32_t> active_targets(const ChangedBlocks& changed, std::span<const float> weights,
                                     std::span<const uint8_t> has_normals) {
    Words words, lists;
    const uint32_t headers = changed.blocks + 1;
    for (uint32_t block = 0; block < headers; ++block) {
        const auto first = uint32_t(headers + lists.all.size() / 3);
        bool turns = false;
        for (uint32_t i = 0; i < weights.size() && block < changed.blocks; ++i) {
            if (weights[i] == 0) continue;
            const size_t at = size_t(i) * changed.blocks + block;
            turns = turns || (!changed.moves_around.empty() && changed.moves_around[at] && !has_normals[i]);
            if (changed.firsts[at] == ChangedBlocks::kUnchanged) continue;
            lists.add(changed.firsts[at], weights[i], has_normals[i] ? weights[i] : 0.0f);
        }
        words.add(first, turns ? 1.0f : 0.0f, 0.0f);
    }
    words.all.insert(words.all.end(), lists.all.begin(), lists.all.end());
    return std::move(words.all);
}

DeformArrays deform_arrays(const VertexMotion& motion, const Mesh& mesh, const SurfaceAtRest& rest,
                           std::span<const Vec3> at_rest_mm) {
    return ArrayMaker(motion, mesh, rest, at_rest_mm).run();
}

}  // namespace dermis::inline render
