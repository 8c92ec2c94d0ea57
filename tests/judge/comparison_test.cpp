// The whole of it on a small picture: reference, techniques, page.

#include "dermis/judge/comparison.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "dermis/judge/reference_cache.h"
#include "dermis/judge/report.h"
#include "render/render_test.h"
#include "support/built_in.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::HasSubstr;
using testing::Not;

namespace {

// Its own cache, so that no earlier result is used.
class Comparisons : public RenderTest {
  protected:
    void SetUp() override {
        RenderTest::SetUp();
        ::setenv("DERMIS_CACHE", directory_.path.c_str(), 1);
    }
    void TearDown() override {
        ::unsetenv("DERMIS_CACHE");
        RenderTest::TearDown();
    }
    static ComparisonSettings quick() {
        ComparisonSettings settings = comparison_settings(64, 64);
        settings.shadow_map_size = 1024;
        settings.frames = 1;
        settings.grid = 2;
        settings.samples = 16;
        settings.noise = 1;
        settings.probes = 16;
        return settings;
    }
    static std::vector<Contestant> contestants(std::string_view text) {
        auto list = parse_technique_list(built_in_catalog().techniques, text);
        EXPECT_TRUE(list) << list.error().message;
        return *list;
    }

    TemporaryDirectory directory_;
};

}  // namespace

TEST_F(Comparisons, the_reference_is_made_once_and_the_page_holds_every_picture) {
    Scene scene = load("builtin:spheres");
    scene.name = "</script><b>\"spheres\"";
    const auto list = contestants("lambert,preintegrated[diffuse=closed_form]");
    const auto first = compare_techniques(device(), built_in_catalog(), scene, list, quick());
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_FALSE(first->reference.from_cache);
    const auto second = compare_techniques(device(), built_in_catalog(), scene, list, quick());
    ASSERT_TRUE(second);
    EXPECT_TRUE(second->reference.from_cache);
    EXPECT_EQ(first->rows[1].scores.rmse, second->rows[1].scores.rmse);
    EXPECT_EQ(first->reference.effect.b.bytes, second->reference.effect.b.bytes);
    EXPECT_EQ(first->rows[0].first.captured.all.share, 0) << "lambert is where the share begins";
    EXPECT_GT(first->rows[1].first.captured.all.share, 0.3);
    EXPECT_LT(first->rows[1].scores.terminator_rmse, first->rows[0].scores.terminator_rmse)
        << "scattering should come closer to the reference than none";
    EXPECT_EQ(first->rows[0].cost.bytes(), 0u);
    EXPECT_EQ(first->rows[0].cost.time_ratio, 1);
    EXPECT_GT(first->rows[1].cost.time_ms, 0);

    const auto page = report_html(scene, *first, quick());
    ASSERT_TRUE(page) << page.error().message;
    const std::string begin = "const data = ";
    const size_t at = page->find(begin) + begin.size();
    const auto data = nlohmann::json::parse(page->substr(at, page->find(";\n", at) - at), nullptr, false);
    ASSERT_TRUE(data.is_object());
    EXPECT_EQ(data["scene"], scene.name);
    EXPECT_EQ(data["images"].size(), 3 + 5 * list.size());
    for (const auto& image : data["images"])
        EXPECT_TRUE(image["uri"].get<std::string>().starts_with("data:image/png;base64,iVBOR"));
    EXPECT_EQ(data["rows"][1]["settings"], "diffuse=closed_form");
    EXPECT_THAT(*page, Not(HasSubstr("</script><b>")));
    EXPECT_THAT(*page, Not(HasSubstr("http://")));
    EXPECT_THAT(*page, Not(HasSubstr("https://")));
}

