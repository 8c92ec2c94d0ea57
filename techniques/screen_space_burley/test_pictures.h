#pragma once
// For the tests: pictures of this technique, and how far they are from those with many samples.

#include <cmath>

#include "render/render_test.h"

namespace dermis::screen_space_burley {

class ScreenSpaceBurleyTest : public RenderTest {
  protected:
    using Settings = std::vector<std::pair<std::string, std::string>>;

    static Image draw(Renderer& renderer, const Settings& settings, const std::string& view = "diffuse") {
        const Technique& technique = built_in_technique("screen_space_burley");
        ParameterValues values(technique.parameters);
        for (const auto& [name, text] : settings) EXPECT_TRUE(values.set(name, text)) << name;
        return radiance(renderer, technique, values,
                        {.width = 128, .height = 128, .view = view, .deep = true, .shadow_map_size = 1024});
    }
    // Decibels of red against many samples; the peak is the brightest pixel.
    static double psnr_db(const Image& image, const Image& many) {
        double squares = 0, peak = 0;
        for (size_t i = 0; i < image.pixel_count(); ++i) {
            const double difference = image.floats()[4 * i] - many.floats()[4 * i];
            squares += difference * difference;
            peak = std::max(peak, double(many.floats()[4 * i]));
        }
        return 10 * std::log10(peak * peak * double(image.pixel_count()) / squares);
    }
};

}  // namespace dermis::screen_space_burley
