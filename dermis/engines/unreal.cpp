// Unreal Engine 5: a plugin. The engine keeps import settings in binary assets, so that a Python script of
// the plugin sets them.

#include "dermis/engines/engine.h"

namespace dermis::inline engines::packages {

Engine unreal() {
    return {.name = "unreal",
            .texts = {{"DermisSkin/Shaders/Skin.ush", shading::Language::hlsl}},
            .license_path = "DermisSkin/LICENSE",
            .table_path = "DermisSkin/Resources/SkinTable.exr",
            .v_origin = VOrigin::top};
}

}  // namespace dermis::inline engines::packages