TEST_F(Comparisons, progress_rises_from_0_to_the_last_picture_and_never_falls) {
    std::vector<double> seen;
    std::vector<std::string> names;
    ComparisonSettings settings = quick();
    settings.frames = 2;
    settings.noise = 1e-6;
    settings.samples = 64;
    const auto comparison =
        compare_techniques(device(), built_in_catalog(), load("builtin:spheres"), contestants("lambert,wrap"),
                           settings, {.progress = [&](double done, const std::string& name) {
                               seen.push_back(done);
                               if (names.empty() || names.back() != name) names.push_back(name);
                           }});
    ASSERT_TRUE(comparison) << comparison.error().message;
    EXPECT_LT(seen.front(), 0.2);
    for (size_t i = 1; i < seen.size(); ++i) EXPECT_GE(seen[i], seen[i - 1]) << i;
    EXPECT_GT(seen.back(), 0.8);
    EXPECT_LT(seen.back(), 1);
    const auto at = [&](const std::string& name) { return std::ranges::find(names, name) - names.begin(); };
    const auto end = std::ssize(names);
    EXPECT_EQ(names.front(), "reference surface, first samples");
    EXPECT_LT(at("wrap"), at("frame times, wrap"));
    EXPECT_LT(at("wrap"), at("reference surface"));
    EXPECT_LT(at("frame times, wrap"), at("errors of the pictures"));
    EXPECT_LT(at("reference surface"), at("errors of the pictures"));
    EXPECT_LT(at("errors of the pictures"), end);
}

TEST_F(Comparisons, a_picture_of_ones_own_gets_the_share_of_what_drew_it) {
    const Scene scene = load("builtin:spheres");
    const auto list = contestants("lambert,wrap");
    ComparisonSettings settings = quick();
    const auto drawn = compare_techniques(device(), built_in_catalog(), scene, list, settings);
    ASSERT_TRUE(drawn) << drawn.error().message;
    OwnPicture same{"same", drawn->rows[1].radiance, drawn->rows[0].radiance}, bright = same;
    bright.name = "bright";
    for (float& value : bright.without.floats()) value *= 1.5f;
    settings.pictures = {same, bright};
    const auto judged = compare_techniques(device(), built_in_catalog(), scene, list, settings);
    ASSERT_TRUE(judged) << judged.error().message;
    ASSERT_EQ(judged->rows.size(), 4u);
    EXPECT_EQ(judged->rows[2].contestant.name(), "picture[same]");
    EXPECT_NEAR(judged->rows[2].first.captured.all.share, judged->rows[1].first.captured.all.share, 1e-5);
    EXPECT_LT(judged->rows[3].first.captured.all.share, -1);
    EXPECT_THAT(judged->warnings, testing::ElementsAre(HasSubstr("picture[bright]: without scattering it")));

    settings.pictures = {{"small", Image(32, 32, 3), Image(32, 32, 3)}};
    const auto small = compare_techniques(device(), built_in_catalog(), scene, list, settings);
    ASSERT_FALSE(small);
    EXPECT_EQ(small.error().message, "small, with scattering: is 32x32, the comparison 64x64");
    same.without.floats()[5] = NAN;
    settings.pictures = {same};
    const auto no_number = compare_techniques(device(), built_in_catalog(), scene, list, settings);
    ASSERT_FALSE(no_number);
    EXPECT_THAT(no_number.error().message, HasSubstr("same, without scattering: has values"));
}

TEST_F(Comparisons, a_reference_that_is_stopped_is_judged_with_what_it_has_and_goes_on_later) {
    const Scene scene = load("builtin:spheres");
    ComparisonSettings settings = quick();
    settings.noise = 1e-6;
    std::atomic<bool> stop = false;
    int refined = 0;
    const ComparisonHooks hooks{
        .shares =
            [&](Integrator, const std::vector<Compared>& rows, const std::vector<CapturedShare>& shares) {
                EXPECT_EQ(rows.size(), shares.size());
                EXPECT_GT(shares[1].error, 0);
                ++refined;
                stop = true;
            },
        .stop = &stop};
    const auto list = contestants("lambert,wrap");
    settings.samples = 128;
    const auto first = compare_techniques(device(), built_in_catalog(), scene, list, settings, hooks);
    ASSERT_TRUE(first) << first.error().message;
    EXPECT_TRUE(first->reference.stopped);
    EXPECT_FALSE(first->reference.reached);
    EXPECT_LT(first->reference.samples, settings.samples);
    EXPECT_EQ(refined, 1);
    const auto whole = compare_techniques(device(), built_in_catalog(), scene, list, settings);
    ASSERT_TRUE(whole) << whole.error().message;
    EXPECT_EQ(whole->reference.samples, settings.samples);
    stop = true;
    ::setenv("DERMIS_CACHE", (directory_.path / "empty").c_str(), 1);
    EXPECT_FALSE(compare_techniques(device(), built_in_catalog(), scene, list, settings, hooks));
}

