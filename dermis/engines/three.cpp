// three.js: a folder of modules. Its loader has the last row of an EXR picture at v = 0.

#include "dermis/engines/engine.h"

namespace dermis::inline engines::packages {

Engine three() {
    return {.name = "three",
            .texts = {{"skin.js", shading::Language::essl, "glslText"},
                      {"skin.js", shading::Language::wgsl, "wgslText"}},
            .table_path = "skin_table.exr",
            .v_origin = VOrigin::bottom};
}

}  // namespace dermis::inline engines::packages
