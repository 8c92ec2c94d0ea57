// Lines of jobs: what is in them, that they do nothing when their result is there, and what runs them.

#include "dermis/jobs/job_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <random>

#include "dermis/base/file.h"
#include "dermis/jobs/local_runner.h"
#include "dermis/jobs/slurm_runner.h"
#include "support/temporary_directory.h"

using namespace dermis;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace {

namespace fs = std::filesystem;

std::vector<std::string> words(const std::string& line) {
    const Result<std::vector<std::string>> split = shell_words(line);
    return split ? *split : std::vector<std::string>{"error: " + split.error().message};
}

// A program that is called like dermis: `program FILE TEXT` writes TEXT at the end of FILE.
struct Workshop {
    TemporaryDirectory directory;
    std::string folder = (directory.path / "jobs").string(),
                program = (directory.path / "append it").string();

    Workshop() {
        std::ofstream(program) << "#!/bin/sh\n[ \"$1\" = merge ] && exit\necho \"$2\" >> \"$1\"\n";
        fs::permissions(program, fs::perms::owner_all);
    }
    [[nodiscard]] Job job(const std::string& name) const {
        const std::string file = (directory.path / name).string();
        return {.name = name, .hash = "hash of " + name, .words = {file, "a 'word'"}, .results = {file}};
    }
    [[nodiscard]] std::string content(const std::string& name) const {
        const Result<std::string> text = read_text_file(directory.path / name);
        return text ? *text : "";
    }
    [[nodiscard]] LocalRun local(int workers = 2) const {
        return {.workers = workers, .logs = folder + "/logs"};
    }
};

int shell(const std::string& line) {
    return std::system(line.c_str());
}

}  // namespace

TEST(ShellWords, are_split_as_a_shell_does) {
    EXPECT_THAT(words("a  b\tc\r"), ElementsAre("a", "b", "c"));
    EXPECT_THAT(words("--light 'yaw_deg=1 pitch_deg=2' \"x y\"z '' \\  # comment"),
                ElementsAre("--light", "yaw_deg=1 pitch_deg=2", "x yz", "", " "));
    EXPECT_THAT(words("# all of it"), IsEmpty());
    EXPECT_THAT(words("a#b"), ElementsAre("a#b"));
    EXPECT_THAT(words("'it'\\''s' '$HOME'"), ElementsAre("it's", "$HOME"));
    for (const char* wrong : {"a; b", "a | b", "a > b", "$HOME", "`a`", "\"$a\"", "a & b", "'open", "\"open"})
        EXPECT_THAT(words(wrong)[0], HasSubstr("error: ")) << wrong;
}

TEST(ShellWords, quoted_words_come_back) {
    std::mt19937 random(2);
    for (int run = 0; run < 200; ++run) {
        std::string word;
        for (int i = 0; i < run % 9; ++i) word += " a'\"\\$;#\t%=~*"[random() % 13];
        EXPECT_THAT(words("x " + shell_word(word) + " y"), ElementsAre("x", word, "y")) << word;
    }
    EXPECT_EQ(shell_word("out/a_1.exr"), "out/a_1.exr");
}

TEST(ShellWords, options_can_be_left_out) {
    const std::vector<std::string> line =
        words("reference a -o x.exr --output=y -oz.exr --json --outputs b --output c -q");
    constexpr std::string_view kOptions[] = {"-o", "--output"}, kFlags[] = {"--json"};
    EXPECT_THAT(words_without(line, kOptions, kFlags), ElementsAre("reference", "a", "--outputs", "b", "-q"));
}

TEST(JobLines, do_nothing_when_their_result_is_there) {
    Workshop shop;
    const JobPlan plan{.work = {shop.job("one"), shop.job("two")}};
    const JobLists lists = job_lists({&plan, 1}, shop.program, shop.folder);
    ASSERT_TRUE(write_job_lists(lists, shop.folder));
    for (int again = 0; again < 2; ++again) EXPECT_EQ(shell("sh " + shop.folder + "/work.txt"), 0);
    EXPECT_EQ(shop.content("one"), "a 'word'\n");
    EXPECT_TRUE(lists.work[0].is_done());
    // A result without its mark is of other content; a mark without its result is of one that was removed.
    fs::remove(fs::path(shop.folder) / "done/hash of one");
    fs::remove(shop.directory.path / "two");
    EXPECT_FALSE(lists.work[0].is_done());
    EXPECT_FALSE(lists.work[1].is_done());
    EXPECT_EQ(shell("sh " + shop.folder + "/work.txt"), 0);
    EXPECT_EQ(shop.content("one"), "a 'word'\na 'word'\n");
    EXPECT_EQ(shop.content("two"), "a 'word'\n");
}

