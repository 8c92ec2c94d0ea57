#pragma once
// The logical device with what is made once: samplers, the pipeline cache, the command pool of uploads.

#include <array>
#include <functional>
#include <map>
#include <memory>

#include "dermis/gpu/device.h"
#include "dermis/gpu/instance.h"
#include "dermis/gpu/memory.h"

namespace dermis::gpu {

/// The samplers a shader may name.
inline constexpr std::array<std::string_view, 4> kSamplerNames = {"linear_clamp", "nearest_clamp",
                                                                  "trilinear_clamp", "shadow_compare"};
inline constexpr size_t kAddressModes = 3;

struct Pipeline;

struct KeptPipeline {
    std::shared_ptr<const Pipeline> pipeline;
    uint64_t last_run = 0;
};

struct Device::State {
    Instance instance;
    DeviceInfo info;
    Context context;
    std::array<OwnedSampler, kSamplerNames.size()> samplers;
    std::array<OwnedSampler, kAddressModes * kAddressModes> map_samplers;
    OwnedCommandPool uploads;
    OwnedSemaphore submissions_done;
    OwnedPipelineCache pipeline_cache;
    std::string pipeline_cache_key;
    size_t pipeline_cache_bytes = 0;  ///< as loaded; stored again when it grew
    /// By content, shared by all executors: making one takes longer than drawing a small picture with it.
    std::map<std::string, KeptPipeline> pipelines;
    size_t most_pipelines = 0;
    uint64_t runs = 0;  ///< of all executors

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State();
    [[nodiscard]] VkSampler map_sampler(AddressMode u, AddressMode v) const {
        return map_samplers[size_t(u) * kAddressModes + size_t(v)].get();
    }
};

[[nodiscard]] Result<void> make_samplers(Device::State& state);

/// Loads what an earlier process left (base/cache.h); save_pipeline_cache() keeps what this one added.
[[nodiscard]] Result<void> open_pipeline_cache(Device::State& state);
void save_pipeline_cache(Device::State& state);

/// Semaphores that a submission waits for before its transfers and signals when done; null: none.
struct Semaphores {
    VkSemaphore wait = VK_NULL_HANDLE, signal = VK_NULL_HANDLE;
};

/// Between the CPU and the queue: how many frames the CPU may be ahead.
inline constexpr size_t kFramesInFlight = 2;

[[nodiscard]] Result<OwnedSemaphore> make_semaphore(const Context& context, VkSemaphoreType type);
[[nodiscard]] Result<OwnedCommandPool> make_command_pool(const Context& context,
                                                         VkCommandPoolCreateFlags flags);

/// A command buffer that is recorded again and again, with its own pool.
class ReusedCommands {
  public:
    [[nodiscard]] static Result<ReusedCommands> create(const Context& context);

    /// Waits for its last submission.
    [[nodiscard]] Result<void> wait(const Context& context, std::string_view name) const;
    [[nodiscard]] bool is_done(const Context& context) const { return context.is_done(submission_); }
    /// Waits for its last submission, then records and submits.
    [[nodiscard]] Result<void> run(Device::State& state, std::string_view name,
                                   const std::function<void(VkCommandBuffer)>& record,
                                   const Semaphores& semaphores = {});

  private:
    OwnedCommandPool pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    uint64_t submission_ = 0;
};

/// Records into a fresh command buffer, submits, waits. For uploads and read-backs.
[[nodiscard]] Result<void> run_once(Device::State& state, std::string_view name,
                                    const std::function<void(VkCommandBuffer)>& record);

}  // namespace dermis::gpu
