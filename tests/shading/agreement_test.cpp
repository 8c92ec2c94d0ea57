// Each language's text gives the same numbers as the source that the renderer uses: random arguments over the
// whole domain of each function, evaluated by g++ and by lavapipe. MSL is compiled as C++, over a header with
// Metal's vectors and functions: that is its arithmetic only. gdshader is compiled as GLSL.

#include <cstdlib>
#include <string_view>

#include "catalog/catalog.h"
#include "dermis/optics/gaussian_fit.h"
#include "dermis/optics/preintegration.h"
#include "dermis/optics/presets.h"
#include "dermis/shading/skin_text.h"
#include "shading/evaluate.h"
#include "support/gpu_fixture.h"

namespace dermis::shading {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class Agreement : public gpu::GpuTest {
  protected:
    static void SetUpTestSuite() {
        GpuTest::SetUpTestSuite();
        const auto profile = find_profile("openpbr_skin_5");
        ASSERT_TRUE(profile);
        std::vector<Source> sources(shading::skin_sources().begin(), shading::skin_sources().end());
        const auto own = profile_source(*profile);
        ASSERT_TRUE(own) << own.error().message;
        sources.push_back(*own);
        const auto units = read_sources(sources);
        ASSERT_TRUE(units) << units.error().message;
        units_ = *units;
        prefix_names(units_);
        auto sampled = sample_functions(units_);
        ASSERT_TRUE(sampled) << sampled.error().message;
        functions_ = std::move(*sampled);
        const auto reference = evaluate(Language::cpp);
        ASSERT_TRUE(reference) << reference.error().message;
        reference_ = *reference;
    }

    // Its arguments and its results in C++.
    static std::pair<const Sampled*, const std::vector<float>*> sampled_function(std::string_view name) {
        for (size_t i = 0; i < functions_.size(); ++i)
            if (functions_[i].name == name) return {&functions_[i], &reference_[i]};
        return {};
    }

    // The text, with a mistake if one is given.
    static std::string text_of(Language language, const std::string& wrong = {},
                               const std::string& with = {}) {
        std::string text = print(units_, language, {});
        if (!wrong.empty()) {
            const size_t at = text.find(wrong);
            EXPECT_NE(at, std::string::npos) << wrong;
            if (at != std::string::npos) text.replace(at, wrong.size(), with);
        }
        return text;
    }

    static Result<Outputs> evaluate(Language language, const std::string& wrong = {},
                                    const std::string& with = {}) {
        const std::string text = text_of(language, wrong, with);
        if (language == Language::cpp || language == Language::msl)
            return evaluate_on_cpu(text, language, functions_);
        return evaluate_on_gpu(device(), text, language, functions_);
    }

    // The functions whose results differ from the reference by more than their bounds.
    static std::vector<std::string> differing(const Result<Outputs>& outputs) {
        EXPECT_TRUE(outputs) << outputs.error().message;
        std::vector<std::string> names;
        for (size_t i = 0; outputs && i < functions_.size(); ++i) {
            const double worst = worst_difference(functions_[i], reference_[i], (*outputs)[i]);
            RecordProperty(functions_[i].name, std::to_string(worst));
            if (!(worst <= 1)) names.push_back(functions_[i].name);
        }
        return names;
    }

    static std::string find_program(std::initializer_list<const char*> names) {
        for (const char* name : names)
            if (std::system(("command -v " + std::string(name) + " >/dev/null 2>&1").c_str()) == 0)
                return name;
        return "";
    }

