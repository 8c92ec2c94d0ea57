#include "dermis/gpu/block_writer.h"

#include <cstring>

namespace dermis::gpu {
namespace {

ValueType type_of(const ShaderValue& value) {
    constexpr ValueType kTypes[] = {ValueType::int32, ValueType::number, ValueType::vec2,
                                    ValueType::vec3,  ValueType::vec4,   ValueType::mat4};
    return kTypes[value.index()];
}

bool fits(ValueType value, ValueType member) {
    return value == member || (value == ValueType::int32 && member == ValueType::uint32);
}

}  // namespace

Result<void> write_block(const BlockLayout& layout, const ValueLookup& find, const std::string& where,
                         std::span<std::byte> bytes) {
    for (const BlockMember& member : layout.members) {
        const ShaderValue* value = find(member.name);
        if (!value)
            return Error{where + ": nothing supplies member '" + member.name + "' (" +
                         std::string(type_name(member.type)) + ")"};
        if (!fits(type_of(*value), member.type))
            return Error{where + ": member '" + member.name + "' is " + std::string(type_name(member.type)) +
                         " in the shader, but its value is " + std::string(type_name(type_of(*value)))};
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

}  // namespace dermis::gpu
