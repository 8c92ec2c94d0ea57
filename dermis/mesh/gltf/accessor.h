#pragma once
// Accessors of a glTF file as plain arrays. Internal to dermis/mesh.

#include <cstdint>
#include <vector>

#include "dermis/mesh/gltf/document.h"

namespace dermis::inline mesh::gltf {

/// Elements of `components` (1 to 4, or 16) floats each; interleaved, normalised integer and sparse ones too.
/// Empty after an error.
[[nodiscard]] std::vector<float> read_floats(Document& document, uint64_t accessor, size_t components);

/// Replaces the largest number of an index type: glTF forbids it, since GPUs start a new primitive there.
inline constexpr uint32_t kRestart = ~0u;

/// Unsigned scalars of 8, 16 or 32 bits, with kRestart for the largest. Empty after an error.
[[nodiscard]] std::vector<uint32_t> read_indices(Document& document, uint64_t accessor);

}  // namespace dermis::inline mesh::gltf
