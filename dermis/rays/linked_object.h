#pragma once
// The vertices of an object between which links are walked (vertex_links.h).

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "dermis/mesh/topology.h"
#include "dermis/rays/flesh.h"
#include "dermis/rays/random.h"
#include "dermis/scene/scene.h"

namespace dermis::inline rays {

/// The vertices of one object by position, and the triangles where walks start around each.
struct LinkedObject {
    const Mesh* mesh = nullptr;
    uint32_t first_vertex = 0;  ///< over all objects
    Weld weld;
    std::vector<uint32_t> first_corner, corners;  ///< of each position: corners (3 triangle + k) around it

    [[nodiscard]] std::span<const uint32_t> around(uint32_t position) const {
        return std::span(corners).subspan(first_corner[position],
                                          first_corner[position + 1] - first_corner[position]);
    }
};
[[nodiscard]] LinkedObject linked_object(const SceneObject& object, const Flesh& flesh,
                                         uint32_t first_vertex);

/// The mesh of a vertex over all objects, and its number there.
[[nodiscard]] std::pair<const Mesh*, uint32_t> vertex_of(std::span<const LinkedObject> objects,
                                                         uint32_t vertex);
[[nodiscard]] Vec3 place_mm(std::span<const LinkedObject> objects, uint32_t vertex);

/// The positions around one and their shares of the area, each once.
[[nodiscard]] std::vector<std::pair<uint32_t, float>> shares_around(const LinkedObject& object,
                                                                    uint32_t position);

/// Of each vertex over all objects: the middle one of those in its cell of a grid of 2 mm whose normals lie
/// in one octant. So both sides of a thin part have their own.
[[nodiscard]] std::vector<uint32_t> coarse_vertices(std::span<const LinkedObject> objects, uint32_t vertices);

/// Where a walk starts.
struct LinkStart {
    uint32_t triangle;
    std::array<float, 3> weights;  ///< barycentric
    Vec3 p_mm, n;
};

/// The corners around a position, to be drawn by area.
class Star {
  public:
    Star(const LinkedObject& object, uint32_t position);
    [[nodiscard]] bool empty() const { return corners_.empty(); }
    [[nodiscard]] float area_mm2() const { return area_mm2_; }
    /// A point of one of its triangles, with density falling from the position to nothing at the far edge.
    /// `u` in 0..1 chooses the triangle.
    [[nodiscard]] LinkStart draw(float u, Pcg32& random) const;

  private:
    const Mesh& mesh_;
    std::span<const uint32_t> corners_;
    std::vector<float> sums_mm2_;
    float area_mm2_ = 0;
};

}  // namespace dermis::inline rays
