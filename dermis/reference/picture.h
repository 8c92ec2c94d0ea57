#pragma once
// The reference of a scene as a picture: the same camera, lights, materials and meaning as the renderer's,
// with the diffuse transport integrated instead of approximated.
//
//     radiance = albedo_linear * exitance / pi + specular + emission

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/image/image.h"
#include "dermis/optics/medium.h"
#include "dermis/rays/flesh.h"
#include "dermis/reference/lighting.h"
#include "dermis/reference/surface_integrator.h"
#include "dermis/scene/scene.h"

namespace dermis::inline reference {

/// lambert: light leaves where it entered, the limit of `surface` at width 0.
enum class Integrator { surface, walk, lambert };

/// A pixel is the mean over its square, or what lies behind its middle (as a renderer without multisampling
/// draws it), or the mean of what lies behind the middles of grid x grid equal cells, maps read as finely as
/// a cell (as a renderer that draws `grid` times the size and averages has it).
enum class PixelFilter { box, center, grid };

/// The part of the light that walks let into the medium. fresnel: 1 - F(angle, eta), as a smooth dielectric.
/// all: everything that arrives, as `lambert`, `surface` and the techniques have it; a plane's walks then
/// return what `lambert` returns, at any eta and angle. Paths inside are reflected by Fresnel in both.
enum class LightEntry { fresnel, all };

struct ReferenceSettings;
struct TracedScene;

/// The rays, maps and lights of one scene, kept for the references that follow the first. Not for several
/// threads.
class SharedTracing {
  public:
    /// Loads them where the kept ones are for other cavities or lights. Errors: maps, the ray library.
    [[nodiscard]] Result<std::shared_ptr<const TracedScene>> of(const Scene& scene,
                                                                const ReferenceSettings& settings);

  private:
    std::shared_ptr<const TracedScene> kept_;
};

struct ReferenceSettings {
    Integrator integrator = Integrator::surface;
    int width = 512, height = 512;  ///< 1..16384
    int samples = 64;               ///< a pixel at most, 2..65536
    std::optional<double> noise;    ///< stop when the picture's relative error is at most this
    uint32_t seed = 1;
    int probes = 0;          ///< probes or walks a sample, 1..65536; 0: probes_of()
    double width_scale = 1;  ///< stretches the profile or all lengths of the medium; 0 is lambert
    Normalisation normalisation = Normalisation::by_area;
    Cavities cavities = Cavities::flesh;
    PixelFilter filter = PixelFilter::box;
    int grid =
        4;  ///< PixelFilter::grid: cells on a side, 1..16; of a picture, samples are a multiple of its square
    LightingSettings lighting;               ///< entry_eta is set from medium and `entry`
    LightEntry entry = LightEntry::fresnel;  ///< walk
    std::optional<ScatteringMedium> medium;  ///< walk: else walk_medium_of the scene's profile
    std::shared_ptr<SharedTracing> tracing;  ///< of this scene; null: loads it for this reference alone
};

/// The picture so far, linear f32. The error of a pixel is the standard error of its mean luminance
/// over max(luminance, 5 % of the brightest percentile); the picture's is the root mean square over all
/// pixels that show skin or another surface.
struct ReferencePicture {
    Image radiance;           ///< RGBA; alpha is coverage
    Image diffuse, specular;  ///< RGB, sum to the radiance of surfaces (emission is in diffuse)
    Image variance;           ///< RGB, of the pixel's mean, from the spread of blocks of four samples
    Image samples;            ///< one channel: how many each pixel took
    Image skin;               ///< one channel: the share of the pixel that is skin, seen through nothing
    double relative_error = 0;
    bool reached_noise = true;  ///< false: the wanted noise was not reached within the samples allowed
    int passes = 0;
    double time_ms = 0;
    size_t lost_walks = 0, walks = 0;
    std::vector<std::string> warnings;
};

/// Called after every pass, between 0 and 1.
using ReferenceProgress = std::function<void(double done)>;

/// Called with the radiance so far, linear RGBA, every pixel filled: during the first pass from every fourth
/// and every second pixel of each direction, then after 1, 2, 4, 8 ... passes.
using ReferencePreview = std::function<void(const Image& radiance)>;

/// One sample a pixel a pass; from the sixteenth pass on, sampling stops for pixels whose neighbourhood has
/// reached the wanted error. Setting `stop` ends it after the rows in work and returns the picture so far (an
/// error when not even the first pass is complete). Otherwise the result depends on the settings alone, not
/// on the threads. Errors: sizes out of range, unreadable maps, walk without a medium.
[[nodiscard]] Result<ReferencePicture> render_reference(const Scene& scene, const ReferenceSettings& settings,
                                                        const ReferenceProgress& progress = {},
                                                        const std::atomic<bool>* stop = nullptr,
                                                        const ReferencePreview& preview = {});

/// Probes or walks of a sample; of `lambert` the points of the lights. As set, or 3 of `surface` and 16; of
/// `surface` a multiple of three, the next above what is set.
[[nodiscard]] int probes_of(const ReferenceSettings& settings);

/// What a reference says that was stopped while some pixels had no sample.
[[nodiscard]] Error stopped_without_a_picture();

/// Errors: sizes and numbers out of range.
[[nodiscard]] Result<void> check(const ReferenceSettings& settings);

/// What limits `walk` in this scene: the volume of its profile, facets. Errors: as medium_of_scene.
[[nodiscard]] Result<std::vector<std::string>> walk_notes(const Scene& scene,
                                                          const ReferenceSettings& settings);

/// The medium that `walk` takes when none is given. Errors: the scene's profile is not known.
[[nodiscard]] Result<ScatteringMedium> medium_of_scene(const Scene& scene);

}  // namespace dermis::inline reference
