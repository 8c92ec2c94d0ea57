#include "dermis/render/scene_upload.h"
#include "dermis/scene/environment.h"

namespace dermis {

Result<void> SceneOnDevice::upload_environment(gpu::Device& device, const Scene& scene) {
    Result<EnvironmentLight> environment = prepare_environment(scene.environment);
    if (!environment) return environment.error();
    environment_mip_count_ = environment->mips;
    for (const Vec3& coefficient : environment->radiance_sh)
        environment_sh_.push_back({{"radiance_linear", coefficient}});
    Result<gpu::Texture> cube = gpu::Texture::upload(device, {.name = "environment",
                                                              .format = ImageFormat::rgba16f,
                                                              .width = environment->base_size,
                                                              .height = environment->base_size,
                                                              .layers = 6,
                                                              .mips = environment->mips,
                                                              .cube = true,
                                                              .bytes = std::move(environment->cube)});
    if (!cube) return cube.error();
    environment_cube_ = std::make_unique<gpu::Texture>(std::move(*cube));
    return {};
}

}  // namespace dermis
