#include <cstring>

#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "dermis/shading/dialect.h"
#include "shading/evaluate.h"
#include "support/temporary_directory.h"

namespace dermis::shading {
namespace {

// What the printed text uses of Metal's standard library.
std::string metal_header() {
    return "#pragma once\n#include <cmath>\n#define constant static constexpr\nnamespace metal {\n" +
           std::string(cpp_prelude()) +
           "inline float saturate(float x) { return clamp(x, 0.0f, 1.0f); }\n"
           "template <class V, int = V::size> V saturate(V v) { return clamp(v, 0.0f, 1.0f); }\n"
           "template <class V> V rsqrt(V v) { return inversesqrt(v); }\n}\n";
}

std::string call_of(const Sampled& function) {
    std::string call = "skin::" + function.name + "(";
    size_t at = 0;
    for (const Type type : function.arguments) {
        if (at) call += ", ";
        const int count = component_count(type);
        if (count > 1) call += "skin::float" + std::to_string(count) + "(";
        for (int i = 0; i < count; ++i) call += (i ? ", p[" : "p[") + std::to_string(at++) + "]";
        if (count > 1) call += ")";
    }
    return call + ")";
}

std::string program(const std::string& header, const std::vector<Sampled>& functions) {
    std::string text =
        "#include <cstdio>\n#include <vector>\n#include \"" + header +
        "\"\nstatic void put(float* o, float r) { o[0] = r; }\n"
        "template <class V> void put(float* o, V r) { for (int i = 0; i < V::size; ++i) o[i] = r[i]; }\n"
        "int main(int, char** argv) {\n    std::FILE *in = std::fopen(argv[1], \"rb\"), *out = "
        "std::fopen(argv[2], \"wb\");\n    if (!in || !out) return 1;\n";
    for (const Sampled& function : functions) {
        const std::string floats = std::to_string(function.argument_floats);
        text += "    for (int i = 0; i < " + std::to_string(kSampleCount) + "; ++i) {\n        float p[" +
                floats + "], o[4] = {0, 0, 0, 0};\n        if (std::fread(p, 4, " + floats +
                ", in) != " + floats + ") return 1;\n        put(o, " + call_of(function) +
                ");\n        std::fwrite(o, 4, 4, out);\n    }\n";
    }
    return text + "    return std::fclose(out);\n}\n";
}

Result<void> run(const std::vector<std::string>& arguments, const std::filesystem::path& folder) {
    if (run_program(arguments, folder / "log.txt") == 0) return {};
    const Result<std::string> log = read_text_file(folder / "log.txt");
    return Error{arguments[0] + ": " + (log ? log->substr(0, 2000) : "no message")};
}

}  // namespace

Result<Outputs> evaluate_on_cpu(const std::string& text, Language language,
                                const std::vector<Sampled>& functions) {
    const TemporaryDirectory directory;
    const auto& folder = directory.path;
    const std::string header = "skin" + std::string(file_extension(language));
    std::vector<float> inputs;
    for (const Sampled& function : functions)
        inputs.insert(inputs.end(), function.inputs.begin(), function.inputs.end());
    for (const Result<void>& written :
         {write_text_file(folder / header, text), write_text_file(folder / "metal_stdlib", metal_header()),
          write_text_file(folder / "main.cpp", program(header, functions)),
          write_file(folder / "in", std::as_bytes(std::span(inputs)))})
        if (!written) return written.error();
    const std::string binary = (folder / "program").string();
    // Metal's 1.0 is a float.
    std::vector<std::string> compile = {DERMIS_COMPILER,
                                        "-std=c++17",
                                        "-O1",
                                        "-Wall",
                                        "-Wextra",
                                        "-Werror",
                                        "-I",
                                        folder.string(),
                                        "-o",
                                        binary,
                                        (folder / "main.cpp").string()};
    if (language == Language::msl) compile.insert(compile.begin() + 1, "-fsingle-precision-constant");
    if (const Result<void> compiled = run(compile, folder); !compiled) return compiled.error();
    if (const Result<void> ran = run({binary, (folder / "in").string(), (folder / "out").string()}, folder);
        !ran)
        return ran.error();
    const Result<std::vector<std::byte>> bytes = read_file(folder / "out");
    if (!bytes) return bytes.error();
    if (bytes->size() != functions.size() * kSampleCount * 16) return Error{"the program wrote too little"};
    Outputs outputs(functions.size(), std::vector<float>(kSampleCount * 4));
    for (size_t i = 0; i < outputs.size(); ++i)
        std::memcpy(outputs[i].data(), bytes->data() + i * kSampleCount * 16, kSampleCount * 16);
    return outputs;
}

}  // namespace dermis::shading
