#include "dermis/optics/profile.h"

namespace dermis {

GaussianSum gpu_gems_3_skin() {
    return {"gpu_gems_3",
            {{0.0064, {0.233, 0.455, 0.649}},
             {0.0484, {0.100, 0.336, 0.344}},
             {0.1870, {0.118, 0.198, 0.000}},
             {0.5670, {0.113, 0.007, 0.007}},
             {1.9900, {0.358, 0.004, 0.000}},
             {7.4100, {0.078, 0.000, 0.000}}}};
}

}  // namespace dermis
