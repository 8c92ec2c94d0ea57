#include "dermis/gpu/executor_state.h"

#include <algorithm>
#include <cstring>

#include "dermis/base/text.h"
#include "dermis/gpu/recorder.h"

namespace dermis::gpu {

// Each frame is waited for, so one buffer serves all frames; it grows and never shrinks.
Result<void> Executor::State::store(const std::vector<std::byte>& bytes) {
    if (bytes.size() > uploads.size) {
        constexpr VkBufferUsageFlags kUsage =
            VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        Result<Buffer> larger =
            make_buffer(device.context, "frame blocks", bytes.size() * 3 / 2, kUsage, MemoryUse::upload);
        if (!larger) return larger.error();
        uploads = std::move(*larger);
    }
    if (!bytes.empty()) std::memcpy(uploads.mapped, bytes.data(), bytes.size());
    return {};
}

namespace {

std::vector<std::string> supplied_names(const FrameInputs& inputs) {
    std::vector<std::string> names;
    for (const auto& [name, texture] : inputs.textures) names.push_back(name);
    for (const auto& [name, image] : inputs.images) names.push_back(name);
    for (const Draw& draw : inputs.draws)
        for (const auto& [name, texture] : draw.textures) names.push_back(name);
    return names;
}

Result<void> check_frame(const PassList& list, const FrameInputs& inputs, const Context& context) {
    const int limit = int(context.properties.limits.maxImageDimension2D);
    if (inputs.width < 1 || inputs.height < 1 || inputs.width > limit || inputs.height > limit)
        return Error{"frame size " + std::to_string(inputs.width) + "x" + std::to_string(inputs.height) +
                     "; each side must be 1 to " + std::to_string(limit)};
    const std::vector<std::string> wrong = problems(list, supplied_names(inputs));
    if (!wrong.empty()) return Error{"pass list: " + join(wrong, "; ")};
    return {};
}

}  // namespace

Result<Executor> Executor::create(Device& device, ShaderSource shaders) {
    return Executor(std::make_unique<State>(device.state(), std::move(shaders)));
}

Result<FrameResult> Executor::run(const PassList& list, const FrameInputs& inputs) {
    State& state = *state_;
    const Context& context = state.device.context;
    if (Result<void> ok = check_frame(list, inputs, context); !ok) return ok.error();
    state.pipelines.begin_run();
    if (Result<void> ok = state.images.prepare(list, inputs.width, inputs.height); !ok) return ok.error();
    const Result<Plan> plan =
        make_plan({state.device, list, inputs, state.images, state.shaders, state.pipelines});
    if (!plan) return plan.error();
    if (Result<void> ok = state.store(plan->uploads); !ok) return ok.error();
    if (Result<void> ok = state.queries.prepare(context, plan->passes.size()); !ok) return ok.error();
    const Result<void> done = run_once(state.device, "the frame", [&](VkCommandBuffer commands) {
        record_plan(context, commands, *plan, state.uploads.handle.get(), state.queries);
    });
    if (!done) return done.error();
    return state.queries.collect(context, *plan);
}

Result<Image> Executor::read(std::string_view name, int mip) {
    FrameImage* source = state_->images.find(name);
    if (!source) return Error{unknown_name("image", name, state_->images.names())};
    return read_image(state_->device, *source, mip);
}

void Executor::forget_shaders() {
    state_->shaders.forget();
    state_->pipelines.clear();
}

Footprint Executor::footprint() const {
    return {.images = state_->images.count(),
            .pipelines = state_->pipelines.size(),
            .image_bytes = state_->images.bytes()};
}

Executor::Executor(std::unique_ptr<State> state) : state_(std::move(state)) {}
Executor::~Executor() = default;
Executor::Executor(Executor&&) noexcept = default;
Executor& Executor::operator=(Executor&&) noexcept = default;

}  // namespace dermis::gpu
