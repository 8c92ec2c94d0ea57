// ./run, tools/setup, tools/new_technique and tools/fresh_machine, with stubs for apt-get, cmake and the like
// that only print how they were called.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "cli/run_program.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace fs = std::filesystem;
using namespace dermis;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

namespace {

class Setup : public testing::Test {
  protected:
    void SetUp() override {
        fs::create_directories(path("bin"));
        fs::create_directories(path("root/tools"));
        for (const char* file : {"run", "tools/setup", "tools/new_technique"})
            fs::copy_file(fs::path(DERMIS_SOURCE_DIR) / file, path("root") / file);
        write("root/tools/apt.txt", "libone-dev  # for one\nlibtwo-dev\n");
        program("id", "echo 0");
        program("dpkg-query", "exit 1");  // nothing is installed
        program("apt-cache", "exit 0");   // the archive has everything
        program("apt-get",
                "case \"$*\" in *--print-uris*)\n"
                "echo \"'http://a/one.deb' one.deb 1500000 MD5\"; echo \"'http://a/two.deb' two.deb 2000000 "
                "MD5\";;\n"
                "*) echo \"CALLED apt-get $*\" >&2;; esac");
        program("sudo", "echo \"CALLED sudo\" >&2; exec \"$@\"");
    }
    fs::path path(const std::string& name) const { return directory_.path / name; }
    void write(const std::string& name, const std::string& text) {
        fs::create_directories(path(name).parent_path());
        std::ofstream(path(name)) << text;
    }
    void program(const std::string& name, const std::string& text) {
        write("bin/" + name, "#!/bin/bash\n" + text + "\n");
        fs::permissions(path("bin/" + name), fs::perms::owner_all);
    }
    ProgramResult shell(const std::string& command) {
        return run_shell("cd '" + path("root").string() + "' && PATH='" + path("bin").string() +
                             "':/usr/bin:/bin XDG_CACHE_HOME='" + path("cache").string() + "' TMPDIR='" +
                             directory_.path.string() + "' " + command,
                         directory_.path.string());
    }
    // Folders that fresh_machine made.
    size_t folders_left() const {
        size_t count = 0;
        for (const auto& entry : fs::directory_iterator(directory_.path))
            count += entry.path().filename().string().starts_with("dermis-fresh");
        return count;
    }

    TemporaryDirectory directory_;
};

const std::string kFreshMachine = DERMIS_SOURCE_DIR "/tools/fresh_machine";

}  // namespace

TEST_F(Setup, says_which_packages_and_how_many_megabytes_before_it_installs_and_nothing_afterwards) {
    const ProgramResult first = shell("bash -c 'source tools/setup'");
    ASSERT_EQ(first.exit_code, 0) << first.err;
    EXPECT_THAT(first.err, HasSubstr("dermis: installing with apt-get: libone-dev libtwo-dev\n"));
    EXPECT_THAT(first.err, Not(HasSubstr("sudo")));
    const size_t said = first.err.find("dermis: 2 packages, 4 MB to download\n"),
                 installed = first.err.find("CALLED apt-get install");
    ASSERT_NE(said, std::string::npos) << first.err;
    ASSERT_NE(installed, std::string::npos) << first.err;
    EXPECT_LT(said, installed);
    EXPECT_THAT(shell("bash -c 'source tools/setup'").err, IsEmpty());
}

TEST_F(Setup, of_alternatives_installs_the_first_that_the_release_has_and_none_if_that_is_one) {
    write("root/tools/apt.txt", "libold-dev | libnew-dev  # for one\nlibsnap-dev | -\nlibtwo-dev\n");
    program("apt-cache", "case $2 in libnew-dev | libtwo-dev) exit 0;; *) exit 100;; esac");
    const ProgramResult result = shell("bash -c 'source tools/setup'");
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_THAT(result.err, HasSubstr("dermis: installing with apt-get: libnew-dev libtwo-dev\n"));
}

TEST_F(Setup, an_alternative_that_is_installed_is_enough) {
    write("root/tools/apt.txt", "libold-dev | libnew-dev\n");
    program("dpkg-query", "[ \"${!#}\" = libnew-dev ] && echo 'install ok installed'");
    const ProgramResult result = shell("bash -c 'source tools/setup'");
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.err, IsEmpty());
}

TEST_F(Setup, a_package_that_the_release_does_not_have_is_named_with_its_list) {
    write("root/tools/apt_checks.txt", "# tests\nlibold-14-dev  # what tests link\n");
    write("root/tools/apt_python.txt", "");
    program("apt-cache", "[ \"$2\" != libold-14-dev ]");
    const ProgramResult result = shell("checks=1 bash -c 'source tools/setup; echo went on'");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.err,
                HasSubstr("dermis: this release has no package libold-14-dev; name the one that it "
                          "has in tools/apt_checks.txt\n"));
    EXPECT_THAT(result.err, Not(HasSubstr("CALLED apt-get install")));
    EXPECT_THAT(result.out, IsEmpty());
}

