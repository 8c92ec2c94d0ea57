#include "dermis/render/scene_upload.h"
#include "dermis/scene/brdf_table.h"
#include "dermis/scene/environment.h"

namespace dermis::inline render {

Result<void> SceneOnDevice::replace_environment(gpu::Device& device, const Scene& scene) {
    Result<EnvironmentLight> environment = prepare_environment(scene.environment);
    if (!environment) return environment.error();
    DERMIS_TRY_ASSIGN(gpu::Texture cube,
                      gpu::Texture::upload(device, {.name = "environment",
                                                    .format = ImageFormat::rgba16f,
                                                    .width = environment->base_size,
                                                    .height = environment->base_size,
                                                    .layers = 6,
                                                    .mips = environment->mips,
                                                    .cube = true,
                                                    .bytes = std::move(environment->cube)}));
    environment_cube_ = std::make_unique<gpu::Texture>(std::move(cube));
    environment_mip_count_ = environment->mips;
    environment_sh_ = environment->radiance_sh;
    return {};
}

Result<void> SceneOnDevice::upload_environment(gpu::Device& device, const Scene& scene) {
    if (Result<void> replaced = replace_environment(device, scene); !replaced) return replaced;
    DERMIS_TRY_ASSIGN(std::vector<std::byte> table, stored_brdf_table());
    DERMIS_TRY_ASSIGN(gpu::Texture brdf, gpu::Texture::upload(device, {.name = "environment_brdf",
                                                                       .format = ImageFormat::rgba16f,
                                                                       .width = kBrdfTableSize,
                                                                       .height = kBrdfLobes * kBrdfTableSize,
                                                                       .bytes = std::move(table)}));
    environment_brdf_ = std::make_unique<gpu::Texture>(std::move(brdf));
    return {};
}

}  // namespace dermis::inline render
