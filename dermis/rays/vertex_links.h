#pragma once
// Where the light of each vertex of a scene's skin comes from: what random walks bring from other vertices,
// less what the diffusion profile brings. With the irradiance of the vertices this is the light that a
// technique leaves out whose model is the profile (docs/transport.md).
//
//     added(v) = sum over links l of v of weight_l * irradiance(vertex_l)
//
// Links were precomputed for translucent objects by Lensch et al. 2002, "Interactive Rendering of Translucent
// Objects", and Carr, Hall, Hart 2003, "GPU Algorithms for Radiosity and Subsurface Scattering", from the
// dipole; here they are walked, and hold the difference alone, which is smooth enough for vertices.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"
#include "dermis/scene/scene.h"

namespace dermis::inline rays {

struct VertexLinkSettings {
    float walks_per_mm2 = 64;  ///< 0.1..10000
    int least_walks = 128;     ///< of a vertex, 1..1000000
    int most_links = 96;       ///< of a vertex, 2..1024
};

struct VertexLink {
    uint32_t vertex = 0;  ///< over all objects, in their order
    Vec3 weight;          ///< of the irradiance there, linear; below 0 where the profile brings more
};

struct VertexLinks {
    /// One array an object, one number a vertex: its row; vertices at one position share it.
    std::vector<std::vector<uint32_t>> rows;
    std::vector<uint32_t>
        first;  ///< of row r: links first[r] to first[r + 1]; row 0 is empty, of what is not skin
    std::vector<VertexLink> links;
};

/// Walks start with diffuse light in the visible triangles around a vertex, the more the nearer to it, and
/// end as the reference's do. A walk in flat skin by the same random numbers is the control variate. The
/// profile is sampled from the same points: along the normal, the surface nearest to the tangent plane that
/// faces the same way. Even light on flat skin gives 0.
///
/// Rows are blurred over the surface, so that vertices share their walks: by about the distance of two
/// vertices, and more where light comes through the body, from skin that faces away or is 8 mm away. Such
/// skin has one vertex every 2 mm. A row keeps its 20 largest near and 12 largest far links, and further ones
/// until the sum of the rest is small; near ones are at most five twelfths of `most_links`. The rest is added
/// to the nearest kept links. Where light changes quickly, as between the two sides of a fold, such a merged
/// link brings the wrong light.
///
/// `objects` have normals. Deterministic; cached by content. Cost: about a millisecond of one core a vertex.
/// Errors: settings out of range, no skin, the ray library fails.
[[nodiscard]] Result<VertexLinks> walk_vertex_links(std::span<const SceneObject> objects,
                                                    const ScatteringMedium& medium,
                                                    const GaussianSum& profile,
                                                    const VertexLinkSettings& settings = {});

}  // namespace dermis::inline rays
