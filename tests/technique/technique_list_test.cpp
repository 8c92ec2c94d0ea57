#include "dermis/technique/technique_list.h"
#include "support/built_in.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace dermis;
using testing::HasSubstr;

namespace {

std::string error_of(std::string_view text) {
    const auto list = parse_technique_list(built_in_catalog().techniques, text);
    return list ? "no error" : list.error().message;
}

}  // namespace

TEST(TechniqueList, names_and_settings_are_taken_apart) {
    const auto list = parse_technique_list(
        built_in_catalog().techniques,
        "lambert, wrap[wrap=0.4, scatter_color_linear=.1,.2,.3 ],preintegrated[diffuse=closed_form]");
    ASSERT_TRUE(list) << list.error().message;
    ASSERT_EQ(list->size(), 3u);
    EXPECT_EQ((*list)[0].name(), "lambert");
    const Contestant& wrap = (*list)[1];
    EXPECT_EQ(wrap.name(), "wrap[wrap=0.4,scatter_color_linear=.1,.2,.3]");
    EXPECT_DOUBLE_EQ(wrap.values.get(*wrap.values.table().find("wrap"))[0], 0.4f);
    EXPECT_FLOAT_EQ(float(wrap.values.get(*wrap.values.table().find("scatter_color_linear"))[2]), 0.3f);
    EXPECT_EQ((*list)[2].values.text(*(*list)[2].values.table().find("diffuse")), "closed_form");
}

TEST(TechniqueList, brackets_hold_at_least_one_setting) {
    EXPECT_THAT(error_of("wrap[]"), HasSubstr("wrap: '': write name=value"));
}

TEST(TechniqueList, mistakes_are_named) {
    EXPECT_THAT(error_of(""), HasSubstr("an entry is empty"));
    EXPECT_THAT(error_of("lambert,,wrap"), HasSubstr("an entry is empty"));
    EXPECT_THAT(error_of("lambart"), HasSubstr("did you mean 'lambert'?"));
    EXPECT_THAT(error_of("wrap[wrap=0.4"), HasSubstr("brackets do not match"));
    EXPECT_THAT(error_of("wrap]"), HasSubstr("brackets do not match"));
    EXPECT_THAT(error_of("wrap[[wrap=1]]"), HasSubstr("brackets do not match"));
    EXPECT_THAT(error_of("wrap[wrap=1]x"), HasSubstr("nothing may follow the bracket"));
    EXPECT_THAT(error_of("wrap[wrap]"), HasSubstr("write name=value"));
    EXPECT_THAT(error_of("wrap[scater_width=1]"), HasSubstr("did you mean 'scatter_width'?"));
    EXPECT_THAT(error_of("wrap[wrap=3]"), HasSubstr("'3' is not in its range, 0 to 1"));
    EXPECT_THAT(error_of("wrap[preset=cheep]"), HasSubstr("unknown preset 'cheep'"));
    EXPECT_THAT(error_of("wrap,wrap[preset=default]"), HasSubstr("have the same settings"));
    EXPECT_THAT(error_of("wrap,wrap"), HasSubstr("have the same settings"));
    EXPECT_THAT(error_of("wrap,wrap[wrap=0.25]"), HasSubstr("have the same settings"));
}

TEST(TechniqueList, one_technique_is_not_a_list) {
    const auto one = parse_technique(built_in_catalog().techniques, "wrap[wrap=0.4]");
    ASSERT_TRUE(one) << one.error().message;
    EXPECT_EQ(one->name(), "wrap[wrap=0.4]");
    EXPECT_THAT(parse_technique(built_in_catalog().techniques, "wrap,lambert").error().message,
                HasSubstr("'wrap,lambert': name one technique"));
}

TEST(TechniqueList, refused_settings_name_what_to_change) {
    std::vector<Technique> techniques = {*parse_technique(built_in_catalog().techniques, "wrap")->technique};
    techniques[0].refusal = [](const ParameterValues& values) {
        return values.get(*values.table().find("wrap"))[0] > 0.5 ? "too wide; set wrap=0.5" : "";
    };
    EXPECT_TRUE(parse_technique_list(techniques, "wrap[wrap=0.5]"));
    EXPECT_EQ(parse_technique_list(techniques, "wrap[wrap=0.6]").error().message,
              "wrap: too wide; set wrap=0.5");
}

TEST(TechniqueList, by_default_all_techniques_run_and_lambert_first) {
    const std::vector<Contestant> all = default_contestants(built_in_catalog().techniques);
    EXPECT_EQ(all.size(), built_in_catalog().techniques.size());
    EXPECT_EQ(all.front().technique->id, "lambert");
}
