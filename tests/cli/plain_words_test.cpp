// Pages and messages use the terms of docs/terminology.md, and none of these metaphors and vague words.

#include <gtest/gtest.h>

#include "cli/docs_pages.h"

using namespace dermis::docs;

namespace {

struct Avoided {
    const char* pattern;
    const char* write;
};

constexpr Avoided kAvoided[] = {
    {"surroundings?", "environment"},
    {"hollows?", "concave, cavity"},
    {"(tinted|translucent) sheets?", "translucent surface"},
    {"light through (an? )?(ears?|thin)", "transmission"},
    {"stands? for", "is, means, replaces"},
    {"anew", "again"},
    {"somebody", "the user, or the name of the program"},
    {"complain(s|ed)?", "report an error"},
    {"(makes?|made) light", "does not conserve energy"},
    {"light bleeds?", "light scatters"},
    {"in the wrong place", "at a wrong distance, or which place"},
    {"as (it|they) (is|are) told", "as set"},
};

// The first word of the text that is to be avoided, with its replacement; empty when there is none.
std::string wrong_word(const std::string& text) {
    for (const Avoided& avoided : kAvoided) {
        const std::regex word("\\b" + std::string(avoided.pattern) + "\\b", std::regex::icase);
        std::smatch match;
        if (std::regex_search(text, match, word)) return "'" + match[0].str() + "': write " + avoided.write;
    }
    return {};
}

// The text between quotation marks, adjacent literals joined.
std::vector<std::string> literals_of(const std::string& source) {
    static const std::regex gap("\"\\s*\\n\\s*\""), literal("\"((?:[^\"\\\\\\n]|\\\\.)*)\"");
    return matches(std::regex_replace(source, gap, ""), literal, 1);
}

std::vector<fs::path> program_sources() {
    std::vector<fs::path> found;
    for (const char* tree : {"apps", "catalog", "dermis", "subjects", "techniques"})
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / tree)) {
            const std::string name = entry.path().filename().string();
            if ((name.ends_with(".cpp") || name.ends_with(".h")) && !name.ends_with("_test.cpp"))
                found.push_back(entry.path());
        }
    return found;
}

}  // namespace

TEST(Docs, pages_use_the_terms_of_the_field) {
    for (const fs::path& page : pages()) EXPECT_EQ(wrong_word(read(page)), "") << page;
}

TEST(Docs, messages_help_and_labels_use_the_terms_of_the_field) {
    size_t literals = 0;
    for (const fs::path& source : program_sources())
        for (const std::string& text : literals_of(read(source))) {
            if (text.find(' ') != std::string::npos)
                EXPECT_EQ(wrong_word(text), "") << source << ": " << text;
            ++literals;
        }
    EXPECT_GT(literals, 3000u);
}

TEST(Docs, a_word_to_avoid_is_found_and_its_replacement_named) {
    EXPECT_EQ(wrong_word("visibility of the surroundings; red channel"), "'surroundings': write environment");
    EXPECT_EQ(wrong_word("two translucent sheets"), "'translucent sheets': write translucent surface");
    EXPECT_EQ(wrong_word("a picture of the environment"), "");
    EXPECT_EQ(literals_of("f(\"the surr\"\n  \"oundings\", \"b\");"),
              (std::vector<std::string>{"the surroundings", "b"}));
}
