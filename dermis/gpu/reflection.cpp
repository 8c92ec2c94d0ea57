#include "dermis/gpu/reflection.h"

#include <fmt/core.h>
#include <spirv_cross/spirv_cross_c.h>

#include <memory>
#include <optional>

namespace dermis::gpu {
namespace {

using Resources = std::span<const spvc_reflected_resource>;

// Reads one module. error_ keeps the first problem; what is read after it is not used.
class Reflector {
  public:
    Reflector(std::string_view shader, spvc_compiler compiler, spvc_resources resources)
        : shader_(shader), compiler_(compiler), resources_(resources) {}

    Result<ShaderInterface> run() {
        read_stage();
        read_bindings();
        read_push_constants();
        read_interface_variables();
        read_constants();
        if (error_) return *error_;
        return std::move(result_);
    }

  private:
    void fail(const std::string& what) {
        if (!error_) error_ = Error{"shader '" + shader_ + "': " + what};
    }

    Resources list(spvc_resource_type type) {
        const spvc_reflected_resource* first = nullptr;
        size_t count = 0;
        if (spvc_resources_get_resource_list_for_type(resources_, type, &first, &count) != SPVC_SUCCESS)
            fail("SPIR-V that cannot be reflected");
        return {first, count};
    }

    void read_stage() {
        switch (spvc_compiler_get_execution_model(compiler_)) {
            case SpvExecutionModelVertex:
                result_.stage = VK_SHADER_STAGE_VERTEX_BIT;
                break;
            case SpvExecutionModelFragment:
                result_.stage = VK_SHADER_STAGE_FRAGMENT_BIT;
                break;
            case SpvExecutionModelGLCompute:
                result_.stage = VK_SHADER_STAGE_COMPUTE_BIT;
                for (unsigned i = 0; i < 3; ++i)
                    result_.local_size[i] = spvc_compiler_get_execution_mode_argument_by_index(
                        compiler_, SpvExecutionModeLocalSize, i);
                if (!result_.local_size[0]) fail("give the local size as numbers");
                break;
            default:
                fail("only vertex, fragment and compute shaders run here");
        }
    }

    Binding& add_binding(const spvc_reflected_resource& resource, BindingKind kind) {
        Binding binding{.name = resource.name, .kind = kind};
        const bool found = spvc_compiler_get_binary_offset_for_decoration(
                               compiler_, resource.id, SpvDecorationBinding, &binding.binding_word) &&
                           spvc_compiler_get_binary_offset_for_decoration(
                               compiler_, resource.id, SpvDecorationDescriptorSet, &binding.set_word);
        if (!found) fail("'" + binding.name + "' has no binding; compile with glslc -fauto-bind-uniforms");
        if (spvc_type_get_num_array_dimensions(spvc_compiler_get_type_handle(compiler_, resource.type_id)))
            fail("'" + binding.name + "' is an array of bindings, which are bound by name one by one");
        return result_.bindings.emplace_back(std::move(binding));
    }

    TextureShape shape(spvc_type_id id) {
        const spvc_type type = spvc_compiler_get_type_handle(compiler_, id);
        if (spvc_type_get_image_arrayed(type)) return TextureShape::other;
        const bool multisampled = spvc_type_get_image_multisampled(type);
        switch (spvc_type_get_image_dimension(type)) {
            case SpvDim2D:
                return multisampled ? TextureShape::plane_multisampled : TextureShape::plane;
            case SpvDimCube:
                return TextureShape::cube;
            default:
                return TextureShape::other;
        }
    }

    std::string_view texel_format(spvc_type_id id) {
        constexpr std::pair<SpvImageFormat, std::string_view> kNames[] = {
            {SpvImageFormatUnknown, ""},    {SpvImageFormatR8, "r8"},
            {SpvImageFormatRgba8, "rgba8"}, {SpvImageFormatR16f, "r16f"},
            {SpvImageFormatRg16f, "rg16f"}, {SpvImageFormatRgba16f, "rgba16f"},
            {SpvImageFormatR32f, "r32f"},   {SpvImageFormatRgba32f, "rgba32f"}};
        const SpvImageFormat format =
            spvc_type_get_image_storage_format(spvc_compiler_get_type_handle(compiler_, id));
        for (const auto& [known, name] : kNames)
            if (known == format) return name;
        return "another format";
    }