TEST_F(Setup, says_that_sudo_is_used) {
    program("id", "echo 1000");
    EXPECT_THAT(shell("bash -c 'source tools/setup'").err,
                HasSubstr("dermis: installing with sudo apt-get: libone-dev"));
}

TEST_F(Setup, stops_when_packages_cannot_be_installed_and_tries_again_the_next_time) {
    program("apt-get", "[ \"$1\" != install ]");
    for (int i = 0; i < 2; ++i) {
        const ProgramResult result = shell("bash -c 'source tools/setup; echo went on'");
        EXPECT_EQ(result.exit_code, 1);
        EXPECT_THAT(result.err, HasSubstr("dermis: apt-get install failed"));
        EXPECT_THAT(result.out, IsEmpty());
    }
}

TEST_F(Setup, ninja_lines_become_one_line_with_the_time_that_is_left) {
    shell("bash -c 'source tools/setup'");
    const ProgramResult result = shell(
        "bash -c 'source tools/setup; printf \"@@85 340 65.2 Building x\\nwarning: y\\nninja: no work to "
        "do.\\n\" | show_progress'");
    EXPECT_THAT(result.out, HasSubstr("step 85 of 340 after 1 min 5 s, about 3 min 15 s more"));
    EXPECT_THAT(result.out, HasSubstr("warning: y\n"));
    EXPECT_THAT(result.out, Not(HasSubstr("no work")));
}

TEST_F(Setup, run_builds_again_when_any_source_changed_and_not_otherwise) {
    shell("bash -c 'source tools/setup'");
    program("cmake", "echo \"CALLED cmake $*\" >&2");
    write("root/build/build.ninja", "");
    write("root/build/dermis", "#!/bin/bash\necho drawn\n");
    fs::permissions(path("root/build/dermis"), fs::perms::owner_all);
    write("root/dermis/base/a.cpp", "");
    const ProgramResult first = shell("./run x");
    EXPECT_THAT(first.err,
                HasSubstr("CALLED cmake --build " + path("root/build").string() + " --target dermis\n"));
    EXPECT_EQ(first.out, "drawn\n");
    EXPECT_THAT(shell("./run x").err, IsEmpty());
    const auto later = fs::file_time_type::clock::now() + std::chrono::seconds(5);
    write("root/docs/page.md", "");
    fs::last_write_time(path("root/docs/page.md"), later);
    EXPECT_THAT(shell("./run x").err, IsEmpty()) << "no part of the program";
    write("root/newfolder/b.cpp", "");
    fs::last_write_time(path("root/newfolder/b.cpp"), later);
    EXPECT_THAT(shell("./run x").err, HasSubstr("CALLED cmake --build"));
}

TEST_F(Setup, run_installs_and_builds_the_python_module_only_when_it_is_asked_for) {
    write("root/tools/apt_python.txt", "libsnake-dev  # for the module\n");
    program("cmake", "echo \"CALLED cmake $*\" >&2");
    write("root/build/build.ninja", "");
    write("root/build/dermis", "#!/bin/bash\necho drawn\n");
    fs::permissions(path("root/build/dermis"), fs::perms::owner_all);
    const ProgramResult drawn = shell("python=1 ./run x");
    EXPECT_EQ(drawn.out, "drawn\n");
    EXPECT_THAT(drawn.err, HasSubstr("--target dermis\n"));
    EXPECT_THAT(drawn.err, Not(HasSubstr("snake")));
    EXPECT_THAT(drawn.err, Not(HasSubstr("dermis_python")));

    const std::string command = "./run python -c 'import sys; print(sys.path[1], sys.argv[1:])' a 'b c'";
    const ProgramResult first = shell(command);
    EXPECT_THAT(first.err, HasSubstr("libone-dev libtwo-dev libsnake-dev\n"));
    EXPECT_THAT(first.err, HasSubstr("-DDERMIS_PYTHON=ON"));
    EXPECT_THAT(first.err, HasSubstr("--target dermis_python_package\n"));
    EXPECT_EQ(first.out, path("root/build/python").string() + " ['a', 'b c']\n");
    EXPECT_THAT(shell(command).err, IsEmpty());
}

TEST_F(Setup, fresh_machine_has_help_with_an_example_and_refuses_what_it_does_not_know) {
    const ProgramResult help = shell(kFreshMachine + " --help");
    EXPECT_EQ(help.exit_code, 0);
    EXPECT_THAT(help.out, HasSubstr("example: sudo tools/fresh_machine --suite trixie --configure"));
    EXPECT_THAT(help.out, Not(HasSubstr("set -euo")));
    EXPECT_EQ(shell(kFreshMachine + " --nonsense").exit_code, 2);
    EXPECT_EQ(shell(kFreshMachine + " --suite sarge").exit_code, 2);
    EXPECT_EQ(shell(kFreshMachine + " --suite").exit_code, 2);
    EXPECT_EQ(folders_left(), 0u);
}

