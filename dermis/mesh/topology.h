#pragma once
// Corners around a position, and their connections by edges.

#include <cstdint>
#include <span>
#include <vector>

#include "dermis/base/vec.h"
#include "dermis/mesh/mesh.h"

namespace dermis::inline mesh {

/// Which of many records are the same: vertices that share a position across a UV seam, corners that share
/// all attributes.
struct Weld {
    std::vector<uint32_t> ids;  ///< of every record: the number of its distinct value, 0 .. first.size() - 1
    std::vector<uint32_t> first;  ///< of every distinct value: the first record that has it

    [[nodiscard]] uint32_t count() const { return uint32_t(first.size()); }
};

/// Records of `width` words each, equal when all words are. Ids follow first appearance. Linear time.
[[nodiscard]] Weld weld_records(std::span<const uint32_t> words, size_t width);

/// Merges exactly equal positions (-0 equals +0), none by distance.
[[nodiscard]] Weld weld_positions(std::span<const Vec3> positions);

/// The bits of a number as a weld key: -0 and +0 give the same.
[[nodiscard]] uint32_t weld_key(float value);

/// Corner c belongs to triangle c / 3. For a vertex numbering of `count` vertices: corners(v) lists all
/// corners there.
class CornerTable {
  public:
    CornerTable(std::span<const uint32_t> indices, size_t count);
    [[nodiscard]] std::span<const uint32_t> corners(size_t vertex) const {
        return std::span(corners_).subspan(first_[vertex], first_[vertex + 1] - first_[vertex]);
    }

  private:
    std::vector<uint32_t> first_, corners_;
};

/// Union-find; the lowest item of a set leads it.
class DisjointSets {
  public:
    explicit DisjointSets(size_t count) { reset(count); }
    void reset(size_t count);
    [[nodiscard]] uint32_t find(uint32_t item);
    void join(uint32_t a, uint32_t b);

  private:
    std::vector<uint32_t> parent_;
};

[[nodiscard]] inline uint32_t next_corner(uint32_t corner) {
    return corner % 3 == 2 ? corner - 2 : corner + 1;
}
[[nodiscard]] inline uint32_t previous_corner(uint32_t corner) {
    return corner % 3 == 0 ? corner + 2 : corner - 1;
}

/// An edge that starts at a vertex, as one of the corners there sees it.
struct Spoke {
    uint32_t far_end;  ///< the vertex at its other end
    uint32_t local;    ///< which of the corners around
};

/// Both edges of every corner around a vertex, sorted, so that corners which share an edge are neighbours.
/// `vertices` has the vertex of every corner of the mesh.
void collect_spokes(std::span<const uint32_t> corners, std::span<const uint32_t> vertices,
                    std::vector<Spoke>& spokes);

/// mesh.indices through the weld: triangles of positions, whatever the seams.
[[nodiscard]] std::vector<uint32_t> welded_indices(std::span<const uint32_t> indices, const Weld& weld);

/// Rearranges all attributes: vertex i of the new mesh is vertex from[i] of the old. The indices are the
/// caller's.
void gather_vertices(Mesh& mesh, std::span<const uint32_t> from);

/// Splits vertices whose corners have different groups. `group_of_corner` has any number for each corner;
/// corners of a vertex with equal numbers stay one vertex. Copies all attributes. Returns the old vertex of
/// each new one.
std::vector<uint32_t> split_vertices(Mesh& mesh, std::span<const uint32_t> group_of_corner);

/// Drops unused vertices.
void drop_unused_vertices(Mesh& mesh);

/// Interior angle of a corner in radians; 0 for degenerate triangles.
[[nodiscard]] float corner_angle_rad(std::span<const Vec3> positions_mm, std::span<const uint32_t> indices,
                                     uint32_t corner);

}  // namespace dermis::inline mesh
