#pragma once
// The program with a UI script, on a virtual display, with validation layers.

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "cli/run_program.h"
#include "dermis/base/file.h"
#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "dermis/technique/technique.h"
#include "support/temporary_directory.h"
#include "view/display.h"

namespace dermis {

class ViewWindow : public ::testing::Test {
  protected:
    static void SetUpTestSuite() { display_ = std::make_unique<VirtualDisplay>("1024x768"); }
    static void TearDownTestSuite() { display_.reset(); }
    void SetUp() override {
        if (display_->name().empty()) GTEST_SKIP() << "no Xvfb; apt-get install xvfb";
    }

    ProgramResult shell(const std::string& line) { return run_shell(line, directory_.path.string()); }
    std::string path(const std::string& name) { return (directory_.path / name).string(); }

    /// Runs `dermis view` with a script; paths in it may use DIR.
    ProgramResult view(const std::string& arguments, std::string script, const char* layers = " --validate") {
        for (size_t at; (at = script.find("DIR")) != script.npos;)
            script.replace(at, 3, directory_.path.string());
        EXPECT_TRUE(write_text_file(path("script.txt"), script));
        return shell(program(*display_) + " view " + arguments + layers + " --script " + path("script.txt"));
    }
    /// The program on a display, with its state file in the test's folder.
    std::string program(const VirtualDisplay& display) {
        return "DISPLAY=" + display.name() + " XDG_STATE_HOME=" + path("state") + " " + DERMIS_PROGRAM;
    }
    /// A mesh file with one square, which is drawn quickly, and a white map, for want of which there is a
    /// notice.
    std::string square() {
        Image white(2, 2, 3);
        for (int i = 0; i < 4; ++i)
            for (int c = 0; c < 3; ++c) white.set(i % 2, i / 2, c, 1);
        EXPECT_TRUE(write_image(path("white.png"), white));
        EXPECT_TRUE(write_text_file(path("square.mtl"), "newmtl skin\nmap_Kd white.png\n"));
        EXPECT_TRUE(write_text_file(
            path("square.obj"),
            "mtllib square.mtl\nusemtl skin\nv -100 -100 0\nv 100 -100 0\nv 100 100 0\nv -100 100 0\n"
            "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n"));
        return path("square.obj");
    }

    Image image(const std::string& name) {
        Result<LoadedImage> loaded = read_image(path(name), ImageUse::color);
        EXPECT_TRUE(loaded) << loaded.error().message;
        return loaded ? std::move(loaded->image) : Image();
    }

    /// What follows the last "technique " of standard output: the state at the last print.
    static std::string last_state(const ProgramResult& result) {
        const size_t at = result.out.rfind("technique ");
        return at == std::string::npos ? "" : result.out.substr(at);
    }

    /// The rest of the line of standard output that begins with `key`.
    static std::string value_of(const ProgramResult& result, const std::string& key) {
        for (const std::string_view line : split(result.out, '\n'))
            if (line.starts_with(key + " ")) return std::string(line.substr(key.size() + 1));
        ADD_FAILURE() << "no '" << key << "' in " << result.out << result.err;
        return "";
    }

    TemporaryDirectory directory_;
    inline static std::unique_ptr<VirtualDisplay> display_;
};

inline const std::string kSmall = "builtin:spheres --size 560x320 --samples 1 ";

}  // namespace dermis
