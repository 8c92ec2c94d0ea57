// tools/get_head against a file server on this machine.

#include <gtest/gtest.h>
#include <signal.h>
#include <stdio.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/scene/scene_files.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;
namespace fs = std::filesystem;

namespace {

// Python's file server on a free port, as long as the object lives.
class FileServer {
  public:
    explicit FileServer(const fs::path& directory) {
        const std::string command =
            "echo $$; exec python3 -u -m http.server 0 --bind 127.0.0.1 --directory '" + directory.string() +
            "' 2>/dev/null";
        pipe_ = ::popen(command.c_str(), "r");
        // "Serving HTTP on 127.0.0.1 port 40123 (...".
        if (pipe_ && ::fscanf(pipe_, "%d Serving HTTP on 127.0.0.1 port %d", &pid_, &port_) != 2) port_ = 0;
    }
    ~FileServer() {
        if (pid_ > 0) ::kill(pid_, SIGTERM);
        if (pipe_) ::pclose(pipe_);
    }
    FileServer(const FileServer&) = delete;
    FileServer& operator=(const FileServer&) = delete;

    [[nodiscard]] bool runs() const { return port_ > 0; }
    [[nodiscard]] std::string address() const { return "http://127.0.0.1:" + std::to_string(port_); }

  private:
    FILE* pipe_ = nullptr;
    int pid_ = 0, port_ = 0;
};

struct Outcome {
    int status;
    std::string output;
};

Outcome get_head(const std::string& address, const fs::path& directory) {
    const std::string command = "DERMIS_HEAD_URL='" + address +
                                "' no_proxy='*' '" DERMIS_SOURCE_DIR "/tools/get_head' '" +
                                directory.string() + "' 2>&1";
    Outcome outcome;
    FILE* pipe = ::popen(command.c_str(), "r");
    std::array<char, 4096> buffer;
    for (size_t n; (n = ::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
        outcome.output.append(buffer.data(), n);
    outcome.status = ::pclose(pipe);
    return outcome;
}

size_t files_in(const fs::path& directory) {
    return size_t(std::distance(fs::recursive_directory_iterator(directory), {}));
}

constexpr const char* kMissing = "python3 and curl or wget are needed";

}  // namespace

TEST(GetHead, a_file_with_another_content_is_refused_and_nothing_of_it_stays) {
    if (!has_program("python3") || !(has_program("curl") || has_program("wget"))) GTEST_SKIP() << kMissing;
    const TemporaryDirectory source, target;
    ASSERT_TRUE(write_text_file(source.path / "color_2048.jpg", "not the scan"));
    const FileServer server(source.path);
    ASSERT_TRUE(server.runs());
    const Outcome outcome = get_head(server.address(), target.path);
    EXPECT_NE(outcome.status, 0);
    EXPECT_NE(
        outcome.output.find("color_2048.jpg: what " + server.address() +
                            "/color_2048.jpg sent is another file (its SHA-256 is wrong); nothing was kept"),
        std::string::npos)
        << outcome.output;
    EXPECT_NE(outcome.output.find("head_quads.obj: cannot fetch " + server.address() + "/head_quads.obj"),
              std::string::npos)
        << outcome.output;
    EXPECT_EQ(outcome.output.find("CC BY"), std::string::npos) << "credit without files";
    EXPECT_EQ(files_in(target.path), 1u) << "only the empty directory";
}

TEST(GetHead, fetches_checks_and_credits_and_does_not_fetch_twice) {
    if (!has_program("python3") || !(has_program("curl") || has_program("wget"))) GTEST_SKIP() << kMissing;
    const Result<fs::path> asset = resolve_path("assets:lee_perry_smith/head_quads.obj", "");
    if (!asset) GTEST_SKIP() << asset.error().message;
    const TemporaryDirectory target;
    std::string address;
    {
        const FileServer server(asset->parent_path());
        ASSERT_TRUE(server.runs());
        address = server.address();
        const Outcome outcome = get_head(address, target.path);
        if (outcome.output.find("cannot fetch") != std::string::npos) GTEST_SKIP() << outcome.output;
        EXPECT_EQ(outcome.status, 0) << outcome.output;
        EXPECT_NE(outcome.output.find("by Lee Perry-Smith (www.ir-ltd.net), CC BY 3.0"), std::string::npos);
    }
    EXPECT_EQ(*read_file(target.path / "lee_perry_smith" / "head_quads.obj"), *read_file(*asset));
    EXPECT_EQ(files_in(target.path), 8u) << "seven files and their directory";
    const Outcome again = get_head(address, target.path);
    EXPECT_EQ(again.status, 0) << "the server is gone, but nothing is missing: " << again.output;
}

TEST(GetHead, a_second_address_is_tried_when_the_first_lacks_the_file_or_sends_another) {
    if (!has_program("python3") || !(has_program("curl") || has_program("wget"))) GTEST_SKIP() << kMissing;
    const Result<fs::path> asset = resolve_path("assets:lee_perry_smith/head_quads.obj", "");
    if (!asset) GTEST_SKIP() << asset.error().message;
    const TemporaryDirectory first, target;
    ASSERT_TRUE(write_text_file(first.path / "color_2048.jpg", "not the scan"));
    const FileServer bad(first.path), good(asset->parent_path());
    ASSERT_TRUE(bad.runs() && good.runs());
    const Outcome outcome = get_head(bad.address() + " " + good.address(), target.path);
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    EXPECT_NE(outcome.output.find("color_2048.jpg: what " + bad.address()), std::string::npos);
    EXPECT_NE(outcome.output.find("head.obj: cannot fetch " + bad.address()), std::string::npos);
    EXPECT_NE(outcome.output.find("CC BY 3.0"), std::string::npos);
    EXPECT_EQ(*read_file(target.path / "lee_perry_smith" / "color_2048.jpg"),
              *read_file(asset->parent_path() / "color_2048.jpg"));
    EXPECT_EQ(files_in(target.path), 8u) << "seven files and their directory";
}

// The table of the script: every file has an address that names a fixed version, and scenes need no other
// file.
TEST(GetHead, every_file_of_the_head_that_a_scene_uses_has_an_address) {
    const std::string script = *read_text_file(DERMIS_SOURCE_DIR "/tools/get_head");
    static const std::regex row(R"(\n(\w+\.\w+) +[0-9a-f|]{64,129}((?: \$(?:three|mean)/[\w./-]+)*)(?=\n))");
    std::map<std::string, std::string> addresses;
    for (std::sregex_iterator it(script.begin(), script.end(), row), end; it != end; ++it)
        addresses[(*it)[1]] = (*it)[2];
    EXPECT_EQ(addresses.size(), 7u);
    for (const auto& [name, list] : addresses) EXPECT_NE(list, "") << name;
    EXPECT_NE(addresses["color_2048.jpg"].find("$mean/"), std::string::npos);
    EXPECT_NE(addresses["specular_2048.jpg"].find("$mean/"), std::string::npos);
    static const std::regex used(R"(assets:lee_perry_smith/([\w.]+))");
    size_t uses = 0;
    for (const auto& entry : fs::directory_iterator(DERMIS_SOURCE_DIR "/scenes")) {
        const std::string scene = *read_text_file(entry.path());
        for (std::sregex_iterator it(scene.begin(), scene.end(), used), end; it != end; ++it, ++uses)
            EXPECT_TRUE(addresses.contains((*it)[1])) << entry.path() << ": " << (*it)[1];
    }
    EXPECT_GT(uses, 5u);
}
