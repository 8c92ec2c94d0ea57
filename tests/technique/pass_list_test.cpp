#include "dermis/technique/pass_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace dermis;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

Pass fullscreen(std::string name, std::vector<ImageRead> reads, std::string target) {
    return {.name = std::move(name),
            .shader = "test/a.frag",
            .reads = std::move(reads),
            .colors = {{std::move(target)}}};
}

PassList ping_pong() {
    return {.images = {{.name = "a"}, {.name = "b"}},
            .passes = {fullscreen("first", {"input"}, "a"), fullscreen("second", {"a"}, "b")}};
}

}  // namespace

TEST(PassList, a_sound_list_has_no_problems) {
    EXPECT_THAT(problems(ping_pong(), {"input"}), IsEmpty());
}

TEST(PassList, an_input_that_nothing_supplies_is_found) {
    EXPECT_THAT(problems(ping_pong(), {}), ElementsAre("pass 'first' reads 'input', which nothing supplies"));
}

TEST(PassList, reading_before_writing_is_found) {
    PassList list = ping_pong();
    std::swap(list.passes[0], list.passes[1]);
    EXPECT_THAT(problems(list, {"input"}), ElementsAre("pass 'second' reads 'a' before anything wrote it"));
    list.images[0].persistent = true;
    EXPECT_THAT(problems(list, {"input"}), IsEmpty());
}

TEST(PassList, a_pass_that_reads_its_own_target_is_found) {
    PassList list = ping_pong();
    list.passes[1] = fullscreen("second", {"a"}, "a");
    EXPECT_THAT(problems(list, {"input"}), ElementsAre("pass 'second' reads and writes 'a'"));
}

TEST(PassList, loading_what_was_never_written_is_found) {
    PassList list = ping_pong();
    list.passes[0].colors[0].load = LoadOp::load;
    EXPECT_THAT(problems(list, {"input"}), ElementsAre("pass 'first' loads 'a' before anything wrote it"));
}

TEST(PassList, targets_must_agree_in_size_and_samples) {
    PassList list = ping_pong();
    list.images[1].size = {64, 64};
    list.images[1].samples = 4;
    list.passes[0].colors.push_back({"b"});
    EXPECT_THAT(problems(list, {"input"}),
                ElementsAre("pass 'first' has targets of different sizes",
                            "pass 'first' has targets of different sample counts"));
}

TEST(PassList, double_names_and_empty_passes_are_found) {
    PassList list = ping_pong();
    list.images.push_back({.name = "a", .samples = 3});
    list.passes.push_back({.name = "second", .kind = PassKind::compute});
    EXPECT_THAT(problems(list, {"input"}),
                ElementsAre("image 'a' is declared twice", "image 'a' has 3 samples; 1 or 4",
                            "pass 'second' stands twice", "pass 'second' has no shader",
                            "pass 'second' writes nothing"));
}

TEST(PassList, its_description_names_every_image_and_pass) {
    const std::string text = describe(ping_pong());
    EXPECT_THAT(text, HasSubstr("image a  rgba16f  frame\n"));
    EXPECT_THAT(text, HasSubstr("pass second  [fullscreen]  test/a.frag  reads a  writes b\n"));
}
