#pragma once
// The state behind the handle Executor.

#include "dermis/gpu/executor.h"
#include "dermis/gpu/frame_descriptors.h"
#include "dermis/gpu/recorder.h"

namespace dermis::gpu {

/// State of one frame in flight. Images are shared: the queue runs frames in order, and barriers
/// reach from one to the next.
struct FrameSlot {
    ReusedCommands commands;
    FrameQueries queries;
    Buffer uploads;
    FrameDescriptors descriptors;
    uint64_t frame = 0;  ///< whose result is to be collected; 0: none

    /// Grows and never shrinks.
    [[nodiscard]] Result<void> store(const Context& context, const std::vector<std::byte>& bytes);
};

struct Executor::State {
    State(Device::State& device_state, ShaderSource source)
        : device(device_state), shaders(std::move(source)), images(device_state), pipelines(device_state) {}

    Device::State& device;
    ShaderLibrary shaders;
    FrameImages images;
    PipelineStore pipelines;
    std::vector<FrameSlot> slots;  ///< frame n has slot n modulo their number
    uint64_t frames = 0;
    std::vector<FrameResult> finished;

    [[nodiscard]] Result<uint64_t> submit(const PassList& list, const FrameInputs& inputs);
    /// Waits for the slot's frame and takes its result.
    [[nodiscard]] Result<void> collect(FrameSlot& slot);
};

}  // namespace dermis::gpu
