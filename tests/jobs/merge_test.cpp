// Any split of a picture's samples gives the bytes of one run; parts that do not fit are refused by name.

#include "dermis/jobs/part.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <random>

#include "dermis/base/file.h"
#include "jobs/parts.h"

using namespace dermis;
using namespace dermis::test;
using testing::HasSubstr;

namespace {

namespace fs = std::filesystem;

std::string merge_error(const std::vector<fs::path>& files) {
    const Result<MergedPicture> merged = merge_parts(files);
    return merged ? "" : merged.error().message;
}

void expect_same_pictures(const ReferencePicture& a, const ReferencePicture& b, const std::string& which) {
    EXPECT_EQ(a.radiance.bytes, b.radiance.bytes) << which;
    EXPECT_EQ(a.diffuse.bytes, b.diffuse.bytes) << which;
    EXPECT_EQ(a.specular.bytes, b.specular.bytes) << which;
    EXPECT_EQ(a.variance.bytes, b.variance.bytes) << which;
    EXPECT_EQ(a.samples.bytes, b.samples.bytes) << which;
    EXPECT_EQ(a.skin.bytes, b.skin.bytes) << which;
    EXPECT_EQ(a.relative_error, b.relative_error) << which;
    EXPECT_EQ(a.passes, b.passes) << which;
    EXPECT_EQ(a.warnings, b.warnings) << which;
}

}  // namespace

TEST(MergedPictures, any_split_in_any_order_has_the_bits_of_one_run) {
    const Result<ReferencePicture> whole = render_reference(lit_sphere(), part_settings());
    ASSERT_TRUE(whole);
    ASSERT_GT(whole->relative_error, 0.0);
    const std::vector<std::vector<int>> splits = {
        {0, 28}, {0, 8, 28}, {0, 4, 24, 28}, {0, 4, 8, 12, 16, 20, 24, 28}};
    std::mt19937 random(7);
    PartFiles files;
    for (const std::vector<int>& ends : splits) {
        std::vector<fs::path> parts;
        for (size_t i = 0; i + 1 < ends.size(); ++i) parts.push_back(files.write({ends[i], ends[i + 1]}));
        for (int order = 0; order < 3; ++order) {
            const Result<MergedPicture> merged = merge_parts(parts);
            ASSERT_TRUE(merged) << merged.error().message;
            expect_same_pictures(merged->picture, *whole, std::to_string(parts.size()) + " parts");
            std::shuffle(parts.begin(), parts.end(), random);
        }
    }
}

TEST(MergedPictures, a_picture_can_get_more_samples_later) {
    PartFiles files;
    const fs::path first = files.write({0, 8}, [] {
        PartFacts facts = part_facts({0, 8});
        facts.samples = 8;
        return facts;
    }());
    const Result<MergedPicture> early = merge_parts(std::vector{first});
    ASSERT_TRUE(early) << early.error().message;
    EXPECT_EQ(early->picture.passes, 8);
    const Result<MergedPicture> more = merge_parts(std::vector{first, files.write({8, 28})});
    ASSERT_TRUE(more) << more.error().message;
    expect_same_pictures(more->picture, *render_reference(lit_sphere(), part_settings()), "more");
}

TEST(MergedPictures, parts_of_another_picture_are_refused_by_the_fact_that_differs) {
    PartFiles files;
    const fs::path first = files.write({0, 8});
    const auto refused = [&](auto change) {
        PartFacts facts = part_facts({8, 28});
        change(facts);
        return merge_error({first, files.write({8, 28}, facts)});
    };
    EXPECT_EQ(refused([](PartFacts&) {}), "");
    EXPECT_THAT(refused([](PartFacts& f) { f.version = "v2"; }),
                HasSubstr("version of dermis is v2, there it is v1"));
    EXPECT_THAT(refused([](PartFacts& f) { f.content = "c2"; }), HasSubstr("content of the scene"));
    EXPECT_THAT(refused([](PartFacts& f) { f.picture.exposure_ev = 1; }), HasSubstr("exposure is 1.0"));
    EXPECT_THAT(refused([](PartFacts& f) { f.picture.credit = ""; }), HasSubstr("credit"));
    EXPECT_THAT(refused([](PartFacts& f) { f.picture.scene_warnings = {}; }), HasSubstr("warnings"));
    EXPECT_THAT(refused([](PartFacts& f) { f.picture.description = R"({"scene":"sphere","passes":null})"; }),
                HasSubstr("part_8_28.exr is a part of another picture than"));
    const std::string seed =
        refused([](PartFacts& f) { f.picture.description = R"({"scene":"sphere","passes":null,"seed":2})"; });
    EXPECT_THAT(seed, HasSubstr("part_8_28.exr is a part of another picture than"));
    EXPECT_THAT(seed, HasSubstr("part_0_8.exr: its seed is 2, there it is 1"));
}

TEST(MergedPictures, overlaps_and_holes_are_named_with_the_mend) {
    PartFiles files;
    const fs::path a = files.write({0, 8}), b = files.write({4, 12}), c = files.write({16, 20});
    const std::string overlap = merge_error({a, c, b});
    EXPECT_THAT(overlap, HasSubstr("part_4_12.exr (samples 4:12)"));
    EXPECT_THAT(overlap, HasSubstr("part_0_8.exr (samples 0:8)"));
    EXPECT_THAT(overlap, HasSubstr("in common: leave one out"));
    EXPECT_THAT(merge_error({a, a}), HasSubstr("in common"));
    EXPECT_THAT(merge_error({c, a}),
                HasSubstr("samples 8:16, 20:28 of 0:28 are in no part; run: dermis reference sphere "
                          "--samples 28 --sample-range 8:16 -o FILE.exr, and so for each range"));
    EXPECT_THAT(merge_error({}), HasSubstr("no part is named"));
}

TEST(MergedPictures, a_part_that_was_cut_off_is_named_and_nothing_else_has_to_be_done) {
    PartFiles files;
    const fs::path a = files.write({0, 8}), b = files.write({8, 16}), c = files.write({16, 28});
    fs::resize_file(b, fs::file_size(b) / 2);
    const std::string error = merge_error({a, b, c});
    EXPECT_THAT(error, HasSubstr("part_8_16.exr"));
    EXPECT_THAT(error, HasSubstr("; samples 8:16 of 0:28 are in no part; run: dermis reference"));
    files.write({8, 16});
    EXPECT_EQ(merge_error({a, b, c}), "");
    fs::resize_file(files.write({8, 28}), 100);
    EXPECT_THAT(merge_error({a, b, c, files.path("part_8_28.exr")}),
                HasSubstr("all samples are in the other parts: leave it out"));
}

TEST(MergedPictures, brighter_samples_than_the_sums_hold_are_cut_and_counted) {
    Scene scene = lit_sphere();
    scene.lights[0].intensity = 1e9f;
    const Result<ReferencePicture> picture = render_reference(scene, part_settings());
    ASSERT_TRUE(picture);
    ASSERT_EQ(picture->warnings.size(), 1u);
    EXPECT_THAT(picture->warnings[0], HasSubstr("above 4194304"));
    EXPECT_LE(picture->radiance.at(5, 4, 0), kBrightest);
}
