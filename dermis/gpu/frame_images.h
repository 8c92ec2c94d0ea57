#pragma once
// The images of a pass list, kept from run to run, and what each was last used for.

#include <map>

#include "dermis/gpu/device_state.h"

namespace dermis::gpu {

/// How a pass uses an image; decides layout, stages and access.
/// depth_test: tested and perhaps sampled, never written.
enum class ImageUse {
    none,
    sampled,
    storage,
    color_target,
    depth_target,
    depth_test,
    copy_source,
    copy_target
};

struct UseScope {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags2 stages = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 access = VK_ACCESS_2_NONE;
    bool writes = false;
};
[[nodiscard]] UseScope use_scope(ImageUse use);

struct FrameImage {
    ImageDeclaration declaration;
    DeviceImage image;
    std::vector<OwnedView> mip_views;
    std::vector<ImageUse> last_use;  ///< of each level
    uint64_t last_run = 0;

    [[nodiscard]] VkExtent2D extent(int mip = 0) const { return mip_extent(image.info.extent, mip); }
};

class FrameImages {
  public:
    explicit FrameImages(Device::State& device) : device_(&device) {}

    /// Finds or makes every image of the list at this frame size. New persistent ones are cleared to zero
    /// (depth: 1). Those no list wanted for a few runs are dropped.
    [[nodiscard]] Result<void> prepare(const PassList& list, int width, int height);

    /// An image of the last prepared list, or null.
    [[nodiscard]] FrameImage* find(std::string_view name) const;
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] size_t count() const { return images_.size(); }
    [[nodiscard]] uint64_t bytes() const;

  private:
    [[nodiscard]] Result<FrameImage> make(const ImageDeclaration& declaration, VkExtent2D extent,
                                          bool storage);
    [[nodiscard]] Result<void> clear(FrameImage& image);

    Device::State* device_;
    std::map<std::string, FrameImage> images_;  ///< by name and everything that makes it another image
    std::map<std::string, FrameImage*, std::less<>> current_;
    uint64_t run_ = 0;
};

/// One level, as stored. Errors: multisampled, no such level.
[[nodiscard]] Result<Image> read_image(Device::State& device, FrameImage& source, int mip);

/// Collects the transitions before a pass and records them as one barrier.
class BarrierBatch {
  public:
    /// `discard`: the old content is not needed.
    void add(FrameImage& image, uint32_t first_mip, uint32_t mips, ImageUse use, bool discard);
    void record(const Context& context, VkCommandBuffer commands);

  private:
    std::vector<VkImageMemoryBarrier2> barriers_;
};

}  // namespace dermis::gpu
