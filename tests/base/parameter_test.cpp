#include "dermis/base/parameter.h"

#include <gtest/gtest.h>

using namespace dermis;

namespace {

enum class Filter : int32_t { poisson, box };

struct Params {
    float width_mm = 1.5f;
    int32_t passes = 2;
    bool dilate = true;
    Filter filter = Filter::box;
    Vec3 tint_linear = {1, 0.5f, 0.25f};
};

const ParameterTable& table() {
    static const ParameterTable kTable =
        ParameterTableBuilder<Params>()
            .number(&Params::width_mm, "width_mm", "mm", 0, 10, "width of the blur")
            .integer(&Params::passes, "passes", "", 1, 8, "how often")
            .toggle(&Params::dilate, "dilate", "grow charts")
            .choice(&Params::filter, "filter", {"poisson", "box"}, "kernel")
            .color(&Params::tint_linear, "tint_linear", 0, 1, "tint")
            .preset("cheap", "one pass", {.width_mm = 2, .passes = 1})
            .build();
    return kTable;
}

std::string set_error(const char* name, const char* text) {
    ParameterValues values(table());
    const Result<void> set = values.set(name, text);
    return set ? "" : set.error().message;
}

}  // namespace

TEST(Parameters, defaults_are_those_of_the_struct) {
    const ParameterValues values(table());
    EXPECT_EQ(values.text(*table().find("width_mm")), "1.5");
    EXPECT_EQ(values.text(*table().find("passes")), "2");
    EXPECT_EQ(values.text(*table().find("dilate")), "on");
    EXPECT_EQ(values.text(*table().find("filter")), "box");
    EXPECT_EQ(values.text(*table().find("tint_linear")), "1,0.5,0.25");
}

TEST(Parameters, setting_by_name_reaches_the_member) {
    ParameterValues values(table());
    ASSERT_TRUE(values.set("width_mm", "2.25"));
    ASSERT_TRUE(values.set("passes", "5"));
    ASSERT_TRUE(values.set("dilate", "off"));
    ASSERT_TRUE(values.set("filter", "poisson"));
    ASSERT_TRUE(values.set("tint_linear", "0.1 0.2 0.3"));
    const Params params = values.as<Params>();
    EXPECT_EQ(params.width_mm, 2.25f);
    EXPECT_EQ(params.passes, 5);
    EXPECT_FALSE(params.dilate);
    EXPECT_EQ(params.filter, Filter::poisson);
    EXPECT_EQ(params.tint_linear, (Vec3{0.1f, 0.2f, 0.3f}));
}

TEST(Parameters, text_round_trips_for_every_kind) {
    ParameterValues values(table()), copy(table());
    ASSERT_TRUE(values.set("width_mm", "0.1"));
    ASSERT_TRUE(values.set("tint_linear", "0.7"));
    for (const Parameter& parameter : table().parameters) {
        ASSERT_TRUE(copy.set(parameter.name, values.text(parameter)));
        EXPECT_EQ(copy.get(parameter), values.get(parameter)) << parameter.name;
    }
}

TEST(Parameters, wrong_values_are_named_with_what_would_be_right) {
    EXPECT_EQ(set_error("kernel", "1"),
              "unknown parameter 'kernel'; known: preset, width_mm, passes, dilate, filter, tint_linear");
    EXPECT_EQ(set_error("width_m", "1"),
              "unknown parameter 'width_m'; did you mean 'width_mm'? known: preset, width_mm, passes, "
              "dilate, filter, "
              "tint_linear");
    EXPECT_EQ(set_error("width_mm", "11"), "parameter 'width_mm': '11' is not in its range, 0 to 10 mm");
    EXPECT_EQ(set_error("width_mm", "nan"), "parameter 'width_mm': 'nan' is not in its range, 0 to 10 mm");
    EXPECT_EQ(set_error("width_mm", "wide"), "parameter 'width_mm': 'wide' is not a number (0 to 10 mm)");
    EXPECT_EQ(set_error("passes", "1.5"), "parameter 'passes': '1.5' is not a whole number");
    EXPECT_EQ(set_error("filter", "gauss"), "unknown value for 'filter': 'gauss'; known: poisson, box");
    EXPECT_EQ(set_error("tint_linear", "1,2"),
              "parameter 'tint_linear': '2' is not in its range, 0 to 1 linear");
    EXPECT_EQ(set_error("preset", "cheep"),
              "unknown preset 'cheep'; did you mean 'cheap'? known: default, cheap");
    const std::vector<std::string> no_value = {"passes"};
    EXPECT_EQ(ParameterValues(table()).set_all(no_value).error().message, "'passes': write name=value");
    EXPECT_EQ(set_error("tint_linear", "1,1"), "parameter 'tint_linear': '1,1' is not one number or three");
}

TEST(Parameters, a_preset_sets_all_and_later_settings_override_it) {
    ParameterValues values(table());
    EXPECT_EQ(values.preset()->name, "default");
    const std::vector<std::string> settings = {"filter=poisson", "preset=cheap", "width_mm = 3"};
    ASSERT_TRUE(values.set_all(settings));
    EXPECT_EQ(values.preset(), nullptr);
    ASSERT_TRUE(values.set("width_mm", "2"));
    EXPECT_EQ(values.preset()->name, "cheap");
    EXPECT_EQ(values.as<Params>().passes, 1);
    EXPECT_EQ(values.as<Params>().filter, Filter::box);
}

TEST(Parameters, of_a_file_have_no_order_so_that_its_preset_comes_first) {
    ParameterValues values(table());
    ASSERT_TRUE(
        values.set_all(std::map<std::string, std::string>{{"filter", "poisson"}, {"preset", "cheap"}}));
    EXPECT_EQ(values.as<Params>().filter, Filter::poisson);
    EXPECT_EQ(values.as<Params>().passes, 1);
}

namespace {

// A part that several techniques share, and a technique with another default for it.
struct Shared {
    int32_t size = 64;
    bool on = true;
};
struct Whole {
    float width_mm = 3;
    Shared shared = {.size = 32};
};

}  // namespace

TEST(Parameters, of_a_shared_part_reach_the_whole) {
    const ParameterTable rows = ParameterTableBuilder<Shared>()
                                    .integer(&Shared::size, "size", "texels", 1, 128, "side")
                                    .toggle(&Shared::on, "on", "whether at all")
                                    .build();
    const ParameterTable whole = ParameterTableBuilder<Whole>()
                                     .number(&Whole::width_mm, "width_mm", "mm", 0, 10, "width")
                                     .part(&Whole::shared, rows)
                                     .build();
    EXPECT_EQ(whole.find("size")->default_value[0], 32);
    ParameterValues values(whole);
    ASSERT_TRUE(values.set("size", "100"));
    ASSERT_TRUE(values.set("on", "off"));
    EXPECT_EQ(values.as<Whole>().shared.size, 100);
    EXPECT_FALSE(values.as<Whole>().shared.on);
    EXPECT_EQ(values.as<Whole>().width_mm, 3);
    EXPECT_FALSE(values.set("size", "129"));
}
