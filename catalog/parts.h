#pragma once
// What the build generates: lists of the folders of techniques/ and subjects/, and of all shaders.

#include "dermis/render/catalog.h"

namespace dermis {

[[nodiscard]] std::span<const Technique> built_in_techniques();
[[nodiscard]] std::span<const Subject> built_in_subjects();
[[nodiscard]] std::span<const gpu::EmbeddedShader> built_in_shaders();

}  // namespace dermis
