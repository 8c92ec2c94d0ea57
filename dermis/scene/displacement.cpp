#include "dermis/scene/displacement.h"

#include <algorithm>

#include "dermis/image/io.h"
#include "dermis/image/resample.h"
#include "dermis/mesh/subdivide.h"

namespace dermis::inline scene {

Result<void> apply_displacement(Mesh& mesh) {
    const auto displaced = [](const Material& m) {
        return m.displacement_map.present() && m.displacement_amplitude_mm != 0;
    };
    const auto found = std::ranges::find_if(mesh.materials, displaced);
    if (found == mesh.materials.end()) return {};
    const Material material = *found;
    const ImageSource& source = material.displacement_map;
    if (mesh.materials.size() > 1)
        return Error{source.name + ": displaces a mesh of " + std::to_string(mesh.materials.size()) +
                     " materials; only a mesh of one can be displaced without tearing"};
    if (mesh.uvs.size() != mesh.positions_mm.size())
        return Error{source.name + ": displaces a mesh that has no UVs"};
    DERMIS_TRY_ASSIGN(const LoadedImage loaded,
                      source.encoded.empty() ? read_image(source.name, ImageUse::data)
                                             : decode_image(source.encoded, source.name, ImageUse::data));
    const Image heights = to_linear_float(loaded.image);
    displace(mesh, [&](Vec2 uv) { return sample_bilinear(heights, inside_image(source, uv)).x; },
             {.mid = material.displacement_mid, .amplitude_mm = material.displacement_amplitude_mm});
    return {};
}

}  // namespace dermis::inline scene
