#pragma once
// The printed text, compiled by a compiler that is not ours and run on the samples.

#include "dermis/gpu/executor.h"
#include "shading/samples.h"

namespace dermis::shading {

/// Languages that run on the CPU: cpp, and msl over a header that has Metal's vectors and functions as C++.
[[nodiscard]] Result<Outputs> evaluate_on_cpu(const std::string& text, Language language,
                                              const std::vector<Sampled>& functions);

/// Languages that glslc compiles: glsl, essl, hlsl; gdshader is compiled as GLSL, whose words it uses.
[[nodiscard]] Result<Outputs> evaluate_on_gpu(gpu::Device& device, const std::string& text, Language language,
                                              const std::vector<Sampled>& functions);

/// How the error starts when the browser has no WebGPU or WebGL 2.
inline constexpr const char* kBrowserLacks = "not here: ";

/// wgsl and essl, by headless Chromium, for the first `side`² samples, which lie as random as all: a page for
/// as many functions as have 16 MiB of arguments together. With all samples it takes minutes.
[[nodiscard]] Result<Outputs> evaluate_in_browser(const std::string& chromium, const std::string& text,
                                                  Language language, const std::vector<Sampled>& functions,
                                                  size_t side);

}  // namespace dermis::shading
