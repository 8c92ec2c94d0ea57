#include <gtest/gtest.h>

#include <cmath>

#include "render/render_test.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

const DrawSettings kTextureSpaceSmall = {
    .width = 128, .height = 128, .view = "diffuse", .shadow_map_size = 512};

class TextureSpace : public RenderTest {
  protected:
    static ParameterValues with(std::initializer_list<std::pair<const char*, const char*>> settings) {
        ParameterValues values =
            without_gain(ParameterValues(built_in_technique("texture_space").parameters));
        for (const auto& [name, text] : settings) EXPECT_TRUE(values.set(name, text)) << name;
        return values;
    }
    /// `passes` of one radius in texels, of the filter gaussian unless `more` names another.
    static ParameterValues texels(const char* passes, const char* radius,
                                  std::initializer_list<std::pair<const char*, const char*>> more = {}) {
        ParameterValues values =
            with({{"blur", "gaussian"}, {"blur_passes", passes}, {"blur_radius", radius}});
        for (const auto& [name, text] : more) EXPECT_TRUE(values.set(name, text)) << name;
        return values;
    }
    /// Colours of the light map after the last pass, all of it drawn.
    static Image light_map(Renderer& renderer, ParameterValues values, const char* image) {
        EXPECT_TRUE(values.set("cull", "none"));
        draw(renderer, values);
        return to_linear_float(*renderer.read(image));
    }
    static Image draw(Renderer& renderer, const ParameterValues& values) {
        return radiance(renderer, built_in_technique("texture_space"), values, kTextureSpaceSmall);
    }
    static double mean_difference(const Image& a, const Image& b) {
        double sum = 0, count = 0;
        for (int y = 0; y < a.height; ++y)
            for (int x = 0; x < a.width; ++x)
                if (a.at(x, y, 3) > 0) sum += std::abs(a.at(x, y, 0) - b.at(x, y, 0)), ++count;
        return sum / count;
    }
};

}  // namespace

TEST_F(TextureSpace, without_blur_it_is_lambert) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Image lambert = radiance(renderer, built_in_technique("lambert"), kTextureSpaceSmall);
    const Image unblurred = draw(renderer, with({{"blur_passes", "0"}, {"light_map_size", "64"}}));
    EXPECT_LT(mean_difference(lambert, unblurred), 2e-4)
        << "what the map is too coarse for is lit at the pixel";
    const Image from_map = draw(renderer, with({{"blur_passes", "0"}, {"light_map_size", "2048"}}));
    EXPECT_LT(mean_difference(lambert, from_map), 2e-3);
    const Image blurred = draw(renderer, texels("8", "8", {{"light_map_size", "512"}}));
    EXPECT_GT(mean_difference(lambert, blurred), 1e-2) << "the blur does nothing";
}

TEST_F(TextureSpace, every_filter_keeps_constant_light_constant_up_to_the_chart_borders) {
    const Scene scene = evenly_lit_spheres();
    Renderer renderer = make_renderer(scene);
    const Image lambert = radiance(renderer, built_in_technique("lambert"), kTextureSpaceSmall);
    EXPECT_LT(relative_difference(lambert, draw(renderer, with({})), 1), 1e-3);
    // The source's disk is off its middle.
    const std::pair<const char*, double> filters[] = {{"poisson", 2e-3}, {"gaussian", 1e-3}, {"box", 1e-3}};
    for (const auto& [filter, most] : filters) {
        const Image image = draw(renderer, texels("4", "6", {{"blur", filter}}));
        EXPECT_LT(relative_difference(lambert, image, 1), most) << filter;
    }
    EXPECT_LT(relative_difference(lambert, draw(renderer, with({{"blur", "kawase"}})), 1), 1e-3);
}

TEST_F(TextureSpace, without_dilation_the_gutter_darkens_the_seams) {
    // Proves that the test above can fail.
    Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Image good = draw(renderer, texels("4", "20", {{"dilate", "written_only"}}));
    const Image dark = draw(renderer, texels("4", "20", {{"dilate", "off"}}));
    EXPECT_GT(relative_difference(good, dark, 1), 0.05);
}

