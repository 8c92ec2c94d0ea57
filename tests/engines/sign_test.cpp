// What a material without its table writes on the screen: the function, printed as C++ and compiled, against
// the letters.

#include <gmock/gmock.h>

#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "engines/packages.h"
#include "support/temporary_directory.h"

namespace dermis {
namespace {

// A character a cell of 4 pixels.
const std::string kMissingTable =
    "##. ###     ### #.# ### ##.     ### ### ##. #.. ###\n"
    "#.# #.#     #.. #.# .#. #.#     .#. #.# #.# #.. #..\n"
    "#.# #.#     ### ##. .#. #.#     .#. ### ##. #.. ##.\n"
    "#.# #.#     ..# #.# .#. #.#     .#. #.# #.# #.. #..\n"
    "#.# ###     ### #.# ### #.#     .#. #.# ##. ### ###\n";

const std::string kMissingCurvature =
    "##. ###     ### #.# ### #.# ### ### #.# ### ###    \n"
    "#.# #.#     #.. #.# #.# #.# #.# .#. #.# #.# #..    \n"
    "#.# #.#     #.. #.# ##. #.# ### .#. #.# ##. ##.    \n"
    "#.# #.#     #.. #.# #.# #.# #.# .#. #.# #.# #..    \n"
    "#.# ###     ### ### #.# .#. #.# .#. ### #.# ###    \n";

const std::string kChangedEngine =
    "### ##. ### ### ##. ###     ### #.# ### ##. ### ### ##.\n"
    "#.. #.# #.. .#. #.# #..     #.. #.# #.# #.# #.. #.. #.#\n"
    "##. #.# #.# .#. #.# ##.     #.. ### ### #.# #.# ##. #.#\n"
    "#.. #.# #.# .#. #.# #..     #.. #.# #.# #.# #.# #.. #.#\n"
    "### #.# ### ### #.# ###     ### #.# #.# #.# ### ### ##.\n";

// The text as the function draws it, row by row, of the first repetition but its empty cells at the right.
std::string drawn(const std::string& source, const std::string& function) {
    const auto units = shading::read_sources(std::vector<shading::Source>{{"sign.glsl", source}});
    EXPECT_TRUE(units) << units.error().message;
    if (!units) return "";
    const TemporaryDirectory directory;
    EXPECT_TRUE(
        write_text_file(directory.path / "sign.h", shading::print(*units, shading::Language::cpp, {})));
    EXPECT_TRUE(write_text_file(
        directory.path / "main.cpp",
        "#include <cstdio>\n#include \"sign.h\"\nint main() {\n"
        "    for (int y = 0; y < 5; ++y)\n        for (int x = 0; x < 56; ++x)\n"
        "            std::putchar(x == 55 ? '\\n' : skin::" +
            function + "(skin::float2(4.0f * x + 1.5f, 4.0f * y + 1.5f)) > 0.5f ? '#' : '.');\n}\n"));
    const std::string program = (directory.path / "sign").string();
    EXPECT_EQ(
        run_program({DERMIS_COMPILER, "-std=c++17", (directory.path / "main.cpp").string(), "-o", program},
                    directory.path / "log.txt"),
        0);
    EXPECT_EQ(run_program({program}, directory.path / "out.txt"), 0);
    const auto text = read_text_file(directory.path / "out.txt");
    return text ? *text : "";
}

std::string sign_source() {
    for (const PackageTemplate& file : built_in_package_templates())
        if (file.path == "engines/common/sign.glsl") return file.text;
    return "";
}

TEST(Sign, of_what_is_missing_is_legible) {
    for (const auto& [function, letters] : {std::pair("sign_of_missing_table", kMissingTable),
                                            {"sign_of_missing_curvature", kMissingCurvature},
                                            {"sign_of_changed_engine", kChangedEngine}}) {
        std::string expected;
        for (size_t at = 0, end; (end = letters.find('\n', at)) != std::string::npos; at = end + 1)
            expected += letters.substr(at, end - at) + std::string(55 - (end - at), '.') + "\n";
        for (char& c : expected)
            if (c == ' ') c = '.';
        EXPECT_EQ(drawn(sign_source(), function), expected) << function;
    }
}

}  // namespace
}  // namespace dermis
