// Rules for every technique; none of these tests needs a GPU.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "dermis/base/text.h"
#include "dermis/render/shared_passes.h"
#include "support/built_in.h"

using namespace dermis;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

namespace {

// Every preset; and from each, every choice of every parameter, one at a time, and both ends of every range.
// What the technique refuses is left out, once its message is found to be a line that names what to change.
std::vector<ParameterValues> variations(const Technique& technique) {
    std::vector<ParameterValues> all;
    const auto add = [&](const ParameterValues& values) {
        const Result<void> checked = check_settings(technique, values);
        if (checked) return all.push_back(values);
        EXPECT_THAT(checked.error().message, StartsWith(technique.id + ": "));
        EXPECT_THAT(checked.error().message, HasSubstr("; "));
        EXPECT_THAT(checked.error().message, Not(HasSubstr("\n")));
    };
    for (const ParameterPreset& preset : technique.parameters.presets) {
        ParameterValues base(technique.parameters);
        EXPECT_TRUE(base.set("preset", preset.name));
        EXPECT_TRUE(check_settings(technique, base)) << technique.id << " " << preset.name;
        add(base);
        for (const Parameter& parameter : technique.parameters.parameters) {
            std::vector<double> values = {parameter.min, parameter.max};
            for (size_t i = 0; i < parameter.choices.size(); ++i) values.push_back(double(i));
            for (const double value : values) {
                ParameterValues varied = base;
                varied.put(parameter, {value, value, value});
                add(varied);
            }
        }
    }
    return all;
}

std::vector<std::string> inputs_of(const Technique& technique, const ParameterValues& values) {
    std::vector<std::string> inputs = shared_inputs();
    if (!technique.tables) return inputs;
    const Profile skin = {.name = "gpu_gems_3", .model = gpu_gems_3_skin()};
    const auto tables = technique.tables(values, {.profile = skin, .gaussians = gpu_gems_3_skin()});
    EXPECT_TRUE(tables.ok()) << technique.id;
    if (tables)
        for (const TableImage& table : *tables) inputs.push_back(table.name);
    return inputs;
}

}  // namespace

TEST(AllTechniques, are_found_by_their_folders) {
    std::set<std::string> ids;
    for (const Technique& technique : built_in_catalog().techniques)
        EXPECT_TRUE(ids.insert(technique.id).second);
    for (const char* id : {"lambert", "oren_nayar", "wrap"}) EXPECT_TRUE(ids.contains(id)) << id;
    EXPECT_EQ(find_technique(built_in_catalog().techniques, "lambart").error().message.substr(0, 52),
              "unknown technique 'lambart'; did you mean 'lambert'?");
}

TEST(AllTechniques, have_one_baseline) {
    const std::span<const Technique> all = built_in_catalog().techniques;
    EXPECT_EQ(std::ranges::count(all, true, &Technique::is_baseline), 1);
    ASSERT_TRUE(find_baseline(all));
    EXPECT_EQ((*find_baseline(all))->id, "lambert");
    EXPECT_EQ(find_baseline(all.first(0)).error().message,
              "no technique is the baseline: set is_baseline in techniques/<id>/technique.cpp");
}

TEST(AllTechniques, say_what_they_are_and_document_every_parameter_and_preset) {
    constexpr size_t kLongestSummary = 55;  // `dermis techniques` has a line of 80 columns for each
    for (const Technique& technique : built_in_catalog().techniques) {
        EXPECT_FALSE(technique.summary.empty()) << technique.id;
        EXPECT_LE(technique.summary.size(), kLongestSummary) << technique.id;
        std::set<std::string> presets;
        for (const ParameterPreset& preset : technique.parameters.presets) {
            EXPECT_FALSE(preset.doc.empty()) << technique.id << " " << preset.name;
            EXPECT_TRUE(presets.insert(preset.name).second) << technique.id << " " << preset.name;
        }
        EXPECT_EQ(technique.parameters.presets.front().name, "default") << technique.id;
        EXPECT_FALSE(technique.source.empty()) << technique.id;
        std::set<std::string> names;
        for (const Parameter& parameter : technique.parameters.parameters) {
            EXPECT_FALSE(parameter.doc.empty()) << technique.id << " " << parameter.name;
            EXPECT_TRUE(names.insert(parameter.name).second) << technique.id << " " << parameter.name;
            for (size_t c = 0; c < parameter.component_count(); ++c) {
                EXPECT_GE(parameter.default_value[c], parameter.min) << technique.id << " " << parameter.name;
                EXPECT_LE(parameter.default_value[c], parameter.max) << technique.id << " " << parameter.name;
            }
        }
    }
}

TEST(AllTechniques, build_sound_frames_for_every_setting_view_and_sample_count) {
    for (const Technique& technique : built_in_catalog().techniques) {
        for (const ParameterValues& values : variations(technique)) {
            const std::vector<std::string> inputs = inputs_of(technique, values);
            for (const std::string& view : view_names(technique))
                for (const int samples : {1, 4}) {
                    const bool glass = samples == 4;  // with something translucent, and without
                    const PassList own = technique.build(
                        values, {.view = view, .has_translucent = glass, .has_second_light = glass});
                    const PassList frame = frame_passes(own, {.samples = samples,
                                                              .view = view,
                                                              .has_other = true,
                                                              .has_blended = true,
                                                              .has_translucent = glass});
                    for (const std::string& problem : problems(frame, inputs))
                        ADD_FAILURE() << technique.id << " view " << view << ": " << problem;
                }
        }
    }
}

TEST(AllTechniques, building_is_pure) {
    for (const Technique& technique : built_in_catalog().techniques) {
        const ParameterValues values(technique.parameters);
        EXPECT_EQ(describe(technique.build(values, {})), describe(technique.build(values, {})))
            << technique.id;
    }
}

TEST(AllTechniques, coarse_settings_stay_in_their_ranges) {
    int with_one = 0;
    for (const Technique& technique : built_in_catalog().techniques) {
        if (!technique.coarse) continue;
        ++with_one;
        for (const ParameterValues& values : variations(technique))
            for (const float scale : {0.75f, 0.25f}) {
                const ParameterValues coarse = technique.coarse(values, scale);
                for (const Parameter& parameter : technique.parameters.parameters) {
                    ParameterValues checked(technique.parameters);
                    EXPECT_TRUE(checked.set(parameter.name, coarse.text(parameter)))
                        << technique.id << " " << parameter.name;
                    if (parameter.kind == ParameterKind::integer) {
                        EXPECT_LE(coarse.get(parameter)[0], values.get(parameter)[0])
                            << technique.id << " " << parameter.name;
                    }
                }
            }
    }
    EXPECT_GT(with_one, 0);
}
