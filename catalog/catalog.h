#pragma once
// All that this repository has of techniques, subjects and shaders. For programs, tests and benchmarks; what
// lies in dermis/ gets it as an argument.

#include "dermis/render/catalog.h"
#include "dermis/shading/shading.h"

namespace dermis {

/// Made at the first call, by any thread.
[[nodiscard]] const Catalog& built_in_catalog();

/// shaders/include/skin/*.glsl as text, by path.
[[nodiscard]] std::span<const shading::Source> built_in_skin_sources();

}  // namespace dermis
