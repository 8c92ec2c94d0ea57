// Random actions, seeded: under the validation layers no message, and no memory that grows. 40 of them as a
// test; for hours: DERMIS_SOAK_ACTIONS=20000 build/tests/test_view --gtest_filter='*random_actions*'. Under
// the layers, then without them; DERMIS_SOAK_LAYERS=0 runs only the second.

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "support/built_in.h"
#include "support/moving_sheet.h"
#include "view/window_fixture.h"

namespace dermis {
namespace {

class RandomActions {
  public:
    explicit RandomActions(uint32_t seed) : random_(seed) {}

    std::string next() {
        switch (number(0, 11)) {
            case 0:
                return "technique " + one_of(techniques_);
            case 1:
                return "view " + one_of({"final", "diffuse", "specular", "normal", "albedo", "curvature"});
            case 2:
                return "tone " + text(0, 6);
            case 3:
                return "resize " + text(120, 500) + " " + text(90, 400);
            case 4:
                return "scroll " + text(0, 400) + " " + text(0, 300) + " " + text(-3, 3);
            case 5:
            case 6:
                return "drag " + one_of({"left", "middle", "right"}) + " " + text(0, 400) + " " +
                       text(0, 300) + " " + text(0, 400) + " " + text(0, 300) +
                       one_of({"", " ctrl", " shift"});
            case 7:
                return "open " +
                       one_of({"builtin:spheres", "DIR/square.obj", "DIR/sheet.gltf", "no_such_scene"});
            case 8:
                return "wait " + text(1, 3);
            case 9:  // a script ends at a clip or target that the scene lacks
                return "open DIR/sheet.gltf\nclip nod\ntime 0." + text(0, 9) + "\n" +
                       one_of({"play", "pause", "clip \"\""}) + "\nmorph lift 0." + text(0, 9) + "\nwait 2";
            case 10:
                return one_of({"undo", "redo"});
            default:
                return "key " + one_of({"F1", "tab", "F", "T", "shift+T", "V", "shift+V", "0", "R", "]", "[",
                                        "C", "X", "ctrl+C", "ctrl+V", "Y", "escape", "ctrl+=", "ctrl+-"});
        }
    }

  private:
    int number(int low, int high) { return int(random_() % uint32_t(high - low + 1)) + low; }
    std::string text(int low, int high) { return std::to_string(number(low, high)); }
    std::string one_of(const std::vector<std::string>& words) { return words[random_() % words.size()]; }

    static std::vector<std::string> technique_names() {
        std::vector<std::string> names;
        for (const Technique& technique : built_in_catalog().techniques) names.push_back(technique.id);
        return names;
    }
    std::mt19937 random_;  // the same numbers on every machine
    std::vector<std::string> techniques_ = technique_names();
};

// Memory is compared in one state, which holds the same scene and images. The comparison, the interface's
// scale and the pipelines (up to their limit) stay as the actions left them.
const std::string kSameState =
    "open DIR/square.obj\ntone 0\ntechnique lambert\nview final\nresize 300 200\nwait 9\nsettle\nprint\n";

std::string random_script(uint32_t seed, int actions, bool prints) {
    RandomActions random(seed);
    std::string script;
    for (int i = 0; i < actions; ++i) {
        if (prints && i >= actions / 2 && i % std::max(1, actions / 10) == 0) script += kSameState;
        script += random.next() + "\n";
    }
    return script + kSameState + "quit\n";
}

std::vector<double> values_of(const std::string& printed, const std::string& key) {
    std::vector<double> values;
    for (const std::string_view line : split(printed, '\n'))
        if (line.starts_with(key + " "))
            values.push_back(std::stod(std::string(line.substr(key.size() + 1))));
    return values;
}

}  // namespace

TEST_F(ViewWindow, random_actions_bring_no_message_and_keep_no_memory) {
    const char* stated = std::getenv("DERMIS_SOAK_ACTIONS");
    const char* chosen = std::getenv("DERMIS_SOAK_SEED");
    const int actions = stated ? std::atoi(stated) : 40;
    const auto seed = uint32_t(chosen ? std::atoi(chosen) : 1);
    ASSERT_GT(actions, 0);
    ASSERT_TRUE(write_text_file(path("sheet.gltf"), test::moving_sheet()));
    const std::string arguments = square() + " --size 300x200 --samples 1 -t lambert";
    const char* layers = std::getenv("DERMIS_SOAK_LAYERS");
    if (!layers || std::string_view(layers) != "0") {
        const ProgramResult checked = view(arguments, random_script(seed, actions, false));
        EXPECT_EQ(checked.exit_code, 0) << "seed " << seed << ": " << checked.err;
        EXPECT_EQ(checked.err, "");  // with what the layers say of the device's destruction
    }
    if (!stated) return;
    // The layers keep memory of their own.
    const ProgramResult plain = view(arguments, random_script(seed, actions, true), "");
    ASSERT_EQ(plain.exit_code, 0) << plain.err;
    const std::vector<double> memory_mb = values_of(plain.out, "memory_mb");
    ASSERT_GE(memory_mb.size(), 4u);
    const auto half = memory_mb.begin() + std::ptrdiff_t(memory_mb.size() / 2);
    const double middle_mb = *std::max_element(memory_mb.begin(), half);
    const double end_mb = *std::max_element(half, memory_mb.end());
    std::printf("%d actions: %.0f MB after half of them, %.0f MB at the end\n", actions, middle_mb, end_mb);
    // A view in the window has some 10 pipelines beside the 48 that are kept.
    EXPECT_LT(std::ranges::max(values_of(plain.out, "pipelines")), 60);
    EXPECT_LT(end_mb, 1.1 * middle_mb + 16);
}

}  // namespace dermis
