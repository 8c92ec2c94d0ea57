#include "dermis/scene/environment.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "dermis/base/cache.h"
#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/image/io.h"
#include "dermis/scene/panorama.h"
#include "dermis/scene/prefilter.h"

namespace dermis::inline scene {
namespace {

// Raise with every change to the studio, the prefilter or the layout of what is cached.
constexpr uint32_t kVersion = 2;
constexpr int kPanoramaWidth = 1024;
constexpr int kStudioWidth = 512;  // enough: its lights have soft edges

Result<Image> decode_panorama(std::span<const std::byte> bytes, const std::filesystem::path& file) {
    DERMIS_TRY_ASSIGN(const LoadedImage loaded, decode_image(bytes, file.string(), ImageUse::data));
    const Image& image = loaded.image;
    if (image.width != 2 * image.height)
        return Error{file.string() + ": " + std::to_string(image.width) + " x " +
                     std::to_string(image.height) +
                     " texels; a latitude-longitude panorama is twice as wide as high"};
    return clean_panorama(to_linear_float(image), kPanoramaWidth);
}

}  // namespace

Vec3 to_environment(Vec3 d_world, EnvironmentTurn turn) {
    const float c = turn.cosine, s = turn.sine;
    return {c * d_world.x - s * d_world.z, d_world.y, s * d_world.x + c * d_world.z};
}

Vec3 to_environment(Vec3 d_world, float yaw_rad) {
    return to_environment(d_world, {std::cos(yaw_rad), std::sin(yaw_rad)});
}

Result<Image> load_panorama(const Environment& environment) {
    if (environment.kind == EnvironmentKind::none) return Image(1, 1, 3);
    if (environment.kind == EnvironmentKind::studio) return make_studio_panorama(kStudioWidth);
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> bytes, read_file(environment.file));
    return decode_panorama(bytes, environment.file);
}

EnvironmentLight bake_environment(const Image& panorama, int base_size, int mips) {
    // A face spans a quarter of the panorama's width, which is half of its height.
    const int face_texels = int(std::bit_floor(unsigned(panorama.height / 2)));
    const CubePyramid pyramid(panorama, std::max(base_size, face_texels));
    return {.radiance_sh = project_radiance(panorama),
            .base_size = base_size,
            .mips = mips,
            .cube = prefilter_ggx(pyramid, base_size, mips)};
}

Result<EnvironmentLight> prepare_environment(const Environment& environment) {
    if (environment.kind == EnvironmentKind::none) return bake_environment(Image(1, 1, 3), 1, 1);
    Hasher hasher;
    hasher.add(kVersion).add(environment.kind).add(kEnvironmentBaseSize).add(kEnvironmentMips);
    std::vector<std::byte> file;
    if (environment.kind == EnvironmentKind::file) {
        DERMIS_TRY_ASSIGN(std::vector<std::byte> read, read_file(environment.file));
        file = std::move(read);
        hasher.add(file);
    }
    const auto make = [&]() -> Result<EnvironmentLight> {
        DERMIS_TRY_ASSIGN(const Image panorama, environment.kind == EnvironmentKind::file
                                                    ? decode_panorama(file, environment.file)
                                                    : Result<Image>(make_studio_panorama(kStudioWidth)));
        return bake_environment(panorama);
    };
    EnvironmentLight blank{.base_size = kEnvironmentBaseSize, .mips = kEnvironmentMips};
    blank.cube.resize(prefiltered_bytes(blank.base_size, blank.mips));
    return cached("environment", hasher.hex(), std::move(blank), make,
                  [](auto& light) { return std::tie(light.radiance_sh, light.cube); });
}

}  // namespace dermis::inline scene
