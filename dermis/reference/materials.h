#pragma once
// The materials of a scene with their maps decoded, and what they make of a point of a surface: the same
// meaning as shaders/include/surface.glsl gives them.

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/io.h"
#include "dermis/rays/ray_scene.h"
#include "dermis/rays/texture.h"
#include "dermis/scene/scene.h"
#include "dermis/scene/wrinkles.h"

namespace dermis::inline reference {

struct ShadingPoint {
    Vec3 p_mm, p_smooth_mm;  ///< on the triangle; lifted for shadow rays, see SurfaceAttributes
    Vec3 n_face;             ///< of the triangle
    Vec3 n_geometry;         ///< interpolated
    Vec3 n;                  ///< with the normal map
    Vec3 albedo_linear;
    Vec3 emission_linear;
    float roughness = 0.5f;  ///< perceptual; alpha = roughness^2
    float f0 = 0.04f;
    float metallic = 0;
    float opacity = 1;
    float occlusion =
        1;  ///< the vertices' or the map's, whichever is darker; for the renderer's ambient term
    MaterialClass material_class = MaterialClass::skin;
    float scatter = 1;  ///< share of skin's diffuse light that scatters
    uint32_t object = 0, material = 0;
};

/// Parameters of a surface's specular reflection.
struct SurfaceReflection {
    float roughness = 0.5f;  ///< perceptual; alpha = roughness^2
    float f0 = 0.04f;
};

class MaterialSet {
  public:
    /// Decodes every map once. Errors name the file. The scene must outlive it.
    [[nodiscard]] static Result<MaterialSet> load(const Scene& scene);

    /// All of a point, for a ray that the eye sees it by.
    [[nodiscard]] ShadingPoint shade(const SurfaceAttributes& surface, const RayHit& hit) const;
    /// Only the shading normal, for points whose irradiance is gathered: object-space maps are in world
    /// space.
    [[nodiscard]] Vec3 normal_at(const SurfaceAttributes& surface, uint32_t object) const;
    [[nodiscard]] SurfaceReflection reflection_at(const SurfaceAttributes& surface, uint32_t object) const;
    /// Transmittance of a translucent surface: its opacity map's colour, or base colour * (1 - opacity).
    [[nodiscard]] Vec3 transmittance_at(const SurfaceAttributes& surface, uint32_t object) const;
    [[nodiscard]] float occlusion_at(const SurfaceAttributes& surface, const RayHit& hit) const;

  private:
    struct Maps {
        const Texture* base_color = nullptr;
        const Texture* normal = nullptr;
        const Texture* wrinkle_stretch = nullptr;
        const Texture* wrinkle_compress = nullptr;
        const Texture* specular = nullptr;
        const Texture* roughness = nullptr;
        const Texture* metallic = nullptr;
        const Texture* metallic_roughness = nullptr;
        const Texture* occlusion = nullptr;
        const Texture* opacity = nullptr;
        const Texture* emission = nullptr;
        const Texture* scatter = nullptr;
    };
    struct Entry {
        const Material* material = nullptr;
        MaterialClass material_class = MaterialClass::skin;
        Maps maps;
        WrinkleWeights wrinkle_weights;
    };

    [[nodiscard]] const Entry& entry(const SurfaceAttributes& surface, uint32_t object) const;
    Result<const Texture*> texture_of(const ImageSource& source, ImageUse use, const SceneObject& object,
                                      const Material& material);

    const Scene* scene_ = nullptr;
    std::vector<std::vector<Entry>> objects_;
    std::map<std::string, std::unique_ptr<Texture>> textures_;  // stable addresses
};

}  // namespace dermis::inline reference
