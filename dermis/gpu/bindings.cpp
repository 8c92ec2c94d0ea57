// Names to descriptors: a draw's own maps first, then the pass's reads, then what the frame supplies.

#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "dermis/base/text.h"
#include "dermis/gpu/executor_state.h"
#include "dermis/gpu/plan.h"

namespace dermis::gpu {
namespace {

// Finds a value by member name; null when nothing supplies it.
using ValueLookup = std::function<const ShaderValue*(std::string_view member)>;

ValueType type_of(const ShaderValue& value) {
    constexpr ValueType kTypes[] = {ValueType::int32, ValueType::number, ValueType::vec2,
                                    ValueType::vec3,  ValueType::vec4,   ValueType::mat4};
    return kTypes[value.index()];
}

bool fits(ValueType value, ValueType member) {
    return value == member || (value == ValueType::int32 && member == ValueType::uint32);
}

Result<void> write_block(const BlockLayout& layout, const ValueLookup& find, const std::string& where,
                         std::span<std::byte> bytes) {
    for (const BlockMember& member : layout.members) {
        const ShaderValue* value = find(member.name);
        if (!value)
            return Error{fmt::format("{}: nothing supplies member '{}' ({})", where, member.name,
                                     type_name(member.type))};
        if (!fits(type_of(*value), member.type))
            return Error{fmt::format("{}: member '{}' is {} in the shader, but its value is {}", where,
                                     member.name, type_name(member.type), type_name(type_of(*value)))};
        std::visit([&](const auto& v) { std::memcpy(bytes.data() + member.offset, &v, sizeof v); }, *value);
    }
    return {};
}

ValueLookup lookup_in(const Values& values) {
    return [&values](std::string_view member) -> const ShaderValue* {
        const auto found = values.find(member);
        return found == values.end() ? nullptr : &found->second;
    };
}

std::string binding_label(const Pass& pass, std::string_view kind, const Binding& binding) {
    return fmt::format("{}: {} '{}'", pass_label(pass), kind, binding.name);
}

template <class Map>
const typename Map::mapped_type* find_in(const Map& map, std::string_view name) {
    const auto found = map.find(name);
    return found == map.end() ? nullptr : &found->second;
}

TextureShape shape_of(const ImageInfo& info) {
    if (info.cube) return TextureShape::cube;
    if (info.layers > 1) return TextureShape::other;
    return info.samples > 1 ? TextureShape::plane_multisampled : TextureShape::plane;
}

std::string_view shape_name(TextureShape shape) {
    constexpr std::string_view kNames[] = {"texture2D", "textureCube", "texture2DMS", "an array texture"};
    return kNames[size_t(shape)];
}

void add_access(std::vector<ImageAccess>& accesses, const ImageAccess& access) {
    const bool known = std::ranges::any_of(accesses, [&](const ImageAccess& one) {
        return one.image == access.image && one.use == access.use && one.first_mip == access.first_mip;
    });
    if (!known) accesses.push_back(access);
}

}  // namespace

std::string pass_label(const Pass& pass) {
    std::string label = "pass '" + pass.name + "'";
    if (!pass.shader.empty()) label += " (shader '" + pass.shader + "')";
    return label;
}

Error BindingResolver::missing(const Pass& pass, const Binding& binding, std::string_view what,
                               const Draw* draw) const {
    std::string message = binding_label(pass, what, binding);
    if (draw) message += " for geometry '" + draw->geometry->state().name + "'";
    message += ": nothing supplies it";
    if (context_.list.find_image(binding.name))
        return Error{message + "; it is an image of the list, so add it to the pass's reads"};
    std::vector<std::string> names;
    for (const ImageRead& read : pass.reads) names.push_back(read.texture);
    for (const auto& [name, texture] : context_.inputs.textures) names.push_back(name);
    for (const auto& [name, block] : context_.inputs.blocks) names.push_back(name);
    for (const auto& [name, array] : context_.inputs.arrays) names.push_back(name);
    if (const auto close = closest_name(binding.name, names)) message += "; did you mean '" + *close + "'?";
    return Error{message};
}

Result<BindingResolver::Found> BindingResolver::find_texture(const Pass& pass, const Binding& binding,
                                                             const Draw* draw) const {
    const auto of_texture = [](const Texture& texture) {
        const DeviceImage& image = texture.state().image;
        return Found{image.view.get(), shape_of(image.info), nullptr, texture.state().sampler};
    };
    if (draw)
        if (const auto* texture = find_in(draw->textures, binding.name); texture && *texture)
            return of_texture(**texture);
    const auto read = std::ranges::find(pass.reads, binding.name, &ImageRead::texture);
    const std::string& source = read == pass.reads.end() ? binding.name : read->image;
    if (read != pass.reads.end())
        if (FrameImage* image = context_.images.find(source))
            return Found{image->image.view.get(), shape_of(image->image.info), image};
    if (const auto* texture = find_in(context_.inputs.textures, source); texture && *texture)
        return of_texture(**texture);
    if (const ForeignImage* foreign = find_in(context_.inputs.images, source))
        if (FrameImage* image = foreign->executor->state().images.find(foreign->name))
            return Found{image->image.view.get(), shape_of(image->image.info), image};
    return missing(pass, binding, "texture", draw);
}

// Pushed like everything else: immutable samplers in a push-descriptor layout are ignored by lavapipe
// (Mesa 22.3), which then samples without filter or comparison.
Result<Descriptor> BindingResolver::sampler(const Pass& pass, const Binding& binding) const {
    const auto named = std::ranges::find(kSamplerNames, binding.name);
    if (named == kSamplerNames.end()) {
        const std::vector<std::string> names(kSamplerNames.begin(), kSamplerNames.end());
        return Error{pass_label(pass) + ": " + unknown_name("sampler", binding.name, names)};
    }
    Descriptor descriptor{.type = VK_DESCRIPTOR_TYPE_SAMPLER};
    descriptor.image.sampler = context_.device.samplers[size_t(named - kSamplerNames.begin())].get();
    return descriptor;
}

Result<Descriptor> BindingResolver::texture(PlannedPass& planned, const Binding& binding, const Draw* draw) {
    DERMIS_TRY_ASSIGN(const Found found, find_texture(*planned.pass, binding, draw));
    if (found.shape != binding.shape)
        return Error{fmt::format("{} is {} in the shader, but what is bound to it is {}",
                                 binding_label(*planned.pass, "texture", binding), shape_name(binding.shape),
                                 shape_name(found.shape))};
    const bool has_sampler = binding.kind == BindingKind::sampled_texture;
    if (has_sampler && !found.sampler)
        return Error{binding_label(*planned.pass, "texture", binding) +
                     " is a sampler2D in the shader, but an image of a pass has no sampler; declare it as "
                     "texture2D and use one of the named samplers"};
    const std::optional<DepthTarget>& depth = planned.pass->depth;
    const bool tested = found.image && depth && depth->image == found.image->declaration.name;
    const ImageUse use = tested ? ImageUse::depth_test : ImageUse::sampled;
    if (found.image)
        add_access(planned.accesses,
                   {.image = found.image, .mips = found.image->image.info.mips, .use = use});
    Descriptor descriptor{.type = has_sampler ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                                              : VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE};
    descriptor.image = {has_sampler ? found.sampler : VK_NULL_HANDLE, found.view, use_scope(use).layout};
    return descriptor;
}

Result<Descriptor> BindingResolver::storage_image(PlannedPass& planned, const Binding& binding) {
    const Pass& pass = *planned.pass;
    const auto named = std::ranges::find(pass.storage, binding.name, &ImageRead::texture);
    if (named == pass.storage.end())
        return Error{binding_label(pass, "storage image", binding) + " is not in the pass's storage"};
    FrameImage* image = context_.images.find(named->image);
    if (binding.shape != TextureShape::plane || image->declaration.samples > 1)
        return Error{binding_label(pass, "storage image", binding) + " must be an image2D with one sample"};
    if (binding.texel_format != format_name(image->declaration.format))
        return Error{fmt::format("{} must be declared layout({}), the format of image '{}'",
                                 binding_label(pass, "storage image", binding),
                                 format_name(image->declaration.format), named->image)};
    Descriptor descriptor{.type = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE};
    descriptor.image = {VK_NULL_HANDLE, image->mip_views[0].get(), VK_IMAGE_LAYOUT_GENERAL};
    return descriptor;
}

size_t BindingResolver::reserve(size_t bytes) {
    const VkPhysicalDeviceLimits& limits = context_.device.context.properties.limits;
    const size_t alignment = std::max<size_t>(
        {16, limits.minUniformBufferOffsetAlignment, limits.minStorageBufferOffsetAlignment});
    const size_t offset = (plan_.uploads.size() + alignment - 1) / alignment * alignment;
    plan_.uploads.resize(offset + bytes);
    return offset;
}

BufferPlace BindingResolver::place(const GeometryData& data) {
    if (data.buffer.handle) return {.buffer = data.buffer.handle.get()};
    const auto [found, is_new] = streamed_.try_emplace(&data, 0);
    if (is_new) {
        found->second = reserve(data.bytes.size());
        std::ranges::copy(data.bytes, plan_.uploads.begin() + std::ptrdiff_t(found->second));
    }
    return {.offset = found->second};
}

const BindingResolver::KnownBlock* BindingResolver::known(const std::string& name, const Binding& binding,
                                                          const Draw* draw) const {
    const auto found = std::ranges::find_if(known_, [&](const KnownBlock& one) {
        return one.draw == draw && one.name == name && *one.layout == binding.block;
    });
    return found == known_.end() ? nullptr : &*found;
}

Result<Descriptor> BindingResolver::uniform_block(const Pass& pass, const Binding& binding,
                                                  const Draw* draw) {
    const Draw* owner = draw && binding.name == "Material" ? draw : nullptr;
    const std::string own = profile_name(binding.name, pass.profile);
    const std::string& name = find_in(context_.inputs.blocks, own) ? own : binding.name;
    Descriptor descriptor{.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};
    if (const KnownBlock* same = known(name, binding, owner)) {
        descriptor.offset = same->offset, descriptor.size = same->size;
        return descriptor;
    }
    const Values* values = owner ? &owner->values : find_in(context_.inputs.blocks, name);
    if (!values) return missing(pass, binding, "uniform block", draw);
    // Rounded up: drivers may read whole 16-byte rows.
    descriptor.size = (binding.block.size + 15) / 16 * 16;
    descriptor.offset = reserve(descriptor.size);
    DERMIS_TRY(write_block(binding.block, lookup_in(*values), binding_label(pass, "uniform block", binding),
                           std::span(plan_.uploads).subspan(descriptor.offset, descriptor.size)));
    known_.push_back({name, owner, &binding.block, descriptor.offset, descriptor.size});
    return descriptor;
}

// A stream is read and written where it is, an array that goes along with the frame in the uploads.
Result<Descriptor> BindingResolver::buffer_of_pass(const Pass& pass, const Binding& binding,
                                                   const std::string& input) {
    const std::string label = binding_label(pass, "storage buffer", binding);
    const BufferInput* found = find_in(context_.inputs.buffers, input);
    if (!found) return Error{label + ": nothing supplies the buffer '" + input + "'"};
    const GeometryData* data = found->array ? &found->array->state().data : nullptr;
    if (found->geometry)
        if (const auto* stream = find_in(found->geometry->state().streams, found->stream))
            data = &stream->data;
    if (!data) return Error{label + ": the geometry lacks the stream '" + found->stream + "'"};
    if (binding.writable && !data->buffer.handle)
        return Error{label + " is written, but its buffer goes along with the frame; declare it readonly"};
    const BufferPlace at = place(*data);
    return Descriptor{.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
                      .buffer = at.buffer,
                      .offset = at.offset,
                      .size = at.buffer ? data->buffer.size : data->bytes.size()};
}

Result<Descriptor> BindingResolver::storage_buffer(const Pass& pass, const Binding& binding) {
    const auto of_pass = std::ranges::find(pass.buffers, binding.name, &ImageRead::texture);
    if (of_pass != pass.buffers.end()) return buffer_of_pass(pass, binding, of_pass->image);
    if (binding.writable)
        return Error{binding_label(pass, "storage buffer", binding) +
                     " must be declared readonly, or be one of the pass's buffers"};
    Descriptor descriptor{.type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
    if (const KnownBlock* same = known(binding.name, binding, nullptr)) {
        descriptor.offset = same->offset, descriptor.size = same->size;
        return descriptor;
    }
    const std::vector<Values>* elements = find_in(context_.inputs.arrays, binding.name);
    if (!elements) return missing(pass, binding, "storage buffer", nullptr);
    const size_t stride = binding.block.size;
    descriptor.size = std::max<size_t>(1, elements->size()) * stride;  // no buffer has size 0
    descriptor.offset = reserve(descriptor.size);
    for (size_t i = 0; i < elements->size(); ++i) {
        DERMIS_TRY(
            write_block(binding.block, lookup_in((*elements)[i]),
                        fmt::format("{} element {}", binding_label(pass, "storage buffer", binding), i),
                        std::span(plan_.uploads).subspan(descriptor.offset + i * stride, stride)));
    }
    known_.push_back({binding.name, nullptr, &binding.block, descriptor.offset, descriptor.size});
    return descriptor;
}

Result<Descriptor> BindingResolver::resolve_one(PlannedPass& planned, const Binding& binding,
                                                const Draw* draw) {
    switch (binding.kind) {
        case BindingKind::texture:
        case BindingKind::sampled_texture:
            return texture(planned, binding, draw);
        case BindingKind::storage_image:
            return storage_image(planned, binding);
        case BindingKind::sampler:
            return sampler(*planned.pass, binding);
        case BindingKind::uniform_block:
            return uniform_block(*planned.pass, binding, draw);
        case BindingKind::storage_buffer:
            return storage_buffer(*planned.pass, binding);
    }
    return Error{"unknown kind of binding"};
}

Result<void> BindingResolver::resolve(PlannedPass& planned, PlannedDraw& target, const Draw* draw) {
    const std::vector<Binding>& bindings = planned.pipeline->bindings;
    for (size_t i = 0; i < bindings.size(); ++i) {
        const Binding& binding = bindings[i];
        DERMIS_TRY_ASSIGN(Descriptor descriptor, resolve_one(planned, binding, draw));
        descriptor.binding = uint32_t(i);
        target.descriptors.push_back(descriptor);
    }
    return {};
}

Result<void> BindingResolver::push_constants(PlannedPass& planned) {
    const BlockLayout& layout = planned.pipeline->push_constants;
    if (!planned.pipeline->push_stages) return {};
    planned.push_constants.resize((layout.size + 3) & ~3u);
    const auto find = [&](std::string_view member) -> const ShaderValue* {
        const auto& values = planned.pass->values;
        const auto found = std::ranges::find(values, member, &NamedValue::first);
        return found == values.end() ? nullptr : &found->second;
    };
    return write_block(layout, find, pass_label(*planned.pass) + ": push constants", planned.push_constants);
}

}  // namespace dermis::gpu
