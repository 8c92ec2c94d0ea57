#include "dermis/mesh/vertex_cache.h"

#include <meshoptimizer.h>

#include "dermis/mesh/topology.h"

namespace dermis {

void optimize_vertex_cache(Mesh& mesh) {
    std::vector<uint32_t> ordered(mesh.indices.size());
    for (const Submesh& submesh : mesh.submeshes)
        meshopt_optimizeVertexCache(ordered.data() + submesh.first_index,
                                    mesh.indices.data() + submesh.first_index, submesh.index_count,
                                    mesh.positions_mm.size());
    mesh.indices = std::move(ordered);
    std::vector<uint32_t> place(mesh.positions_mm.size());
    const size_t used = meshopt_optimizeVertexFetchRemap(place.data(), mesh.indices.data(),
                                                         mesh.indices.size(), mesh.positions_mm.size());
    std::vector<uint32_t> from(used);
    for (uint32_t i = 0; i < place.size(); ++i)
        if (place[i] != ~0u) from[place[i]] = i;
    for (uint32_t& index : mesh.indices) index = place[index];
    gather_vertices(mesh, from);
}

}  // namespace dermis
