#include <algorithm>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>

#include "dermis/base/file.h"
#include "dermis/base/process.h"
#include "shading/evaluate.h"
#include "support/temporary_directory.h"
#include "test_paths.h"

namespace dermis::shading {
namespace {

std::string base64(std::span<const std::byte> bytes) {
    constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t bits = 0;
        for (size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? uint32_t(bytes[i + k]) : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

// "f(a[0], vec3f(a[1], a[2], a[3]))"
std::string call_of(const Sampled& function, Language language) {
    std::string call = function.name + "(";
    size_t at = 0;
    for (const Type type : function.arguments) {
        if (at) call += ", ";
        const int count = component_count(type);
        if (count > 1) call += "vec" + std::to_string(count) + (language == Language::wgsl ? "f(" : "(");
        for (int i = 0; i < count; ++i) call += (i ? ", a[" : "a[") + std::to_string(at++) + "]";
        if (count > 1) call += ")";
    }
    return call + ")";
}

std::string job_of(const std::string& text, Language language, std::span<const Sampled> functions,
                   size_t samples) {
    nlohmann::json job = {{"language", language_name(language)}, {"text", text}, {"count", samples}};
    std::vector<float> inputs;
    for (const Sampled& function : functions) {
        job["functions"].push_back({{"call", call_of(function, language)},
                                    {"floats", function.argument_floats},
                                    {"components", component_count(function.result)}});
        const auto first = function.inputs.begin();
        inputs.insert(inputs.end(), first, first + ptrdiff_t(samples * function.argument_floats));
    }
    job["inputs"] = base64(std::as_bytes(std::span(inputs)));
    return job.dump();
}

// How many of the functions a page takes.
size_t functions_of_a_page(std::span<const Sampled> functions, size_t samples) {
    constexpr size_t kMostFloats = 4 << 20;
    size_t floats = 0, count = 0;
    while (count < functions.size() && (floats += samples * functions[count].argument_floats) <= kMostFloats)
        ++count;
    return std::max(count, size_t(1));
}

Result<Outputs> evaluate_on_a_page(const std::string& chromium, const std::string& text, Language language,
                                   std::span<const Sampled> functions, size_t samples) {
    const TemporaryDirectory directory;
    Result<std::string> page = read_text_file(DERMIS_SOURCE_DIR "/tests/shading/evaluate.html");
    if (!page) return page.error();
    const std::string mark = "@JOB@";
    page->replace(page->find(mark), mark.size(), job_of(text, language, functions, samples));
    const auto path = directory.path / "page.html", output = directory.path / "out",
               log = directory.path / "log.txt";
    if (const Result<void> written = write_text_file(path, *page); !written) return written.error();
    const int status = run_program({"node", DERMIS_SOURCE_DIR "/tools/checks/evaluate_page.mjs", chromium,
                                    path.string(), output.string()},
                                   log);
    if (status != 0) {
        const Result<std::string> said = read_text_file(log);
        return Error{std::string(status == 3 ? kBrowserLacks : "the browser: ") + (said ? *said : "")};
    }
    const Result<std::vector<std::byte>> bytes = read_file(output);
    if (!bytes) return bytes.error();
    const size_t each = samples * 16;
    if (bytes->size() != functions.size() * each) return Error{"the page gave too little"};
    Outputs outputs(functions.size(), std::vector<float>(samples * 4));
    for (size_t i = 0; i < outputs.size(); ++i)
        std::memcpy(outputs[i].data(), bytes->data() + i * each, each);
    return outputs;
}

}  // namespace

Result<Outputs> evaluate_in_browser(const std::string& chromium, const std::string& text, Language language,
                                    const std::vector<Sampled>& functions, size_t side) {
    const size_t samples = side * side;
    Outputs all;
    for (std::span<const Sampled> left = functions; !left.empty();) {
        const size_t count = functions_of_a_page(left, samples);
        Result<Outputs> outputs = evaluate_on_a_page(chromium, text, language, left.first(count), samples);
        if (!outputs) return outputs.error();
        std::ranges::move(*outputs, std::back_inserter(all));
        left = left.subspan(count);
    }
    return all;
}

}  // namespace dermis::shading
