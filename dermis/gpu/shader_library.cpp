#include "dermis/gpu/shader_library.h"

#include "dermis/base/hash.h"

namespace dermis::gpu {

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

}  // namespace dermis::gpu
