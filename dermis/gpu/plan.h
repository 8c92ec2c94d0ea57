#pragma once
// A pass list with every name resolved, ready for the recorder. All errors of a list are found here, before
// anything is recorded.

#include <optional>

#include "dermis/gpu/frame_images.h"
#include "dermis/gpu/pipeline.h"
#include "dermis/gpu/texture_state.h"

namespace dermis::gpu {

struct ImageAccess {
    FrameImage* image = nullptr;
    uint32_t first_mip = 0, mips = 1;
    ImageUse use = ImageUse::none;
    bool discard = false;
};

/// One write into a descriptor set; `buffer` null: a range of the plan's uploads.
struct Descriptor {
    uint32_t binding = 0;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE;
    VkDescriptorImageInfo image = {};
    VkBuffer buffer = VK_NULL_HANDLE;
    size_t offset = 0, size = 0;
};

/// A place in a buffer; null: in the plan's uploads.
struct BufferPlace {
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceSize offset = 0;
};

/// `index_count` is 0 for a full-screen triangle or a dispatch.
struct PlannedDraw {
    std::vector<BufferPlace> vertices;  ///< one for each input of the pipeline
    BufferPlace indices = {};
    uint32_t first_index = 0, index_count = 0;
    std::vector<Descriptor> descriptors;
    VkDescriptorSet set = VK_NULL_HANDLE;  ///< holds them; null: the recorder pushes them
    std::optional<PixelRect> scissor = {};
};

struct PlannedPass {
    const Pass* pass = nullptr;
    const Pipeline* pipeline = nullptr;  ///< null: a transfer, or a pass that only clears
    VkExtent2D extent = {};
    std::vector<ImageAccess> accesses;
    std::vector<PlannedDraw> draws;
    std::vector<std::byte> push_constants;
};

struct Plan {
    std::vector<PlannedPass> passes;
    std::vector<std::byte> uploads;  ///< blocks and streamed geometry of the frame
};

[[nodiscard]] bool is_transfer(PassKind kind);
[[nodiscard]] bool is_geometry(PassKind kind);
/// Depth that a pass tests and leaves as it is, and may therefore sample as well.
[[nodiscard]] bool only_tests(const DepthTarget& depth);

struct PlanContext {
    Device::State& device;
    const PassList& list;
    const FrameInputs& inputs;
    FrameImages& images;
    ShaderLibrary& shaders;
    PipelineStore& pipelines;
};

[[nodiscard]] Result<Plan> make_plan(const PlanContext& context);

/// The part of it for resolve, generate_mips and copy.
[[nodiscard]] Result<void> plan_transfer(const PlanContext& context, PlannedPass& planned);

/// Resolves names to descriptors, and blocks to bytes; equal blocks share their bytes.
class BindingResolver {
  public:
    BindingResolver(const PlanContext& context, Plan& plan) : context_(context), plan_(plan) {}

    /// Appends to `planned`: the draw's descriptors and the accesses they need. `draw` may be null.
    [[nodiscard]] Result<void> resolve(PlannedPass& planned, PlannedDraw& target, const Draw* draw);
    [[nodiscard]] Result<void> push_constants(PlannedPass& planned);
    /// Where the shader finds the data of a geometry.
    [[nodiscard]] BufferPlace place(const GeometryData& data);

  private:
    struct KnownBlock {
        std::string name;
        const Draw* draw;
        const BlockLayout* layout;
        size_t offset, size;
    };
    struct Found {
        VkImageView view = VK_NULL_HANDLE;
        TextureShape shape = TextureShape::plane;
        FrameImage* image = nullptr;
        VkSampler sampler = VK_NULL_HANDLE;  ///< of a texture; an image has none
    };

    [[nodiscard]] Result<Found> find_texture(const Pass& pass, const Binding& binding,
                                             const Draw* draw) const;
    [[nodiscard]] Result<Descriptor> sampler(const Pass& pass, const Binding& binding) const;
    [[nodiscard]] Result<Descriptor> texture(PlannedPass& planned, const Binding& binding, const Draw* draw);
    [[nodiscard]] Result<Descriptor> storage_image(PlannedPass& planned, const Binding& binding);
    [[nodiscard]] Result<Descriptor> uniform_block(const Pass& pass, const Binding& binding,
                                                   const Draw* draw);
    [[nodiscard]] Result<Descriptor> storage_buffer(const Pass& pass, const Binding& binding);
    [[nodiscard]] Result<Descriptor> buffer_of_pass(const Pass& pass, const Binding& binding,
                                                    const std::string& input);
    [[nodiscard]] Result<Descriptor> resolve_one(PlannedPass& planned, const Binding& binding,
                                                 const Draw* draw);
    [[nodiscard]] const KnownBlock* known(const std::string& name, const Binding& binding,
                                          const Draw* draw) const;
    size_t reserve(size_t bytes);
    [[nodiscard]] Error missing(const Pass& pass, const Binding& binding, std::string_view what,
                                const Draw* draw) const;

    const PlanContext& context_;
    Plan& plan_;
    std::vector<KnownBlock> known_;
    std::map<const GeometryData*, size_t> streamed_;  ///< offsets in the uploads
};

/// "pass 'x' (shader 'a/b.frag')", the beginning of every message.
[[nodiscard]] std::string pass_label(const Pass& pass);

}  // namespace dermis::gpu
