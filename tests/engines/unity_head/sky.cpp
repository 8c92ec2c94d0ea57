#include "engines/unity_head/sky.h"

#include <cmath>
#include <regex>

#include "dermis/base/angle.h"
#include "dermis/base/file.h"
#include "dermis/image/io.h"
#include "dermis/scene/environment.h"
#include "dermis/scene/panorama.h"

namespace dermis::unity_head {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// What SkinHead.cs writes, by the numbers in its text.
struct SkyMaterial {
    float rotation_rad = 0, factor = 0;
};

Result<SkyMaterial> sky_material(const fs::path& package, const json& sky) {
    DERMIS_TRY_ASSIGN(const std::string script, read_text_file(package / "Head/SkinHead.cs"));
    const std::regex rotation(
        R"re("_Rotation", Mathf\.Repeat\((\d+) \+ Mathf\.Rad2Deg \* one\.yaw_rad, 360\))re"),
        tint(R"re("_Tint", FromLinear\(Vector3\.one \* \(one\.intensity / kColorSpaceDouble\)\))re");
    std::smatch found;
    if (!std::regex_search(script, tint))
        return Error{"SkinHead.cs: another tint of the sky than is modelled"};
    if (!std::regex_search(script, found, rotation))
        return Error{"SkinHead.cs: another rotation of the sky than is modelled"};
    return SkyMaterial{std::stof(found[1]) * kRadiansPerDegree + float(sky["yaw_rad"]), sky["intensity"]};
}

}  // namespace

Result<gpu::TextureData> sky_cube(const fs::path& package, const json& scene) {
    const json& sky = scene["environment"];
    DERMIS_TRY_ASSIGN(const SkyMaterial material, sky_material(package, sky));
    DERMIS_TRY_ASSIGN(const LoadedImage loaded,
                      read_image(package / "Head" / std::string(sky["file"]), ImageUse::data));
    const Image given = clean_panorama(to_linear_float(loaded.image), loaded.image.width);
    Image turned(given.width, given.height, 3);
    for (int y = 0; y < turned.height; ++y)
        for (int x = 0; x < turned.width; ++x) {
            const float v = (float(y) + 0.5f) / float(turned.height);
            const Vec3 d = panorama_direction((float(x) + 0.5f) / float(turned.width), v);
            // The vertex at d was turned about y from where it reads its texel.
            const float longitude = std::atan2(d.z, d.x) - material.rotation_rad;
            const float u = 0.5f - longitude / (2 * kPi);
            const Vec3 c = panorama_radiance(given, Vec2{u - std::floor(u), v}) * material.factor;
            turned.set(x, y, 0, c.x);
            turned.set(x, y, 1, c.y);
            turned.set(x, y, 2, c.z);
        }
    EnvironmentLight light = bake_environment(turned);
    return gpu::TextureData{.name = "sky",
                            .format = ImageFormat::rgba16f,
                            .width = light.base_size,
                            .height = light.base_size,
                            .layers = 6,
                            .mips = light.mips,
                            .cube = true,
                            .bytes = std::move(light.cube)};
}

}  // namespace dermis::unity_head
