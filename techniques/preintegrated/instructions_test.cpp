// What the closed form costs beside the hand-made curves, counted in the SPIR-V that glslc makes of each.

#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <set>

#include "dermis/base/file.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

using namespace dermis;

namespace {

// Opcodes that compute (SPIR-V 1.6, section 3.49): conversions, extended instructions (sqrt, clamp, fma,
// mix), arithmetic, bits, logic. Loads, stores, sampling, and the making and taking apart of vectors do not
// count.
bool computes(uint32_t opcode) {
    return opcode == 12 || (opcode >= 109 && opcode <= 124) || (opcode >= 126 && opcode <= 152) ||
           (opcode >= 154 && opcode <= 191) || (opcode >= 194 && opcode <= 205);
}

struct Count {
    int alu = 0, fetches = 0;
};

Count count_instructions(std::span<const std::byte> spirv) {
    std::vector<uint32_t> words(spirv.size() / 4);
    std::memcpy(words.data(), spirv.data(), words.size() * 4);
    Count count;
    for (size_t i = 5; i < words.size(); i += std::max(words[i] >> 16, 1u)) {
        const uint32_t opcode = words[i] & 0xFFFF;
        count.alu += computes(opcode);
        count.fetches += opcode >= 87 && opcode <= 95;
    }
    return count;
}

// A fragment shader whose only work is `expression`, of vec3 t (N.L a channel) and float k (curvature).
Count compiled(const std::string& include, const std::string& expression) {
    const TemporaryDirectory directory;
    const auto source = directory.path / "count.frag", output = directory.path / "count.spv";
    const std::string text = "#version 460\n#extension GL_GOOGLE_include_directive : require\n#include \"" +
                             include +
                             "\"\nuniform texture2D table;\n"
                             "uniform sampler table_sampler;\n"
                             "layout(location = 0) in vec3 t;\nlayout(location = 1) in float k;\n"
                             "layout(location = 0) out vec3 o;\nvoid main() { o = " +
                             expression + "; }\n";
    EXPECT_TRUE(write_text_file(source, text));
    const std::string command = "glslc -O --target-env=vulkan1.3 -fauto-bind-uniforms -I " DERMIS_SOURCE_DIR
                                " " +
                                source.string() + " -o " + output.string();
    EXPECT_EQ(std::system(command.c_str()), 0);
    const auto bytes = read_file(output);
    EXPECT_TRUE(bytes);
    return bytes ? count_instructions(*bytes) : Count{};
}

}  // namespace

TEST(PreintegratedInstructions, of_the_closed_form_are_fewer_than_of_the_hand_made_curves) {
    // The closed form's count includes its coordinate: curvature to the centres of 257 texels.
    const Count closed = compiled("techniques/preintegrated/closed_form.glsl",
                                  "closed_form(read_closed_form(table, table_sampler, "
                                  "(clamp(k, 0.0, 1.0) * 256.0 + 0.5) / 257.0), t)"),
                curves = compiled("shaders/include/skin/curve_2015.glsl", "curve_2015_direct(t.x, k)");
    RecordProperty("closed_form", closed.alu);
    RecordProperty("curve_2015", curves.alu);
    EXPECT_GE(closed.alu, 8) << "counted nothing?";
    EXPECT_LT(closed.alu, curves.alu);
    EXPECT_EQ(closed.fetches, 4);
    EXPECT_EQ(curves.fetches, 0);
}
