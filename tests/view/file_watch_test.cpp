#include "dermis/view/file_watch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dermis/base/file.h"
#include "support/temporary_directory.h"

namespace dermis::view {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class FileWatchTest : public ::testing::Test {
  protected:
    std::filesystem::path write(const std::string& name, const std::string& text) {
        EXPECT_TRUE(write_text_file(directory_.path / name, text));
        return directory_.path / name;
    }
    TemporaryDirectory directory_;
    FileWatch watch_;
};

TEST_F(FileWatchTest, reports_each_changed_new_and_removed_file_once) {
    const auto a = write("a", "1"), missing = directory_.path / "b";
    watch_.watch({a, missing});
    EXPECT_THAT(watch_.changed(), IsEmpty());
    write("a", "22");
    EXPECT_THAT(watch_.changed(), ElementsAre(a));
    EXPECT_THAT(watch_.changed(), IsEmpty());
    write("b", "1");
    EXPECT_THAT(watch_.changed(), ElementsAre(missing));
    std::filesystem::remove(a);
    EXPECT_THAT(watch_.changed(), ElementsAre(a));
}

TEST_F(FileWatchTest, a_change_before_the_list_is_made_again_is_not_lost) {
    const auto a = write("a", "1"), b = write("b", "1");
    watch_.watch({a});
    write("a", "22");
    watch_.watch({a, b});
    EXPECT_THAT(watch_.changed(), ElementsAre(a));
    watch_.add({directory_.path / "c"});
    write("c", "1");
    EXPECT_THAT(watch_.changed(), ElementsAre(directory_.path / "c"));
}

}  // namespace
}  // namespace dermis::view
