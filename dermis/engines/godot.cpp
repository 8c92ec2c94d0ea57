// Godot 4: an addon's folder. Its .import and .tres files are text and come from engines/godot.

#include "dermis/engines/engine.h"

namespace dermis::inline engines::packages {

Engine godot() {
    return {.name = "godot",
            .texts = {{"addons/dermis_skin/skin.gdshaderinc", shading::Language::gdshader}},
            .license_path = "addons/dermis_skin/LICENSE",
            .table_path = "addons/dermis_skin/skin_table.exr",
            .v_origin = VOrigin::top};
}

}  // namespace dermis::inline engines::packages
