#include <cmath>

#include "dermis/base/parallel.h"
#include "dermis/mesh/normals.h"
#include "dermis/mesh/subdivide.h"
#include "dermis/mesh/tangents.h"
#include "dermis/mesh/topology.h"

namespace dermis::inline mesh {

void displace(Mesh& mesh, const std::function<float(Vec2 uv)>& height, const DisplacementOptions& options) {
    std::vector<float> heights(mesh.uvs.size());
    parallel_for(heights.size(), 4096, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) heights[i] = height(mesh.uvs[i]);
    });
    const Weld weld = weld_positions(mesh.positions_mm);
    struct Sum {
        Vec3 normal;
        float height = 0, count = 0;
    };
    std::vector<Sum> sums(weld.count());
    for (size_t i = 0; i < heights.size(); ++i) {
        Sum& sum = sums[weld.ids[i]];
        sum.normal += mesh.normals[i];
        sum.height += std::isfinite(heights[i]) ? heights[i] - options.mid : 0;
        sum.count += 1;
    }
    for (size_t i = 0; i < heights.size(); ++i) {
        const Sum& sum = sums[weld.ids[i]];
        mesh.positions_mm[i] += normalize(sum.normal) * (sum.height / sum.count * options.amplitude_mm);
    }
    compute_normals(mesh);
    compute_tangents(mesh);
}

}  // namespace dermis::inline mesh
