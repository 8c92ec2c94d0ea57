#pragma once
// From a pass to its pipeline: shaders by name, formats by declaration. The executor draws with it; the
// statistics (statistics.h) compile the same one for another chip.

#include "dermis/gpu/pipeline.h"

namespace dermis::gpu {

/// The vertex shader that a pass names, or the shared one of its kind.
[[nodiscard]] std::string_view vertex_shader_name(const Pass& pass);

/// By the declarations of the pass' targets. `list` has no problems() (pass_list.h).
[[nodiscard]] TargetFormats target_formats(const PassList& list, const Pass& pass);

/// Null: a transfer, or a pass that only clears. Errors name the pass.
[[nodiscard]] Result<const Pipeline*> pass_pipeline(const PassList& list, const Pass& pass,
                                                    ShaderLibrary& shaders, PipelineStore& pipelines);

}  // namespace dermis::gpu
