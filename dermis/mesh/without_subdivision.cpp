// In place of subdivide.cpp where DERMIS_WITH_SUBDIVISION is off.

#include "dermis/base/not_built_in.h"
#include "dermis/mesh/subdivide.h"

namespace dermis::inline mesh {

Result<PolygonMesh> subdivide(const PolygonMesh& polygons, int level) {
    if (level == 0) return polygons;
    return not_built_in("subdivision", "DERMIS_WITH_SUBDIVISION");
}

}  // namespace dermis::inline mesh