    void read_bindings() {
        for (const auto& resource : list(SPVC_RESOURCE_TYPE_SEPARATE_IMAGE))
            add_binding(resource, BindingKind::texture).shape = shape(resource.type_id);
        for (const auto& resource : list(SPVC_RESOURCE_TYPE_STORAGE_IMAGE)) {
            Binding& binding = add_binding(resource, BindingKind::storage_image);
            binding.shape = shape(resource.type_id);
            binding.texel_format = texel_format(resource.type_id);
        }
        for (const auto& resource : list(SPVC_RESOURCE_TYPE_SEPARATE_SAMPLERS))
            add_binding(resource, BindingKind::sampler);
        for (const auto& resource : list(SPVC_RESOURCE_TYPE_SAMPLED_IMAGE))
            add_binding(resource, BindingKind::sampled_texture).shape = shape(resource.type_id);
        for (const auto& resource : list(SPVC_RESOURCE_TYPE_UNIFORM_BUFFER))
            add_binding(resource, BindingKind::uniform_block).block = read_block(resource);
        for (const auto& resource : list(SPVC_RESOURCE_TYPE_STORAGE_BUFFER)) {
            Binding& binding = add_binding(resource, BindingKind::storage_buffer);
            binding.block = read_runtime_array(resource);
            binding.writable = !is_read_only(resource);
            if (binding.writable && result_.stage != VK_SHADER_STAGE_COMPUTE_BIT)
                fail("storage buffer '" + binding.name + "' must be declared readonly");
        }
    }

    void read_push_constants() {
        for (const auto& resource : list(SPVC_RESOURCE_TYPE_PUSH_CONSTANT))
            result_.push_constants = read_block(resource);
    }

    BlockLayout read_block(const spvc_reflected_resource& resource) {
        const spvc_type type = spvc_compiler_get_type_handle(compiler_, resource.base_type_id);
        size_t size = 0;
        if (spvc_compiler_get_declared_struct_size(compiler_, type, &size) != SPVC_SUCCESS)
            fail("block '" + std::string(resource.name) + "' has no fixed size");
        BlockLayout block = read_members(resource.base_type_id, resource.name);
        block.size = uint32_t(size);
        return block;
    }

    // buffer Lights { Light lights[]; }: the layout of one Light, size is the stride. An array of plain
    // values has one member with the array's name.
    BlockLayout read_runtime_array(const spvc_reflected_resource& resource) {
        const std::string name = resource.name;
        const spvc_type block = spvc_compiler_get_type_handle(compiler_, resource.base_type_id);
        const spvc_type_id member_id = spvc_type_get_member_type(block, 0);
        const spvc_type member = spvc_compiler_get_type_handle(compiler_, member_id);
        unsigned offset = 0, stride = 0;
        if (spvc_type_get_num_member_types(block) != 1 || !spvc_type_get_num_array_dimensions(member) ||
            spvc_compiler_type_struct_member_offset(compiler_, block, 0, &offset) != SPVC_SUCCESS ||
            spvc_compiler_type_struct_member_array_stride(compiler_, block, 0, &stride) != SPVC_SUCCESS) {
            fail("storage buffer '" + name + "' must hold one array without a size and nothing else");
            return {};
        }
        BlockLayout layout;
        if (spvc_type_get_basetype(member) == SPVC_BASETYPE_STRUCT)
            layout = read_members(spvc_type_get_base_type_id(member), name);
        else if (const auto type = value_type(member))
            layout.members.push_back(
                {spvc_compiler_get_member_name(compiler_, resource.base_type_id, 0), *type, 0});
        else
            fail("storage buffer '" + name + "' has elements of a type that cannot be set by name");
        layout.size = stride;
        return layout;
    }

    bool is_read_only(const spvc_reflected_resource& resource) {
        const SpvDecoration* decorations = nullptr;
        size_t count = 0;
        spvc_compiler_get_buffer_block_decorations(compiler_, resource.id, &decorations, &count);
        for (size_t i = 0; i < count; ++i)
            if (decorations[i] == SpvDecorationNonWritable) return true;
        return false;
    }

    BlockLayout read_members(spvc_type_id struct_id, const std::string& block_name) {
        BlockLayout layout;
        const spvc_type type = spvc_compiler_get_type_handle(compiler_, struct_id);
        for (unsigned i = 0; i < spvc_type_get_num_member_types(type); ++i) {
            const std::string name = spvc_compiler_get_member_name(compiler_, struct_id, i);
            const spvc_type member =
                spvc_compiler_get_type_handle(compiler_, spvc_type_get_member_type(type, i));
            unsigned offset = 0;
            spvc_compiler_type_struct_member_offset(compiler_, type, i, &offset);
            if (spvc_type_get_basetype(member) == SPVC_BASETYPE_STRUCT &&
                !spvc_type_get_num_array_dimensions(member)) {
                const BlockLayout structure = read_members(spvc_type_get_base_type_id(member), block_name);
                for (const BlockMember& inner : structure.members)
                    layout.members.push_back({name + "." + inner.name, inner.type, offset + inner.offset});
                continue;
            }
            const std::optional<ValueType> value = value_type(member);
            if (!value || spvc_type_get_num_array_dimensions(member) > 1) {
                fail("member '" + name + "' of '" + block_name +
                     "' has a type that cannot be set by name; int, uint, float, vec2, vec3, vec4, mat4, "
                     "arrays of them and structures of these can");
                continue;
            }
            add_member(layout, type, i, {name, *value, offset});
        }
        return layout;
    }

