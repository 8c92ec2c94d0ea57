// Every number that a user may give, out of the tables that declare them: a new row is covered unasked. Both
// ends of its range are taken; just beyond them, what is not a number, nothing at all and text without end
// are refused by a line that names the row.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "dermis/base/text.h"
#include "dermis/scene/scene_keys.h"
#include "dermis/scene/scene_words.h"
#include "support/built_in.h"

using namespace dermis;

namespace {

const std::string kEndless(100000, '9');

std::vector<std::string> wrong_values(bool whole, double min, double max) {
    const double infinity = std::numeric_limits<double>::infinity();
    const double below = whole ? min - 1 : std::nextafter(min, -infinity),
                 above = whole ? max + 1 : std::nextafter(max, infinity);
    std::vector<std::string> values = {to_text(below), to_text(above), "nan", "-nan", "inf", "-inf", "",
                                       "1e400",        "99999e309",    "x"};
    values.push_back(kEndless);
    values.push_back("-" + kEndless);
    if (whole) values.push_back("0.5");
    return values;
}

std::string thrice(const std::string& value, KeyKind kind) {
    if (kind != KeyKind::vector && kind != KeyKind::color) return value;
    return "[" + value + ", " + value + ", " + value + "]";
}

std::string parse_error(const std::string& section, const std::string& line) {
    const std::string mesh = "[[mesh]]\nfile = \"builtin:spheres\"\n";
    const bool of_mesh = section == "[[mesh]]";
    const std::string text =
        section.empty() ? line + "\n" + mesh : mesh + (of_mesh ? "" : section + "\n") + line + "\n";
    const auto parsed = parse_scene(text, "s.toml", built_in_catalog().subjects);
    return parsed ? "" : parsed.error().message;
}

bool has_range(const KeyInfo& info) {
    return info.kind != KeyKind::toggle && info.kind != KeyKind::choice && info.kind != KeyKind::text &&
           info.kind != KeyKind::file;
}

// How many rows had a number.
template <class Target>
int check_table(const std::string& section, const KeyTable<Target>& table) {
    int count = 0;
    for (const Key<Target>& key : table.keys()) {
        const KeyInfo& info = key.info;
        SCOPED_TRACE(section + " " + info.name);
        const auto error = [&](const std::string& value) {
            return parse_error(section, info.name + " = " + value);
        };
        if (!has_range(info)) {
            (void)error('"' + kEndless + '"');  // whatever it says, it ends
            continue;
        }
        ++count;
        const bool whole = info.kind == KeyKind::integer;
        // What excludes other keys is refused too, by a line without the range.
        for (const double end : {info.min, info.max})
            EXPECT_EQ(error(thrice(to_text(end), info.kind)).find(" from " + to_text(info.min) + " to "),
                      std::string::npos)
                << to_text(end);
        for (const std::string& value : wrong_values(whole, info.min, info.max)) {
            const std::string message = error(thrice(value, info.kind));
            EXPECT_NE(message.find("s.toml:"), std::string::npos) << value.substr(0, 30) << " is taken";
            EXPECT_LT(message.size(), 1000u) << value.substr(0, 30);
        }
    }
    return count;
}

void check_parameters(const std::string& owner, const ParameterTable& table) {
    for (const Parameter& parameter : table.parameters) {
        SCOPED_TRACE(owner + " " + parameter.name);
        ParameterValues values(table);
        const auto error = [&](const std::string& value) {
            const Result<void> set = values.set(parameter.name, value);
            return set ? "" : printable_line(set.error().message);
        };
        const bool named = parameter.kind == ParameterKind::toggle || parameter.kind == ParameterKind::choice;
        for (const double end : {parameter.min, parameter.max})
            if (!named) EXPECT_EQ(error(to_text(end)), "") << to_text(end);
        const ParameterValues before = values;
        for (const std::string& value :
             wrong_values(parameter.kind == ParameterKind::integer, parameter.min, parameter.max)) {
            // A choice has no numbers beside its names; a toggle's are 0 and 1.
            EXPECT_NE(error(value).find("'" + parameter.name + "'"), std::string::npos)
                << value.substr(0, 30) << " is taken";
            EXPECT_EQ(values.text(parameter), before.text(parameter)) << "nothing changes after an error";
        }
    }
}

}  // namespace

TEST(NumberLimits, of_every_key_of_the_scene_file_hold) {
    const int numbers = check_table("", head_keys()) + check_table("[[mesh]]", mesh_keys()) +
                        check_table("[maps]", maps_keys()) + check_table("[material.m]", material_keys()) +
                        check_table("[skin]", skin_keys()) + check_table("[[light]]", light_keys()) +
                        check_table("[environment]", environment_keys()) +
                        check_table("[camera]", camera_keys());
    EXPECT_GT(numbers, 40) << "the tables are not what they were";
}

TEST(NumberLimits, of_every_parameter_of_techniques_and_subjects_hold) {
    for (const Technique& technique : built_in_catalog().techniques)
        check_parameters(technique.id, technique.parameters);
    for (const Subject& subject : built_in_catalog().subjects)
        check_parameters(subject.name, subject.parameters);
}

// The same keys as words of the command line: what is taken there is finite and within its range.
TEST(NumberLimits, of_every_key_that_changes_a_loaded_scene_hold) {
    const Result<Scene> loaded = load_built_in_scene("builtin:unit");
    ASSERT_TRUE(loaded) << loaded.error().message;
    for (const SceneKey& key : keys_of(*loaded)) {
        if (!has_range(*key.info)) continue;
        const std::string name = key.section == "light" ? "light.key." + key.info->name
                                 : key.section.empty()  ? key.info->name
                                                        : key.section + "." + key.info->name;
        const bool vector = key.info->kind == KeyKind::vector || key.info->kind == KeyKind::color;
        for (const std::string& value :
             wrong_values(key.info->kind == KeyKind::integer, key.info->min, key.info->max)) {
            Scene scene = without_objects(*loaded);
            const SceneWord word{name, vector ? value + "," + value + "," + value : value};
            const Result<void> set = set_words(scene, std::span(&word, 1));
            EXPECT_FALSE(set) << name << " takes " << value.substr(0, 30);
            EXPECT_EQ(words_of(scene), words_of(*loaded)) << name << ": nothing changes after an error";
        }
    }
}
