#pragma once
// The interface of a shader, read from its SPIR-V by name: bindings, blocks, constants, inputs, outputs.
// Binding numbers in the source do not matter: each pipeline assigns its own, by name.

#include <array>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "dermis/gpu/executor.h"
#include "dermis/gpu/vulkan.h"

namespace dermis::gpu {

enum class BindingKind { texture, sampled_texture, storage_image, sampler, uniform_block, storage_buffer };
enum class TextureShape { plane, cube, plane_multisampled, other };
enum class ValueType { int32, uint32, number, vec2, vec3, vec4, mat4 };
[[nodiscard]] std::string_view type_name(ValueType type);

/// Arrays are flattened: taps[0], taps[1], ...
struct BlockMember {
    std::string name;
    ValueType type = ValueType::number;
    uint32_t offset = 0;
    friend bool operator==(const BlockMember&, const BlockMember&) = default;
};

/// A uniform or push-constant block, or one element of a storage buffer's array (size: its stride).
struct BlockLayout {
    std::vector<BlockMember> members;
    uint32_t size = 0;
    friend bool operator==(const BlockLayout&, const BlockLayout&) = default;
};

struct Binding {
    std::string name;
    BindingKind kind = BindingKind::texture;
    TextureShape shape = TextureShape::plane;
    std::string_view texel_format;  ///< of a storage image, as GLSL has it; empty when it has none
    BlockLayout block;
    bool writable = false;  ///< a storage buffer of a compute shader that is not readonly
    /// Positions of the numbers in the SPIR-V, in words.
    uint32_t binding_word = 0, set_word = 0;
};

/// An input or output of a stage.
struct StageVariable {
    std::string name;
    uint32_t location = 0;
    int components = 0;
};

struct SpecializationConstant {
    std::string name;
    uint32_t id = 0;
    uint32_t default_value = 0;
};

struct ShaderInterface {
    VkShaderStageFlagBits stage = VK_SHADER_STAGE_FRAGMENT_BIT;
    std::vector<Binding> bindings;
    BlockLayout push_constants;
    std::vector<StageVariable> inputs, outputs;  ///< by location; without built-ins
    std::vector<SpecializationConstant> constants;
    std::array<uint32_t, 3> local_size = {1, 1, 1};
};

/// Errors name the shader and what in it cannot be bound by name (combined samplers, unknown types).
[[nodiscard]] Result<ShaderInterface> reflect(std::string_view shader, std::span<const uint32_t> words);

struct Shader {
    std::string name;
    std::string hash;  ///< of the words
    std::vector<uint32_t> words;
    ShaderInterface interface;
};

/// Shaders by name, read once until forgotten.
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