    void add_member(BlockLayout& layout, spvc_type type, unsigned index, const BlockMember& member) {
        const spvc_type member_type =
            spvc_compiler_get_type_handle(compiler_, spvc_type_get_member_type(type, index));
        if (!spvc_type_get_num_array_dimensions(member_type)) return layout.members.push_back(member);
        unsigned stride = 0;
        spvc_compiler_type_struct_member_array_stride(compiler_, type, index, &stride);
        if (!spvc_type_array_dimension_is_literal(member_type, 0) ||
            !spvc_type_get_array_dimension(member_type, 0))
            return fail("array '" + member.name + "' needs a fixed size");
        for (unsigned i = 0; i < spvc_type_get_array_dimension(member_type, 0); ++i)
            layout.members.push_back(
                {fmt::format("{}[{}]", member.name, i), member.type, member.offset + i * stride});
    }

    static std::optional<ValueType> value_type(spvc_type type) {
        const unsigned rows = spvc_type_get_vector_size(type), columns = spvc_type_get_columns(type);
        const spvc_basetype base = spvc_type_get_basetype(type);
        if (rows == 1 && columns == 1 && base == SPVC_BASETYPE_INT32) return ValueType::int32;
        if (rows == 1 && columns == 1 && base == SPVC_BASETYPE_UINT32) return ValueType::uint32;
        if (base != SPVC_BASETYPE_FP32) return std::nullopt;
        if (rows == 4 && columns == 4) return ValueType::mat4;
        if (columns != 1) return std::nullopt;
        return ValueType(int(ValueType::number) + int(rows) - 1);
    }

    void read_interface_variables() {
        result_.inputs = variables(SPVC_RESOURCE_TYPE_STAGE_INPUT);
        result_.outputs = variables(SPVC_RESOURCE_TYPE_STAGE_OUTPUT);
    }

    // Vertex inputs come from float streams; variables between stages may have any type.
    std::vector<StageVariable> variables(spvc_resource_type kind) {
        const bool from_streams =
            kind == SPVC_RESOURCE_TYPE_STAGE_INPUT && result_.stage == VK_SHADER_STAGE_VERTEX_BIT;
        std::vector<StageVariable> variables;
        for (const auto& resource : list(kind)) {
            const spvc_type type = spvc_compiler_get_type_handle(compiler_, resource.type_id);
            const bool floats =
                spvc_type_get_basetype(type) == SPVC_BASETYPE_FP32 && spvc_type_get_columns(type) == 1;
            if (from_streams && !floats)
                fail("vertex input '" + std::string(resource.name) + "' must be float or a vector of floats");
            variables.push_back({resource.name, location(resource), int(spvc_type_get_vector_size(type))});
        }
        return variables;
    }

    uint32_t location(const spvc_reflected_resource& resource) {
        return spvc_compiler_get_decoration(compiler_, resource.id, SpvDecorationLocation);
    }

    void read_constants() {
        const spvc_specialization_constant* first = nullptr;
        size_t count = 0;
        if (spvc_compiler_get_specialization_constants(compiler_, &first, &count) != SPVC_SUCCESS)
            return fail("SPIR-V that cannot be reflected");
        for (const spvc_specialization_constant& one : std::span(first, count)) {
            const spvc_constant constant = spvc_compiler_get_constant_handle(compiler_, one.id);
            result_.constants.push_back({spvc_compiler_get_name(compiler_, one.id), one.constant_id,
                                         spvc_constant_get_scalar_u32(constant, 0, 0)});
        }
    }

    std::string shader_;
    spvc_compiler compiler_;
    spvc_resources resources_;
    ShaderInterface result_;
    std::optional<Error> error_;
};

}  // namespace

std::string_view type_name(ValueType type) {
    static constexpr std::string_view kNames[] = {"int", "uint", "float", "vec2", "vec3", "vec4", "mat4"};
    return kNames[size_t(type)];
}

Result<ShaderInterface> reflect(std::string_view shader, std::span<const uint32_t> words) {
    spvc_context context = nullptr;
    if (spvc_context_create(&context) != SPVC_SUCCESS) return Error{"out of memory for shader reflection"};
    const std::unique_ptr<spvc_context_s, void (*)(spvc_context)> owner(context, spvc_context_destroy);
    spvc_parsed_ir ir = nullptr;
    spvc_compiler compiler = nullptr;
    spvc_resources resources = nullptr;
    const bool ok =
        spvc_context_parse_spirv(context, words.data(), words.size(), &ir) == SPVC_SUCCESS &&
        spvc_context_create_compiler(context, SPVC_BACKEND_NONE, ir, SPVC_CAPTURE_MODE_TAKE_OWNERSHIP,
                                     &compiler) == SPVC_SUCCESS &&
        spvc_compiler_create_shader_resources(compiler, &resources) == SPVC_SUCCESS;
    if (!ok)
        return Error{"shader '" + std::string(shader) + "': no valid SPIR-V (" +
                     spvc_context_get_last_error_string(context) + ")"};
    return Reflector(shader, compiler, resources).run();
}

}  // namespace dermis::gpu
