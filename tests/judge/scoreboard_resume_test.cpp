// tools/scoreboard's program, stopped in the middle: the next run goes on where it was.

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "dermis/base/file.h"
#include "dermis/gpu/statistics.h"
#include "dermis/judge/scoreboard.h"
#include "test_paths.h"

using namespace dermis;
using testing::HasSubstr;
using testing::Not;

namespace {

constexpr const char* kProgram = DERMIS_BINARY_DIR "/bench/scoreboard_bench";

class ScoreboardProgram : public testing::Test {
  protected:
    const std::filesystem::path directory_ =
        std::filesystem::temp_directory_path() / ("dermis_scoreboard_" + std::to_string(::getpid()));

    void SetUp() override { std::filesystem::create_directories(directory_); }
    void TearDown() override { std::filesystem::remove_all(directory_); }

    struct Run {
        std::string output;
        int status = 0;
    };

    /// The board of two scenes at the smallest size, with a cache of its own. A line that holds `stop_at`
    /// stops it by SIGTERM.
    [[nodiscard]] Run run(const std::string& stop_at = "", std::vector<std::string> words = {}) const {
        int ends[2];
        EXPECT_EQ(::pipe(ends), 0);
        const pid_t child = ::fork();
        if (child == 0) {
            ::dup2(ends[1], STDOUT_FILENO);
            ::close(ends[0]);
            ::setenv("DERMIS_CACHE", (directory_ / "cache").c_str(), 1);
            words.insert(words.begin(), {kProgram, directory_.string(), "16", "spheres", "backlit",
                                         "--techniques", "lambert,wrap"});
            std::vector<char*> arguments;
            for (std::string& word : words) arguments.push_back(word.data());
            arguments.push_back(nullptr);
            ::execv(kProgram, arguments.data());
            ::_exit(127);
        }
        ::close(ends[1]);
        Run result;
        FILE* lines = ::fdopen(ends[0], "r");
        char line[1024];
        while (std::fgets(line, sizeof line, lines)) {
            result.output += line;
            if (!stop_at.empty() && std::string_view(line).find(stop_at) != std::string_view::npos)
                ::kill(child, SIGTERM);
        }
        std::fclose(lines);
        ::waitpid(child, &result.status, 0);
        return result;
    }

    [[nodiscard]] size_t rows_of(const std::string& scene) const {
        const auto text = read_text_file(directory_ / "scoreboard.csv");
        if (!text) return 0;
        const auto rows = parse_scores(*text);
        EXPECT_TRUE(rows) << rows.error().message;
        return size_t(std::ranges::count(*rows, scene, &ScoreRow::scene));
    }
};

}  // namespace

TEST_F(ScoreboardProgram, goes_on_where_it_was_stopped) {
    if (!std::filesystem::exists(kProgram)) GTEST_SKIP() << "built without benchmarks";
    const Run first = run("1 of 2 scenes are left");
    EXPECT_TRUE(WIFSIGNALED(first.status)) << first.output;
    EXPECT_THAT(first.output, HasSubstr("spheres: reference walk of"));
    EXPECT_THAT(first.output, HasSubstr("1 of 2 scenes are left, about"));
    EXPECT_EQ(rows_of("spheres"), 2u);
    EXPECT_EQ(rows_of("backlit"), 0u);

    const Run second = run();
    EXPECT_EQ(second.status, 0);
    EXPECT_THAT(second.output, HasSubstr("spheres: was made before"));
    EXPECT_THAT(second.output, Not(HasSubstr("spheres: reference walk of")));
    EXPECT_THAT(second.output, HasSubstr("1 of 2 scenes are left\n")) << "the cache is no measure of time";
    EXPECT_THAT(second.output, HasSubstr("backlit: reference walk of"));
    EXPECT_EQ(rows_of("spheres"), 2u);
    EXPECT_EQ(rows_of("backlit"), 2u);

    const Run third = run();
    EXPECT_THAT(third.output, HasSubstr("backlit: was made before"));
}

TEST_F(ScoreboardProgram, fills_in_modelled_costs_and_keeps_the_shares) {
    if (!std::filesystem::exists(kProgram)) GTEST_SKIP() << "built without benchmarks";
    if (!gpu::null_driver_installed()) GTEST_SKIP() << "RADV is not installed";
    std::vector<ScoreRow> rows = {{.scene = "spheres", .technique = "lambert", .time_ratio = 1},
                                  {.scene = "spheres", .technique = "screen_space_burley", .time_ratio = 3},
                                  {.scene = "spheres", .technique = "exact"}};
    rows[1].surface.emplace().all.share = 0.25;
    ASSERT_TRUE(write_text_file(directory_ / "scoreboard.csv", scores_csv(rows)));
    const Run models = run("", {"--models"});
    EXPECT_EQ(models.status, 0) << models.output;
    const auto text = read_text_file(directory_ / "scoreboard.csv");
    ASSERT_TRUE(text);
    const auto now = parse_scores(*text);
    ASSERT_TRUE(now) << now.error().message;
    ASSERT_EQ(now->size(), 3u);
    EXPECT_EQ((*now)[0].model_ratio, 1);
    ASSERT_TRUE((*now)[1].model_ratio);
    EXPECT_GT(*(*now)[1].model_ratio, 1.01);
    EXPECT_LT(*(*now)[1].model_ratio, 3);
    EXPECT_EQ((*now)[1].surface->all.share, 0.25);
    EXPECT_EQ((*now)[1].time_ratio, 3);
    EXPECT_FALSE((*now)[2].model_ratio);
    const auto page = read_text_file(directory_ / "scoreboard.md");
    ASSERT_TRUE(page);
    EXPECT_THAT(*page, HasSubstr("(performance.md)"));
    EXPECT_THAT(*page, HasSubstr("| 1.00 | 1.00 |"));
}