    inline static std::vector<Unit> units_;
    inline static std::vector<Sampled> functions_;
    inline static Outputs reference_;
};

TEST_F(Agreement, of_every_language_with_cpp) {
    EXPECT_GT(functions_.size(), 25u);
    for (const Language language :
         {Language::glsl, Language::essl, Language::hlsl, Language::gdshader, Language::msl})
        EXPECT_THAT(differing(evaluate(language)), IsEmpty()) << language_name(language);
}

// A mistake in one place of one language is found, and only there.
TEST_F(Agreement, finds_a_mistake_in_each_language) {
    EXPECT_THAT(differing(evaluate(Language::glsl, "mix(dark, lit,", "mix(lit, dark,")),
                ElementsAre("skin_curve_2015_direct"));
    EXPECT_THAT(differing(evaluate(Language::hlsl, "lerp(dark, lit,", "lerp(lit, dark,")),
                ElementsAre("skin_curve_2015_direct"));
    EXPECT_THAT(
        differing(evaluate(Language::essl, "return kSkinPi * (2.0 - w)", "return kSkinPi * (2.001 - w)")),
        ElementsAre("skin_wrapped_band_1"));
    EXPECT_THAT(differing(evaluate(Language::gdshader, "m.z * d.y + m.y", "m.z * d.y - m.y")),
                ElementsAre("skin_tensor_times", "skin_curvature_towards", "skin_gather_bends"));
    EXPECT_THAT(differing(evaluate(Language::msl, "saturate(length(fwidth_n))", "length(fwidth_n)")),
                ElementsAre("skin_curvature_from_derivatives"));
    EXPECT_THAT(differing(evaluate(Language::cpp, "max(4.0f * h_dot_v", "max(4.01f * h_dot_v")),
                ElementsAre("skin_kelemen_szirmay_kalos"));
}

// What the comments of the table-free diffuse functions promise, on spheres of every radius that they name.
TEST_F(Agreement, of_the_diffuse_functions_with_the_integral_is_as_good_as_they_say) {
    const Profile profile = *find_profile("openpbr_skin_5");
    const GaussianSum gaussians = to_gaussian_sum(profile).sum;
    const std::string text = profile_source(profile)->text;
    for (const auto& [name, most_per_mm] :
         {std::pair{"skin_diffuse", 1.0}, {"skin_spherical_gaussians", 0.5}}) {
        const size_t function = text.find(std::string("vec3 ") + name + "(");
        ASSERT_NE(function, std::string::npos) << name;
        const size_t promise = text.rfind("Within ", function);
        const double promised = std::stod(text.substr(promise + 7));
        const auto [sampled, results] = sampled_function(name);
        ASSERT_TRUE(sampled) << name;
        double worst = 0;
        for (size_t i = 0; i < 4000; ++i) {
            const double n_dot_l = double(sampled->inputs[2 * i]), k = double(sampled->inputs[2 * i + 1]);
            if (k > most_per_mm) continue;
            const Rgb exact = preintegrated_diffuse(gaussians, n_dot_l, 1 / std::max(k, 1e-6));
            for (size_t c = 0; c < 3; ++c)
                worst = std::max(worst, std::abs(double((*results)[4 * i + c]) - exact[c]));
        }
        EXPECT_LT(worst, promised) << name;
        EXPECT_GT(worst, promised / 3) << name << ": the comment says less than is true";
    }
}

// WGSL has no other compiler here; ESSL 3.00 is compiled as what it is.
TEST_F(Agreement, of_wgsl_and_essl_in_a_browser) {
    const std::string chromium = find_program({"chromium", "chromium-browser", "google-chrome"});
    if (chromium.empty() || find_program({"node"}).empty()) GTEST_SKIP() << "no chromium or no node here";
    const char* wanted = std::getenv("DERMIS_BROWSER_SAMPLES");
    const size_t side = wanted && std::string_view(wanted) == "all" ? kSampleSide : 56;
    for (const Language language : {Language::wgsl, Language::essl}) {
        const Result<Outputs> outputs =
            evaluate_in_browser(chromium, text_of(language), language, functions_, side);
        if (!outputs && outputs.error().message.starts_with(kBrowserLacks))
            GTEST_SKIP() << outputs.error().message;
        EXPECT_THAT(differing(outputs), IsEmpty()) << language_name(language);
    }
    const std::string wrong = text_of(Language::wgsl, "step(kappa, vec3f(0.5))", "step(vec3f(0.5), kappa)");
    const auto [sampled, right] = sampled_function("skin_lobe_band_1");
    ASSERT_TRUE(sampled);
    const Result<Outputs> outputs = evaluate_in_browser(chromium, wrong, Language::wgsl, {*sampled}, side);
    ASSERT_TRUE(outputs) << outputs.error().message;
    EXPECT_GT(worst_difference(*sampled, *right, outputs->front()), 1);
}

}  // namespace
}  // namespace dermis::shading