TEST_F(Comparisons, stopped_before_the_second_reference_has_samples_it_is_judged_by_the_first_alone) {
    ComparisonSettings settings = quick();
    settings.second = settings.reference.integrator;
    settings.reference.integrator = Integrator::walk;
    std::atomic<bool> stop = false;
    const ComparisonHooks hooks{.shares = [&](Integrator, const std::vector<Compared>&,
                                              const std::vector<CapturedShare>&) { stop = true; },
                                .stop = &stop};
    const auto made = compare_techniques(device(), built_in_catalog(), load("builtin:spheres"),
                                         contestants("lambert,wrap"), settings, hooks);
    ASSERT_TRUE(made) << made.error().message;
    EXPECT_FALSE(made->second || made->second_integrator || made->rows[1].second);
    EXPECT_GT(made->rows[1].first.captured.all.effect_rms, 0);
    EXPECT_THAT(made->warnings, Contains(HasSubstr("without its shares")));
}

TEST_F(Comparisons, a_finer_reference_of_another_run_is_taken_as_it_is) {
    const Scene scene = load("builtin:spheres");
    ComparisonSettings fine = quick(), coarse = quick();
    fine.noise = 1e-6;
    fine.samples = 32;
    coarse.noise = 1e-6;
    const auto first = compare_techniques(device(), built_in_catalog(), scene, contestants("lambert"), fine);
    ASSERT_TRUE(first) << first.error().message;
    const auto second =
        compare_techniques(device(), built_in_catalog(), scene, contestants("lambert"), coarse);
    ASSERT_TRUE(second) << second.error().message;
    EXPECT_TRUE(second->reference.from_cache);
    EXPECT_EQ(second->reference.samples, first->reference.samples);
}

TEST_F(Comparisons, whatever_the_reference_depends_on_changes_its_hash) {
    const Scene scene = load("builtin:spheres");
    const ReferenceSettings settings = quick().reference;
    const std::string before = *reference_hash(scene, settings);
    const auto changed = [&](auto change) {
        Scene other = scene;
        ReferenceSettings own = settings;
        change(other, own);
        return *reference_hash(other, own) != before;
    };
    EXPECT_TRUE(changed([](Scene& s, auto&) { s.objects[0].mesh.positions_mm[7].x += 1e-3f; }));
    EXPECT_TRUE(changed([](Scene& s, auto&) { s.objects[0].mesh.materials[0].roughness = 0.41f; }));
    EXPECT_TRUE(changed([](Scene& s, auto&) { s.lights[0].intensity = 1; }));
    EXPECT_TRUE(changed([](Scene& s, auto&) { s.camera.eye_mm.x += 1; }));
    EXPECT_TRUE(changed([](Scene& s, auto&) { s.environment.intensity = 0.1f; }));
    EXPECT_TRUE(changed([](Scene& s, auto&) { s.skin.profile = "burley:1,.4,.2"; }));
    EXPECT_TRUE(changed([](Scene&, ReferenceSettings& r) { r.seed = 2; }));
    EXPECT_TRUE(changed([](Scene&, ReferenceSettings& r) { r.lighting.penumbra_mm = 3; }));
    EXPECT_FALSE(changed([](Scene& s, auto&) { s.name = "another", s.exposure_ev = 3; }));
}

TEST_F(Comparisons, a_scene_without_skin_is_refused) {
    Scene scene = load("builtin:spheres");
    for (SceneObject& object : scene.objects)
        for (MaterialClass& material_class : object.classes) material_class = MaterialClass::other;
    const auto comparison =
        compare_techniques(device(), built_in_catalog(), scene, contestants("lambert"), quick());
    ASSERT_FALSE(comparison);
    EXPECT_THAT(comparison.error().message, HasSubstr("no pixel shows skin"));
}

TEST(Base64, agrees_with_the_published_vectors) {
    // RFC 4648, section 10.
    const auto encoded = [](std::string_view text) { return base64(as_bytes(text)); };
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foo"), "Zm9v");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
}
