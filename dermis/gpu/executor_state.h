#pragma once
// What is behind the handle Executor.

#include "dermis/gpu/executor.h"
#include "dermis/gpu/queries.h"

namespace dermis::gpu {

struct Executor::State {
    State(Device::State& device_state, ShaderSource source)
        : device(device_state), shaders(std::move(source)), images(device_state), pipelines(device_state) {}

    Device::State& device;
    ShaderLibrary shaders;
    FrameImages images;
    PipelineStore pipelines;
    FrameQueries queries;
    Buffer uploads;

    Result<void> store(const std::vector<std::byte>& bytes);
};

}  // namespace dermis::gpu
