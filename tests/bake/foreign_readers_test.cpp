// KTX2 and DDS tables read by other programs: the npm package ktx-parse, and NVIDIA Texture Tools.

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <sstream>

#include "dermis/bake/lut.h"
#include "dermis/bake/table_io.h"
#include "dermis/base/file.h"
#include "dermis/image/half.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;

namespace {

// Standard output of a shell command; empty when it failed.
std::string output_of(const std::string& command) {
    FILE* pipe = ::popen((command + " 2>/dev/null").c_str(), "r");
    if (!pipe) return {};
    std::string output;
    std::array<char, 4096> buffer;
    while (const size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe))
        output.append(buffer.data(), count);
    return ::pclose(pipe) == 0 ? output : std::string();
}

Table table() {
    LutOptions lut = *lut_options("dermis");
    lut.width = 24;
    lut.height = 10;
    return *bake_lut(lut);
}

}  // namespace

TEST(ForeignReader, ktx_parse_reads_a_ktx2_table) {
    const std::string checks = DERMIS_SOURCE_DIR "/tools/checks";
    if (!std::filesystem::exists(checks + "/node_modules/ktx-parse") || output_of("node --version").empty())
        GTEST_SKIP() << "needs node, and 'npm ci' in tools/checks";
    const TemporaryDirectory dir;
    const Table lut = table();
    ASSERT_TRUE(write_table(dir.path / "a.ktx2", lut));
    std::istringstream found(
        output_of("node " + checks + "/read_ktx2.mjs " + (dir.path / "a.ktx2").string() + " 15 6"));
    constexpr int kRgba16Float = 97;  // VK_FORMAT_R16G16B16A16_SFLOAT
    int format = 0, width = 0, height = 0, levels = 0;
    std::string transfer, kind, encoding;
    Rgb rgb = {};
    found >> format >> width >> height >> levels >> transfer >> kind >> encoding >> rgb[0] >> rgb[1] >>
        rgb[2];
    ASSERT_TRUE(found);
    EXPECT_EQ(format, kRgba16Float);
    EXPECT_EQ(width, 24);
    EXPECT_EQ(height, 10);
    EXPECT_EQ(levels, 1);
    EXPECT_EQ(transfer + " " + kind + " " + encoding, "linear diffuse linear");
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[size_t(c)], lut.at(15, 6, c), 3e-4);
}

TEST(ForeignReader, nvidia_texture_tools_read_the_header_of_a_dds_table) {
    const TemporaryDirectory dir;
    const Table lut = table();
    const std::string path = (dir.path / "a.dds").string();
    ASSERT_TRUE(write_table(path, lut));
    const std::string info = output_of("nvddsinfo " + path);
    if (info.empty()) GTEST_SKIP() << "needs nvddsinfo (libnvtt-bin)";
    EXPECT_NE(info.find("DXGI Format: 10 (R16G16B16A16_FLOAT)"), std::string::npos) << info;
    EXPECT_NE(info.find("Width: 24"), std::string::npos);
    EXPECT_NE(info.find("Height: 10"), std::string::npos);

    // That reader does not decode float texels; they follow its header, rows top to bottom, red first.
    const std::vector<std::byte> file = *read_file(path);
    constexpr size_t kHeader = 4 + 124 + 20;
    ASSERT_EQ(file.size(), kHeader + 24 * 10 * 8);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 24; ++x)
            for (int c = 0; c < 3; ++c) {
                const size_t at = kHeader + size_t(8 * (y * 24 + x) + 2 * c);
                const uint16_t bits = uint16_t(unsigned(file[at]) | unsigned(file[at + 1]) << 8);
                EXPECT_NEAR(from_half(bits), lut.at(x, y, c), 3e-4) << x << " " << y << " " << c;
            }
}
