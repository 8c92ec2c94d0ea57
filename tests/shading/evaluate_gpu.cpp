// A fullscreen pass of 320 x 320 pixels: each pixel is a sample, each target the result of a function.

#include <algorithm>
#include <cstring>

#include "dermis/base/cache.h"
#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/base/process.h"
#include "shading/evaluate.h"
#include "support/temporary_directory.h"

namespace dermis::shading {
namespace {

constexpr size_t kTargets = 8;

constexpr const char* kFullscreen =
    "#version 460\nvoid main() {\n    vec2 uv = vec2((gl_VertexIndex << 1) & 2, gl_VertexIndex & 2);\n"
    "    gl_Position = vec4(uv * 2.0 - 1.0, 0.0, 1.0);\n}\n";

Result<std::vector<uint32_t>> compile(const std::string& text, const std::string& stage, bool hlsl) {
    const std::string hash = Hasher().add(text).add(stage).add(hlsl ? "hlsl" : "glsl").hex();
    std::optional<std::vector<std::byte>> bytes = cache_load("test-shaders", hash);
    if (!bytes) {
        const TemporaryDirectory directory;
        const std::string source = (directory.path / "shader.txt").string(), spirv = source + ".spv";
        if (const Result<void> written = write_text_file(source, text); !written) return written.error();
        std::vector<std::string> command = {"glslc", "--target-env=vulkan1.3", "-fauto-bind-uniforms",   "-g",
                                            "-x",    hlsl ? "hlsl" : "glsl",   "-fshader-stage=" + stage};
        command.insert(command.end(), {"-o", spirv, source});
        if (run_program(command, directory.path / "log.txt") != 0) {
            const Result<std::string> log = read_text_file(directory.path / "log.txt");
            return Error{"glslc: " + (log ? log->substr(0, 2000) : "not found")};
        }
        const Result<std::vector<std::byte>> compiled = read_file(spirv);
        if (!compiled) return compiled.error();
        bytes = *compiled;
        cache_store("test-shaders", hash, *bytes);
    }
    std::vector<uint32_t> words(bytes->size() / 4);
    std::memcpy(words.data(), bytes->data(), bytes->size());
    return words;
}

std::string input_name(size_t target, size_t texture) {
    return "in_" + std::to_string(target) + "_" + std::to_string(texture);
}

// "a_0_0.x": one float of the arguments of a function.
std::string input_float(size_t target, size_t index) {
    return "a_" + std::to_string(target) + "_" + std::to_string(index / 4) + "." + "xyzw"[index % 4];
}

size_t texture_count(const Sampled& function) {
    return (function.argument_floats + 3) / 4;
}

std::string call_of(const Sampled& function, size_t target, const std::string& vector) {
    std::string call = function.name + "(";
    size_t at = 0;
    for (const Type type : function.arguments) {
        if (at) call += ", ";
        const int count = component_count(type);
        if (count > 1) call += vector + std::to_string(count) + "(";
        for (int i = 0; i < count; ++i) call += (i ? ", " : "") + input_float(target, at++);
        if (count > 1) call += ")";
    }
    call = vector + "4(" + call + ")";
    for (int i = component_count(function.result); i < 4; ++i) call += ", 0.0";
    return call + ")";
}

std::string glsl_shader(const std::string& text, Language language, std::span<const Sampled> group) {
    std::string source = language == Language::essl
                             ? "#version 320 es\nprecision highp texture2D;\nprecision highp sampler;\n"
                             : "#version 460\n";
    source += text + "uniform sampler nearest_clamp;\n";
    std::string body;
    for (size_t t = 0; t < group.size(); ++t) {
        const std::string index = std::to_string(t);
        source += "layout(location = " + index + ") out vec4 out_" + index + ";\n";
        for (size_t k = 0; k < texture_count(group[t]); ++k) {
            source += "uniform texture2D " + input_name(t, k) + ";\n";
            body += "    vec4 a_" + index + "_" + std::to_string(k) + " = texelFetch(sampler2D(" +
                    input_name(t, k) + ", nearest_clamp), ivec2(gl_FragCoord.xy), 0);\n";
        }
        body += "    out_" + index + " = " + call_of(group[t], t, "vec") + ";\n";
    }
    return source + "void main() {\n" + body + "}\n";
}

std::string hlsl_shader(const std::string& text, std::span<const Sampled> group) {
    std::string source = text, body, targets;
    for (size_t t = 0; t < group.size(); ++t) {
        const std::string index = std::to_string(t);
        targets += "    float4 value_" + index + " : SV_Target" + index + ";\n";
        for (size_t k = 0; k < texture_count(group[t]); ++k) {
            source += "Texture2D<float4> " + input_name(t, k) + ";\n";
            body += "    float4 a_" + index + "_" + std::to_string(k) + " = " + input_name(t, k) +
                    ".Load(int3(int2(position.xy), 0));\n";
        }
        body += "    targets.value_" + index + " = " + call_of(group[t], t, "float") + ";\n";
    }
    return source + "struct Targets {\n" + targets + "};\nTargets main(float4 position : SV_Position) {\n" +
           "    Targets targets;\n" + body + "    return targets;\n}\n";
}

Result<gpu::Texture> upload(gpu::Device& device, const Sampled& function, size_t texture,
                            const std::string& name) {
    std::vector<float> texels(kSampleCount * 4, 0.0f);
    for (size_t s = 0; s < kSampleCount; ++s)
        for (size_t c = 0; c < 4 && texture * 4 + c < function.argument_floats; ++c)
            texels[s * 4 + c] = function.inputs[s * function.argument_floats + texture * 4 + c];
    gpu::TextureData data{.name = name,
                          .format = ImageFormat::rgba32f,
                          .width = kSampleSide,
                          .height = kSampleSide,
                          .bytes = {}};
    const auto bytes = std::as_bytes(std::span(texels));
    data.bytes.assign(bytes.begin(), bytes.end());
    return gpu::Texture::upload(device, data);
}

Result<Outputs> evaluate_group(gpu::Device& device, const std::string& source, bool hlsl,
                               std::span<const Sampled> group) {
    Result<gpu::Executor> executor = gpu::Executor::create(device, [&](std::string_view name) {
        return name.ends_with(".vert") ? compile(kFullscreen, "vert", false) : compile(source, "frag", hlsl);
    });
    if (!executor) return executor.error();
    gpu::FrameInputs inputs{.width = kSampleSide, .height = kSampleSide};
    std::vector<gpu::Texture> textures;
    textures.reserve(kTargets * 4);
    PassList list{.passes = {{.name = "evaluate", .shader = "evaluate.frag"}}};
    for (size_t t = 0; t < group.size(); ++t) {
        const std::string target = "out_" + std::to_string(t);
        list.images.push_back({.name = target, .format = ImageFormat::rgba32f});
        list.passes[0].colors.push_back({.image = target});
        for (size_t k = 0; k < texture_count(group[t]); ++k) {
            Result<gpu::Texture> texture = upload(device, group[t], k, input_name(t, k));
            if (!texture) return texture.error();
            textures.push_back(std::move(*texture));
            inputs.textures[input_name(t, k)] = &textures.back();
        }
    }
    if (const auto ran = executor->run(list, inputs); !ran) return ran.error();
    Outputs outputs;
    for (size_t t = 0; t < group.size(); ++t) {
        const Result<Image> image = executor->read("out_" + std::to_string(t));
        if (!image) return image.error();
        outputs.emplace_back(image->floats().begin(), image->floats().end());
    }
    return outputs;
}

}  // namespace

Result<Outputs> evaluate_on_gpu(gpu::Device& device, const std::string& text, Language language,
                                const std::vector<Sampled>& functions) {
    Outputs all;
    for (size_t first = 0; first < functions.size(); first += kTargets) {
        const auto group = std::span(functions).subspan(first, std::min(kTargets, functions.size() - first));
        const bool hlsl = language == Language::hlsl;
        const std::string source = hlsl ? hlsl_shader(text, group) : glsl_shader(text, language, group);
        Result<Outputs> outputs = evaluate_group(device, source, hlsl, group);
        if (!outputs) return outputs.error();
        for (std::vector<float>& values : *outputs) all.push_back(std::move(values));
    }
    return all;
}

}  // namespace dermis::shading
