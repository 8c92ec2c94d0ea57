// Babylon.js: a folder of modules. The table is DDS, as Babylon's reader of EXR fetches a library from
// another host; the first row of a DDS is at v = 0 there.

#include "dermis/engines/engine.h"

namespace dermis::inline engines::packages {

Engine babylon() {
    return {.name = "babylon",
            .texts = {{"skin.js", shading::Language::essl, "glslText"},
                      {"skin.js", shading::Language::wgsl, "wgslText"}},
            // It takes saturate() of vectors, for which Babylon's WGSL has a saturate() of one float instead.
            .left_out = "/curve_2015.glsl",
            .table_path = "skin_table.dds",
            .v_origin = VOrigin::top};
}

}  // namespace dermis::inline engines::packages
