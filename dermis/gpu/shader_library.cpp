// Shaders by name. SPIR-V comes from the program itself, or from glslc run as a process.

#include <unistd.h>

#include <cstring>

#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/base/process.h"
#include "dermis/base/text.h"
#include "dermis/gpu/executor.h"
#include "dermis/gpu/reflection.h"

namespace dermis::gpu {
namespace fs = std::filesystem;

Result<const Shader*> ShaderLibrary::get(std::string_view name, VkShaderStageFlagBits stage) {
    auto found = shaders_.find(name);
    if (found == shaders_.end()) {
        DERMIS_TRY_ASSIGN(std::vector<uint32_t> words, source_(name));
        DERMIS_TRY_ASSIGN(ShaderInterface interface, reflect(name, words));
        std::string hash = Hasher().add(std::as_bytes(std::span(words))).hex();
        Shader shader{std::string(name), std::move(hash), std::move(words), std::move(interface)};
        found = shaders_.emplace(std::string(name), std::move(shader)).first;
    }
    if (found->second.interface.stage != stage)
        return Error{"shader '" + std::string(name) + "' is of the wrong stage for its place in the pass"};
    return &found->second;
}

namespace {

// Removes the compiler's output in every case.
struct TemporaryFolder {
    fs::path path;
    TemporaryFolder() {
        std::string pattern = (fs::temp_directory_path() / "dermis-shader-XXXXXX").string();
        if (mkdtemp(pattern.data())) path = pattern;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        if (!path.empty()) fs::remove_all(path, ignored);
    }
};

Result<fs::path> find_source(const fs::path& root, std::string_view name) {
    for (const char* folder : {"shaders", "techniques"}) {
        const fs::path path = root / folder / name;
        std::error_code ignored;
        if (fs::is_regular_file(path, ignored)) return path;
    }
    return Error{"shader '" + std::string(name) + "' is neither in " + (root / "shaders").string() +
                 " nor in " + (root / "techniques").string()};
}

// The compiler's message in one line: its own lines joined, without the summary.
std::string one_line(std::string_view log) {
    std::vector<std::string> lines;
    for (std::string_view line : split(log, '\n'))
        if (!trim(line).empty() && line.find("error generated") == line.npos &&
            line.find("errors generated") == line.npos)
            lines.emplace_back(trim(line));
    return join(lines, "; ");
}

Result<std::vector<uint32_t>> to_words(std::string_view name, std::span<const std::byte> bytes) {
    if (bytes.empty() || bytes.size() % 4) return Error{"shader '" + std::string(name) + "': no SPIR-V"};
    std::vector<uint32_t> words(bytes.size() / 4);
    std::memcpy(words.data(), bytes.data(), bytes.size());
    return words;
}

Result<std::vector<uint32_t>> compile(const fs::path& root, std::string_view name) {
    DERMIS_TRY_ASSIGN(const fs::path source, find_source(root, name));
    const TemporaryFolder folder;
    if (folder.path.empty()) return Error{"cannot make a folder in " + fs::temp_directory_path().string()};
    const fs::path output = folder.path / "shader.spv", log = folder.path / "log.txt";
    const int status = run_program({"glslc", "--target-env=vulkan1.3", "-O", "-g", "-fauto-bind-uniforms",
                                    "-I", root.string(), "-o", output.string(), source.string()},
                                   log);
    // posix_spawn's child exits with 127 if the program does not exist.
    if (status == -1 || status == 127)
        return Error{"cannot run glslc, the shader compiler; install it (Debian: apt-get install glslc)"};
    if (status != 0) {
        const Result<std::string> said = read_text_file(log);
        return Error{said ? one_line(*said) : "glslc failed on " + source.string()};
    }
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> bytes, read_file(output));
    return to_words(name, bytes);
}

}  // namespace

ShaderSource embedded_shaders(std::span<const EmbeddedShader> shaders) {
    return [shaders](std::string_view name) -> Result<std::vector<uint32_t>> {
        std::vector<std::string> names;
        for (const EmbeddedShader& shader : shaders) {
            if (shader.name == name) return std::vector<uint32_t>(shader.words.begin(), shader.words.end());
            names.emplace_back(shader.name);
        }
        return Error{unknown_name("shader", name, names)};
    };
}

ShaderSource disk_shaders(std::filesystem::path root) {
    return [root = std::move(root)](std::string_view name) { return compile(root, name); };
}

}  // namespace dermis::gpu
