#pragma once
// Shaders by name, with what they want; read once until forgotten.

#include <map>

#include "dermis/gpu/executor.h"
#include "dermis/gpu/reflection.h"

namespace dermis::gpu {

struct Shader {
    std::string name;
    std::string hash;  ///< of the words
    std::vector<uint32_t> words;
    ShaderInterface interface;
};

class ShaderLibrary {
  public:
    explicit ShaderLibrary(ShaderSource source) : source_(std::move(source)) {}

    /// Valid until forget(). A shader that fails is asked for again next time.
    [[nodiscard]] Result<const Shader*> get(std::string_view name, VkShaderStageFlagBits stage);
    void forget() { shaders_.clear(); }

  private:
    ShaderSource source_;
    std::map<std::string, Shader, std::less<>> shaders_;
};

}  // namespace dermis::gpu