TEST_F(Setup, fresh_machine_removes_its_folder_when_it_fails_and_when_it_is_ended) {
    for (const char* engine : {"podman", "docker"}) program(engine, "exit 1");
    program("debootstrap", "exit 1");
    program("unshare", "exit 1");
    program("setpriv", "echo no base >&2; exit 1");  // what debootstrap is started through
    const ProgramResult failed = shell(kFreshMachine + " --configure");
    EXPECT_EQ(failed.exit_code, 1);
    EXPECT_THAT(failed.err, HasSubstr("works in " + directory_.path.string() + "/dermis-fresh."));
    EXPECT_THAT(failed.err, HasSubstr("debootstrap failed"));
    EXPECT_EQ(folders_left(), 0u);

    program("setpriv", "touch '" + path("started").string() + "'; exec sleep 60");
    const ProgramResult ended =
        shell("bash -c '" + kFreshMachine +
              " --configure & for i in {1..100}; do [ -e ../started ] && break; sleep 0.1; done; "
              "kill -TERM $!; wait $!'");
    EXPECT_EQ(ended.exit_code, 143) << ended.err;
    EXPECT_EQ(folders_left(), 0u);
}

TEST_F(Setup, fresh_machine_makes_the_release_that_it_is_told_from_this_machines_archive) {
    for (const char* engine : {"podman", "docker"}) program(engine, "exit 1");
    program("debootstrap", "exit 1");
    program("unshare", "exit 1");
    const std::string own = "$(. /etc/os-release; echo $VERSION_CODENAME)",
                      id = "$(. /etc/os-release; echo $ID)";
    program("apt-get", "[ $1 != indextargets ] || echo \"" + id + " http://archive/ " + own + " main\"");
    program("setpriv", "echo \"$*\" >'" + path("called").string() + "'; exit 1");
    EXPECT_EQ(shell(kFreshMachine + " --suite forky --configure").exit_code, 1);
    EXPECT_THAT(slurp(path("called")), HasSubstr(" forky "));
    EXPECT_THAT(slurp(path("called")), HasSubstr("/base http://archive/"));
}

// The tests that it runs to record exist in the repository, of all kinds (goldens, scores and costs).
TEST_F(Setup, new_technique_has_the_tests_record_its_pictures_and_scores) {
    write("root/tools/apt_checks.txt", "");
    write("root/tools/apt_python.txt", "");
    program("cmake", "exit 0");
    const auto test_program = [&](const std::string& name, const std::string& text) {
        write("root/build/tests/" + name, "#!/bin/bash\necho \"CALLED " + name + " $*\"\n" + text + "\n");
        fs::permissions(path("root/build/tests/" + name), fs::perms::owner_all);
    };
    test_program("test_render",
                 "[ \"$DERMIS_UPDATE_GOLDENS\" = missing ] || exit 0\ncd ../techniques\n"
                 "for id in *; do for of in spheres bust; do\n"
                 "echo x > ../tests/golden/${of}_$id.png; done; done");
    test_program("test_judge",
                 "[ \"$DERMIS_UPDATE_SCORES\" = missing ] || exit 0\n"
                 "echo spheres,my_skin,,0 >> ../tests/judge/recorded_scores.csv");
    test_program("test_report", "[ \"$DERMIS_UPDATE_COSTS\" = missing ]");
    fs::create_directories(path("root/tests/golden"));
    write("root/tests/judge/recorded_scores.csv", "scene,technique,settings,captured\n");

    const ProgramResult made = shell("tools/new_technique my_skin 'a test'");
    EXPECT_EQ(made.exit_code, 0) << made.err;
    const auto has_test = [](const std::string& file, const std::string& wanted) {
        return std::regex_search(slurp(DERMIS_SOURCE_DIR "/tests/" + file), std::regex(wanted));
    };
    EXPECT_THAT(made.out,
                HasSubstr("test_render --gtest_brief=1 --gtest_filter=Goldens.*_with_every_technique\n"));
    EXPECT_TRUE(
        has_test("render/golden_test.cpp", R"(TEST_F\(Goldens, of_the_spheres_with_every_technique\))"));
    EXPECT_TRUE(has_test("render/golden_test.cpp", R"(TEST_F\(Goldens, of_the_bust_with_every_technique\))"));
    EXPECT_THAT(made.out, HasSubstr("test_judge --gtest_brief=1 --gtest_filter=Scoreboards.*\n"));
    EXPECT_TRUE(has_test("judge/scoreboard_test.cpp", R"(TEST_F\(Scoreboards, \w+\))"));
    EXPECT_THAT(made.out, HasSubstr("test_report --gtest_brief=1 --gtest_filter=RecordedCosts.*\n"));
    EXPECT_TRUE(has_test("report/recorded_test.cpp", R"(TEST_F\(RecordedCosts, \w+\))"));

    test_program("test_judge", "");
    const ProgramResult no_scores = shell("tools/new_technique second_skin x");
    EXPECT_EQ(no_scores.exit_code, 1);
    EXPECT_THAT(no_scores.err, HasSubstr("recorded_scores.csv has no row of second_skin"));
    test_program("test_render", "");
    const ProgramResult no_goldens = shell("tools/new_technique third_skin x");
    EXPECT_EQ(no_goldens.exit_code, 1);
    EXPECT_THAT(no_goldens.err, HasSubstr("spheres_third_skin.png was not recorded"));
}
