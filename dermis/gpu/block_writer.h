#pragma once
// Named values into the bytes of a shader's block.

#include <cstddef>

#include "dermis/gpu/executor.h"
#include "dermis/gpu/reflection.h"

namespace dermis::gpu {

/// Finds a value by member name; null when nothing supplies it.
using ValueLookup = std::function<const ShaderValue*(std::string_view member)>;

/// Fills bytes (at least layout.size). Errors name the member and, for a wrong type, both types; `where` says
/// pass, shader and block.
[[nodiscard]] Result<void> write_block(const BlockLayout& layout, const ValueLookup& find,
                                       const std::string& where, std::span<std::byte> bytes);

[[nodiscard]] ValueLookup lookup_in(const Values& values);

}  // namespace dermis::gpu