TEST_F(TextureSpace, its_coarse_settings_blur_as_widely) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const Technique& technique = built_in_technique("texture_space");
    const Image sharp = draw(renderer, with({{"blur_passes", "0"}}));
    // A fit to the profile leaves out what the coarser texels cannot hold.
    const std::pair<ParameterValues, double> settings[] = {{texels("8", "6"), 0.25}, {with({}), 0.4}};
    for (const auto& [values, part] : settings) {
        const Image whole = draw(renderer, values), coarse = draw(renderer, technique.coarse(values, 0.5f));
        EXPECT_LT(mean_difference(whole, coarse), part * mean_difference(whole, sharp)) << part;
    }
}

// A tap between texels is a mean of four texels, so that a radius under half a texel blurs too.
TEST_F(TextureSpace, dilation_reads_between_texels) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const auto map = [&](const char* passes, const char* radius, const char* image) {
        return light_map(renderer, texels(passes, radius, {{"light_map_size", "256"}}), image);
    };
    const Image none = map("0", "0", "light_map_a");
    const auto blurred_by = [&](const char* radius) {
        const Image blurred = map("1", radius, "light_map_b");
        double sum = 0;
        for (int y = 0; y < none.height; ++y)
            for (int x = 0; x < none.width; ++x)
                sum += std::abs(double(none.at(x, y, 0)) - blurred.at(x, y, 0));
        return sum;
    };
    const double a_third = blurred_by("0.3"), half = blurred_by("0.5"), two = blurred_by("2");
    EXPECT_GT(a_third, 0);
    EXPECT_GT(half, a_third);
    EXPECT_GT(two, half);
}

// Kawase 2003: four reads half a texel off the middle of the texel, each a mean of four: 1 2 1 along both
// axes.
TEST_F(TextureSpace, kawases_first_pass_is_the_binomial_filter_and_its_second_reads_further_out) {
    const Scene scene = load("builtin:spheres");
    Renderer renderer = make_renderer(scene);
    const auto kawase = [&](const char* passes, const char* image) {
        return light_map(
            renderer, with({{"blur", "kawase"}, {"blur_passes", passes}, {"light_map_size", "256"}}), image);
    };
    const Image none = kawase("0", "light_map_a"), first = kawase("1", "light_map_b"),
                second = kawase("2", "light_map_a");
    size_t count = 0;
    for (int y = 40; y < 88; ++y)
        for (int x = 40; x < 88; ++x) {  // inside the first sphere's chart
            double binomial = 0, corners = 0;
            for (int dy = -2; dy <= 2; ++dy)
                for (int dx = -2; dx <= 2; ++dx) {
                    if (std::abs(dx) < 2 && std::abs(dy) < 2)
                        binomial += (2 - std::abs(dx)) * (2 - std::abs(dy)) / 16.0 *
                                    double(none.at(x + dx, y + dy, 0));
                    if (dx != 0 && dy != 0) corners += double(first.at(x + dx, y + dy, 0)) / 16;
                }
            EXPECT_NEAR(first.at(x, y, 0), binomial, 2e-3 * binomial + 1e-4);
            EXPECT_NEAR(second.at(x, y, 0), corners, 2e-3 * corners + 1e-4);
            count += std::abs(none.at(x, y, 0) - none.at(x + 1, y, 0)) > 4e-3f;
        }
    EXPECT_GT(count, 100u) << "a filter of flat light shows nothing";
}