TEST(JobLines, what_was_emptied_cut_or_changed_is_not_done) {
    Workshop shop;
    const JobPlan plan{.work = {shop.job("one")}};
    const JobLists lists = job_lists({&plan, 1}, shop.program, shop.folder);
    ASSERT_TRUE(write_job_lists(lists, shop.folder));
    const std::string run = "sh " + shop.folder + "/work.txt";
    for (const char* damage : {": > ", "printf x > ", "printf x >> ", "rm "}) {
        EXPECT_EQ(shell(run), 0);
        EXPECT_TRUE(lists.work[0].is_done());
        EXPECT_EQ(shell(damage + (shop.directory.path / "one").string()), 0);
        EXPECT_FALSE(lists.work[0].is_done()) << damage;
    }
    // An empty mark beside a result that is missing.
    EXPECT_EQ(shell(": > '" + shop.folder + "/done/hash of one'"), 0);
    EXPECT_FALSE(lists.work[0].is_done());
}

TEST(JobLines, a_program_that_writes_nothing_has_done_nothing) {
    Workshop shop;
    JobPlan plan{.work = {shop.job("part")}, .merge = shop.job("picture")};
    plan.work[0].is_part = true;
    const JobLists lists = job_lists({&plan, 1}, "/bin/true", shop.folder);
    ASSERT_TRUE(write_job_lists(lists, shop.folder));
    for (const char* name : {"/work.txt", "/merge.txt"}) EXPECT_NE(shell("sh " + shop.folder + name), 0);
    EXPECT_FALSE(lists.work[0].is_done());
    EXPECT_FALSE(lists.merges[0].is_done());
}

TEST(JobLines, parts_of_a_picture_that_is_there_are_done) {
    Workshop shop;
    JobPlan plan{.work = {shop.job("part")}, .merge = shop.job("picture")};
    plan.work[0].is_part = true;
    const JobLists lists = job_lists({&plan, 1}, shop.program, shop.folder);
    ASSERT_TRUE(write_job_lists(lists, shop.folder));
    EXPECT_EQ(shell("sh " + shop.folder + "/work.txt && sh " + shop.folder + "/merge.txt"), 0);
    EXPECT_NE(shop.content("part"), "");
    fs::remove(shop.directory.path / "part");
    EXPECT_TRUE(lists.work[0].is_done());
    EXPECT_EQ(shell("sh " + shop.folder + "/work.txt"), 0);
    EXPECT_EQ(shop.content("part"), "");
}

TEST(LocalRuns, repeat_what_was_killed_and_nothing_else) {
    // Line i ends itself by a signal as often as drawn: up to twice, then it is done; three times is too
    // often.
    Workshop shop;
    ASSERT_TRUE(write_job_lists({}, shop.folder));
    std::mt19937 random(20);
    std::vector<JobLine> lines;
    std::vector<int> kills;
    for (int i = 0; i < 12; ++i) {
        kills.push_back(i == 5 ? 3 : int(random() % 3));
        const std::string runs = (shop.directory.path / std::to_string(i)).string();
        lines.push_back({.name = "line " + std::to_string(i),
                         .text = "echo run >> " + runs + "; [ $(wc -l < " + runs + ") -gt " +
                                 std::to_string(kills.back()) + " ] || kill -" + (i % 2 ? "KILL" : "TERM") +
                                 " $$"});
    }
    lines.push_back({.name = "wrong", .text = "echo first; echo what is wrong; exit 7"});
    double share = 0;
    LocalRun run = shop.local(3);
    run.progress = [&](double done) { share = done; };
    const LocalOutcome outcome = run_lines(lines, run);
    EXPECT_EQ(outcome.done, 11u);
    EXPECT_EQ(share, 1);
    size_t repeated = 0;
    for (int i = 0; i < 12; ++i) {
        const size_t runs = size_t(i == 5 ? 3 : kills[size_t(i)] + 1);
        EXPECT_EQ(shop.content(std::to_string(i)).size(), 4 * runs) << i;
        repeated += runs - 1;
    }
    EXPECT_EQ(outcome.repeated, repeated);
    EXPECT_GT(repeated, 4u);
    ASSERT_EQ(outcome.failures.size(), 2u);
    EXPECT_THAT(outcome.failures, testing::UnorderedElementsAre(HasSubstr("line 5: was killed 3 times"),
                                                                "wrong: what is wrong"));
}

TEST(LocalRuns, a_stop_ends_the_workers) {
    Workshop shop;
    ASSERT_TRUE(write_job_lists({}, shop.folder));
    std::atomic<bool> stop = false;
    const std::string late = (shop.directory.path / "late").string();
    const JobLine lines[] = {{.name = "quick", .text = "true"},
                             {.name = "slow", .text = "sleep 30; : > " + late}};
    LocalRun run = shop.local();
    run.stop = &stop;
    run.progress = [&](double) { stop = true; };
    const LocalOutcome outcome = run_lines(lines, run);
    EXPECT_TRUE(outcome.stopped);
    EXPECT_EQ(outcome.done, 1u);
    EXPECT_THAT(outcome.failures, IsEmpty());
    EXPECT_FALSE(fs::exists(late));
}

TEST(SlurmArrays, are_written_as_ranges) {
    EXPECT_EQ(array_text({1, 2, 3, 5, 8, 9}), "1-3,5,8-9");
    EXPECT_EQ(array_text({4}), "4");
}
