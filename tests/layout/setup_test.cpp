// ./run, tools/new_technique and tools/fresh_machine, with stubs for apt-get, cmake and the like that only
// print how they were called.

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

TEST_F(Setup, new_technique_builds_the_program_and_its_own_test_and_records_when_asked) {
    write("root/tools/apt_checks.txt", "");
    write("root/tools/apt_python.txt", "");
    program("cmake", "echo \"CALLED cmake $*\"");
    const auto test_program = [&](const std::string& name, const std::string& text) {
        write("root/build/tests/" + name, "#!/bin/bash\necho \"CALLED " + name + " $*\"\n" + text + "\n");
        fs::permissions(path("root/build/tests/" + name), fs::perms::owner_all);
    };
    test_program("test_technique_my_skin", "");
    const ProgramResult made = shell("tools/new_technique my_skin 'a test'");
    EXPECT_EQ(made.exit_code, 0) << made.err;
    EXPECT_THAT(made.out, HasSubstr("--target dermis test_technique_my_skin\n"));
    EXPECT_THAT(made.out, HasSubstr("CALLED test_technique_my_skin"));
    EXPECT_TRUE(fs::exists(path("root/techniques/my_skin/my_skin_test.cpp")));
    EXPECT_EQ(shell("tools/new_technique my_skin").exit_code, 1) << "it exists";

    fs::create_directories(path("root/tests/golden"));
    write("root/tests/judge/recorded_scores.csv", "scene,technique,settings,captured\n");
    const auto record = [&] { return shell("tools/new_technique --record my_skin"); };
    test_program("test_render", "");
    test_program("test_judge", "");
    test_program("test_report", "[ \"$DERMIS_UPDATE_COSTS\" = missing ]");
    EXPECT_THAT(record().err, HasSubstr("spheres_my_skin.png was not recorded"));
    test_program("test_render",
                 "[ \"$DERMIS_UPDATE_GOLDENS\" = missing ] || exit 1\n"
                 "for of in spheres bust; do echo x > ../tests/golden/${of}_my_skin.png; done");
    EXPECT_THAT(record().err, HasSubstr("recorded_scores.csv has no row of my_skin"));
    test_program("test_judge",
                 "[ \"$DERMIS_UPDATE_SCORES\" = missing ] || exit 1\n"
                 "echo spheres,my_skin,,0 >> ../tests/judge/recorded_scores.csv");
    const ProgramResult recorded = record();
    EXPECT_EQ(recorded.exit_code, 0) << recorded.err;
    // The tests that it runs exist.
    for (const auto& [filter, file, test] :
         {std::tuple("Goldens.*_with_every_technique", "render/golden_test.cpp",
                     R"(TEST_F\(Goldens, of_the_spheres_with_every_technique\))"),
          {"Goldens.*_with_every_technique", "render/golden_test.cpp",
           R"(TEST_F\(Goldens, of_the_bust_with_every_technique\))"},
          {"Scoreboards.*", "judge/scoreboard_test.cpp", R"(TEST_F\(Scoreboards, \w+\))"},
          {"RecordedCosts.*", "report/recorded_test.cpp", R"(TEST_F\(RecordedCosts, \w+\))"}}) {
        EXPECT_THAT(recorded.out, HasSubstr(std::string("--gtest_filter=") + filter + "\n"));
        EXPECT_TRUE(
            std::regex_search(slurp(std::string(DERMIS_SOURCE_DIR "/tests/") + file), std::regex(test)))
            << test;
    }
}