TEST_F(TextureSpace, settings_that_cannot_be_used_together_are_refused) {
    const Technique& technique = built_in_technique("texture_space");
    const auto refusal = [&](std::initializer_list<std::pair<const char*, const char*>> settings) {
        const Result<void> checked = check_settings(technique, with(settings));
        return checked ? "" : checked.error().message;
    };
    const std::pair<std::string, std::string> cases[] = {
        {refusal({{"blur_radius", "3"}}),
         "texture_space: blur=profile has no blur_radius to set; drop blur_radius or set blur=poisson"},
        {refusal({{"blur", "kawase"}, {"blur_radius", "3"}}),
         "texture_space: blur=kawase has no blur_radius to set; drop blur_radius or set blur=poisson"},
        {refusal({{"dilate", "off"}}),
         "texture_space: blur=profile crosses chart borders and has nothing to dilate; drop dilate or set "
         "blur=poisson"},
        {refusal({{"blur", "box"}, {"blur_radius", "3"}, {"dilate", "off"}}), ""}};
    for (const auto& [message, expected] : cases) EXPECT_EQ(message, expected);
}

TEST_F(TextureSpace, the_presets_are_what_their_names_say) {
    const Scene scene = load("bust");
    Renderer renderer = make_renderer(scene);
    const auto passes_of = [&](const char* preset) {
        draw(renderer, with({{"preset", preset}}));
        std::vector<std::string> shaders;
        for (const Pass& pass : renderer.list().passes) shaders.push_back(pass.shader);
        return std::pair(std::ranges::count(shaders, "texture_space/blur.frag"),
                         std::ranges::count(shaders, "texture_space/blur_mm.frag"));
    };
    EXPECT_EQ(passes_of("source"), std::pair(std::ptrdiff_t(4), std::ptrdiff_t(0)));
    EXPECT_EQ(passes_of("cheap"), std::pair(std::ptrdiff_t(0), std::ptrdiff_t(2)));
    EXPECT_EQ(renderer.list().find_image("light_map_a")->size.width, 256);
    EXPECT_EQ(passes_of("best").first, 0);
    EXPECT_EQ(renderer.list().find_image("light_map_a")->size.width, 1024);
}

namespace {

class TextureSpaceSpecular : public TextureSpace {
  protected:
    static inline const DrawSettings kSpecular = {
        .width = 128, .height = 128, .view = "specular", .deep = true, .shadow_map_size = 512};

    static Image specular(Renderer& renderer, const char* how) {
        return radiance(renderer, built_in_technique("texture_space"),
                        with({{"specular_shadow", how}, {"light_map_size", "256"}}), kSpecular);
    }
    static Scene lit_by(Scene scene, float key_intensity) {
        for (Light& light : scene.lights) light.intensity = light.is_key ? key_intensity : 0;
        scene.environment = {.kind = EnvironmentKind::studio, .intensity = 1};
        return scene;
    }
    /// What the key's shadow takes from the specular, summed, for a key of intensity 1.
    static double taken(const Scene& scene, const char* how, float key_intensity) {
        const Scene lit = lit_by(scene, key_intensity);
        Renderer renderer = make_renderer(lit);
        const Image off = specular(renderer, "off"), dimmed = specular(renderer, how);
        double sum = 0;
        for (int y = 0; y < off.height; ++y)
            for (int x = 0; x < off.width; ++x) sum += double(off.at(x, y, 0)) - double(dimmed.at(x, y, 0));
        return sum / double(key_intensity);
    }
};

}  // namespace

TEST_F(TextureSpaceSpecular, its_shadow_does_not_depend_on_how_bright_the_key_is) {
    const Scene bust = load("bust");
    const double bright = taken(bust, "shadow_map", 6), dim = taken(bust, "shadow_map", 1);
    EXPECT_GT(bright, 0);
    EXPECT_NEAR(dim, bright, 1e-2 * bright);
    // With specular_shadow=source it does.
    EXPECT_LT(taken(bust, "source", 1), 0.5 * taken(bust, "source", 6));
}

TEST_F(TextureSpaceSpecular, is_that_of_every_other_technique) {
    const Scene scene = load("bust");
    Renderer renderer = make_renderer(scene);
    const Image lambert = radiance(renderer, built_in_technique("lambert"), kSpecular);
    EXPECT_LT(mean_difference(lambert, specular(renderer, "shadow_map")), 1e-5);
    EXPECT_GT(mean_difference(lambert, specular(renderer, "source")), 2e-4);
}
