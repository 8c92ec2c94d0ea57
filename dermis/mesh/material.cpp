#include "dermis/mesh/material.h"

namespace dermis {

float cutoff_of_map(const Material& material) {
    constexpr float kBlended = 0.5f, kNothing = 2;  // no map reaches 2
    switch (material.alpha_mode) {
        case AlphaMode::opaque:
            return 0;
        case AlphaMode::mask:
            return material.opacity > 0 ? material.alpha_cutoff / material.opacity : kNothing;
        case AlphaMode::blend:
            return material.alpha_map.present() || material.base_color_map.present() ? kBlended : 0;
    }
    return 0;
}

}  // namespace dermis
