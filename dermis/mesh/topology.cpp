#include "dermis/mesh/topology.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace dermis::inline mesh {
namespace {

template <class Attribute>
void gather(std::vector<Attribute>& attribute, std::span<const uint32_t> from) {
    if (attribute.empty()) return;
    std::vector<Attribute> gathered;
    gathered.reserve(from.size());
    for (const uint32_t i : from) gathered.push_back(attribute[i]);
    attribute = std::move(gathered);
}

}  // namespace

CornerTable::CornerTable(std::span<const uint32_t> indices, size_t count) {
    first_.assign(count + 1, 0);
    for (const uint32_t vertex : indices) ++first_[vertex + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    std::vector<uint32_t> next(first_.begin(), first_.end() - 1);
    corners_.resize(indices.size());
    for (uint32_t corner = 0; corner < indices.size(); ++corner) corners_[next[indices[corner]]++] = corner;
}

void DisjointSets::reset(size_t count) {
    parent_.resize(count);
    std::iota(parent_.begin(), parent_.end(), 0u);
}

uint32_t DisjointSets::find(uint32_t item) {
    while (parent_[item] != item) item = parent_[item] = parent_[parent_[item]];
    return item;
}

void DisjointSets::join(uint32_t a, uint32_t b) {
    a = find(a), b = find(b);
    // The smaller number leads, so that the result does not depend on the order of joins.
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
}

void gather_vertices(Mesh& mesh, std::span<const uint32_t> from) {
    gather(mesh.positions_mm, from);
    gather(mesh.normals, from);
    gather(mesh.tangents, from);
    gather(mesh.uvs, from);
    gather(mesh.atlas_uvs, from);
    gather(mesh.curvatures_per_mm, from);
    gather(mesh.occlusions, from);
    gather(mesh.colors_linear, from);
    gather(mesh.tensions, from);
    gather(mesh.rest_positions_mm, from);
    gather(mesh.file_vertices, from);
}

void collect_spokes(std::span<const uint32_t> corners, std::span<const uint32_t> vertices,
                    std::vector<Spoke>& spokes) {
    spokes.clear();
    for (uint32_t i = 0; i < corners.size(); ++i) {
        spokes.push_back({vertices[next_corner(corners[i])], i});
        spokes.push_back({vertices[previous_corner(corners[i])], i});
    }
    std::ranges::sort(spokes, [](Spoke a, Spoke b) {
        return a.far_end != b.far_end ? a.far_end < b.far_end : a.local < b.local;
    });
}

std::vector<uint32_t> welded_indices(std::span<const uint32_t> indices, const Weld& weld) {
    std::vector<uint32_t> welded;
    welded.reserve(indices.size());
    for (const uint32_t index : indices) welded.push_back(weld.ids[index]);
    return welded;
}

std::vector<uint32_t> split_vertices(Mesh& mesh, std::span<const uint32_t> group_of_corner) {
    const CornerTable table(mesh.indices, mesh.positions_mm.size());
    std::vector<uint32_t> from(mesh.positions_mm.size());
    std::iota(from.begin(), from.end(), 0u);
    std::vector<uint32_t> corners;
    for (uint32_t vertex = 0; vertex + 1 <= mesh.positions_mm.size(); ++vertex) {
        corners.assign(table.corners(vertex).begin(), table.corners(vertex).end());
        if (corners.empty()) continue;
        std::ranges::stable_sort(corners, {}, [&](uint32_t c) { return group_of_corner[c]; });
        uint32_t target = vertex;
        for (size_t i = 1; i < corners.size(); ++i) {
            if (group_of_corner[corners[i]] != group_of_corner[corners[i - 1]]) {
                target = uint32_t(from.size());
                from.push_back(vertex);
            }
            mesh.indices[corners[i]] = target;
        }
    }
    if (from.size() > mesh.positions_mm.size()) gather_vertices(mesh, from);
    return from;
}

void drop_unused_vertices(Mesh& mesh) {
    std::vector<uint32_t> number(mesh.positions_mm.size(), ~0u), from;
    for (const uint32_t index : mesh.indices) number[index] = 0;
    for (uint32_t i = 0; i < number.size(); ++i)
        if (number[i] == 0) number[i] = uint32_t(from.size()), from.push_back(i);
    if (from.size() == number.size()) return;
    for (uint32_t& index : mesh.indices) index = number[index];
    gather_vertices(mesh, from);
}

float corner_angle_rad(std::span<const Vec3> positions_mm, std::span<const uint32_t> indices,
                       uint32_t corner) {
    const Vec3 p = positions_mm[indices[corner]];
    const Vec3 a = positions_mm[indices[next_corner(corner)]] - p;
    const Vec3 b = positions_mm[indices[previous_corner(corner)]] - p;
    // atan2 is accurate for slivers, where acos of a dot product is not.
    const float angle = std::atan2(length(cross(a, b)), dot(a, b));
    return std::isfinite(angle) && length(a) > 0 && length(b) > 0 ? angle : 0.0f;
}

namespace {

constexpr uint32_t kEmpty = ~0u;

uint64_t hash_words(std::span<const uint32_t> words) {
    uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const uint32_t word : words) {
        hash = (hash ^ word) * 0xff51afd7ed558ccdu;
        hash ^= hash >> 32;
    }
    return hash;
}

}  // namespace

uint32_t weld_key(float value) {
    return std::bit_cast<uint32_t>(value == 0 ? 0.0f : value);
}

Weld weld_records(std::span<const uint32_t> words, size_t width) {
    const size_t count = words.size() / width;
    Weld weld;
    weld.ids.resize(count);
    // Open addressing at a load of at most one half; slots hold ids.
    std::vector<uint32_t> slots(std::bit_ceil(std::max<size_t>(16, count * 2)), kEmpty);
    const size_t mask = slots.size() - 1;
    for (size_t i = 0; i < count; ++i) {
        const auto record = words.subspan(i * width, width);
        size_t slot = hash_words(record) & mask;
        while (slots[slot] != kEmpty &&
               !std::ranges::equal(record, words.subspan(weld.first[slots[slot]] * width, width)))
            slot = (slot + 1) & mask;
        if (slots[slot] == kEmpty) {
            slots[slot] = weld.count();
            weld.first.push_back(uint32_t(i));
        }
        weld.ids[i] = slots[slot];
    }
    return weld;
}

Weld weld_positions(std::span<const Vec3> positions) {
    std::vector<uint32_t> words;
    words.reserve(positions.size() * 3);
    for (const Vec3& p : positions)
        for (const float value : {p.x, p.y, p.z}) words.push_back(weld_key(value));
    return weld_records(words, 3);
}

}  // namespace dermis::inline mesh
