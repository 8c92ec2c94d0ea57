#include "dermis/gpu/executor_state.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstring>

#include "dermis/base/text.h"
#include "dermis/gpu/recorder.h"

namespace dermis::gpu {

Result<void> FrameSlot::store(const Context& context, const std::vector<std::byte>& bytes) {
    if (bytes.size() > uploads.size) {
        constexpr VkBufferUsageFlags kUsage =
            VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
            VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
        // A frame of a scene has a few kB, an interface with all its panels some hundred.
        constexpr size_t kSmallest = 256 << 10;
        DERMIS_TRY_ASSIGN(
            uploads, make_buffer(context, "frame blocks", std::max(bytes.size() * 3 / 2, kSmallest), kUsage,
                                 MemoryUse::upload));
    }
    if (!bytes.empty()) std::memcpy(uploads.mapped, bytes.data(), bytes.size());
    return {};
}

namespace {

// Results that are kept if nobody asks for them.
constexpr size_t kResultsKept = 8;

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
        return Error{
            fmt::format("frame size {}x{}; each side must be 1 to {}", inputs.width, inputs.height, limit)};
    const std::vector<std::string> wrong = problems(list, supplied_names(inputs));
    if (!wrong.empty()) return Error{"pass list: " + join(wrong, "; ")};
    return {};
}

}  // namespace

Result<Executor> Executor::create(Device& device, ShaderSource shaders) {
    auto state = std::make_unique<State>(device.state(), std::move(shaders));
    if (!state->device.context.keep_statistics)
        for (size_t i = 0; i < kFramesInFlight; ++i) {
            DERMIS_TRY_ASSIGN(ReusedCommands commands, ReusedCommands::create(state->device.context));
            state->slots.push_back({.commands = std::move(commands)});
        }
    return Executor(std::move(state));
}

Result<uint64_t> Executor::State::submit(const PassList& list, const FrameInputs& inputs) {
    const Context& context = device.context;
    DERMIS_TRY(check_frame(list, inputs, context));
    pipelines.begin_run();
    DERMIS_TRY(images.prepare(list, inputs.width, inputs.height));
    DERMIS_TRY_ASSIGN(Plan plan, make_plan({device, list, inputs, images, shaders, pipelines}));
    FrameSlot& slot = slots[(frames + 1) % slots.size()];
    DERMIS_TRY(collect(slot));
    DERMIS_TRY(slot.store(context, plan.uploads));
    DERMIS_TRY(slot.descriptors.prepare(context, plan, slot.uploads.handle.get()));
    DERMIS_TRY(slot.queries.prepare(context, plan));
    DERMIS_TRY(slot.commands.run(device, "the frame", [&](VkCommandBuffer commands) {
        record_plan(context, commands, plan, slot.uploads.handle.get(), slot.queries);
    }));
    return slot.frame = ++frames;
}

Result<void> Executor::State::collect(FrameSlot& slot) {
    if (!slot.frame) return {};
    DERMIS_TRY(slot.commands.wait(device.context, "the frame"));
    DERMIS_TRY_ASSIGN(FrameResult result, slot.queries.collect(device.context));
    result.frame = std::exchange(slot.frame, 0);
    if (finished.size() == kResultsKept) finished.erase(finished.begin());
    finished.push_back(std::move(result));
    return {};
}

Result<FrameResult> Executor::run(const PassList& list, const FrameInputs& inputs) {
    DERMIS_TRY_ASSIGN(const uint64_t frame, state_->submit(list, inputs));
    for (uint64_t one = frame - std::min(frame, kFramesInFlight) + 1; one <= frame; ++one)
        DERMIS_TRY(state_->collect(state_->slots[one % kFramesInFlight]));
    FrameResult result = std::move(state_->finished.back());
    state_->finished.pop_back();
    return result;
}

Result<uint64_t> Executor::submit(const PassList& list, const FrameInputs& inputs) {
    return state_->submit(list, inputs);
}

Result<std::vector<FrameResult>> Executor::finished() {
    State& state = *state_;
    for (size_t i = 1; i <= state.slots.size(); ++i) {  // the slot of the next frame has the oldest
        FrameSlot& slot = state.slots[(state.frames + i) % state.slots.size()];
        if (!slot.commands.is_done(state.device.context)) break;
        DERMIS_TRY(state.collect(slot));
    }
    return std::exchange(state.finished, {});
}

Result<Image> Executor::read(std::string_view name, int mip) {
    FrameImage* source = state_->images.find(name);
    if (!source) return Error{unknown_name("image", name, state_->images.names())};
    return read_image(state_->device, *source, mip);
}

void Executor::forget_shaders() {
    state_->shaders.forget();
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
