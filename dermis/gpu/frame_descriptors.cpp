#include "dermis/gpu/frame_descriptors.h"

#include <algorithm>

namespace dermis::gpu {

DescriptorWrites::DescriptorWrites(const PlannedDraw& draw, VkBuffer uploads)
    : buffers_(draw.descriptors.size()), writes_(draw.descriptors.size()) {
    for (size_t i = 0; i < writes_.size(); ++i) {
        const Descriptor& descriptor = draw.descriptors[i];
        buffers_[i] = {descriptor.buffer ? descriptor.buffer : uploads, descriptor.offset, descriptor.size};
        writes_[i] = {.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET,
                      .dstSet = draw.set,
                      .dstBinding = descriptor.binding,
                      .descriptorCount = 1,
                      .descriptorType = descriptor.type,
                      .pImageInfo = &descriptor.image,
                      .pBufferInfo = &buffers_[i]};
    }
}

FrameDescriptors::Room FrameDescriptors::needed_room(std::span<const PlannedDraw* const> draws) {
    Room room{.sets = uint32_t(draws.size())};
    for (const PlannedDraw* draw : draws)
        for (const Descriptor& descriptor : draw->descriptors) ++room.descriptors[descriptor.type];
    return room;
}

Result<void> FrameDescriptors::make_room(const Context& context, const Room& needed) {
    const bool fits =
        needed.sets <= room_.sets && std::ranges::all_of(needed.descriptors, [&](const auto& one) {
            const auto has = room_.descriptors.find(one.first);
            return has != room_.descriptors.end() && one.second <= has->second;
        });
    if (fits)
        return check(context.vk.vkResetDescriptorPool(context.device, pool_.get(), 0),
                     "reset a descriptor pool");
    Room larger = room_;
    larger.sets = std::max(room_.sets, needed.sets * 3 / 2);
    std::vector<VkDescriptorPoolSize> sizes;
    for (const auto& [type, count] : needed.descriptors)
        larger.descriptors[type] = std::max(larger.descriptors[type], count * 3 / 2);
    for (const auto& [type, count] : larger.descriptors) sizes.push_back({type, count});
    const VkDescriptorPoolCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                             .maxSets = larger.sets,
                                             .poolSizeCount = uint32_t(sizes.size()),
                                             .pPoolSizes = sizes.data()};
    DERMIS_TRY_ASSIGN(pool_, make<OwnedDescriptorPool>(context, context.vk.vkCreateDescriptorPool, info,
                                                       "make a descriptor pool"));
    room_ = std::move(larger);
    return {};
}

Result<void> FrameDescriptors::prepare(const Context& context, Plan& plan, VkBuffer uploads) {
    std::vector<PlannedDraw*> draws;
    std::vector<VkDescriptorSetLayout> layouts;
    for (PlannedPass& planned : plan.passes)
        for (PlannedDraw& draw : planned.draws) {
            if (planned.pipeline->pushes_descriptors || draw.descriptors.empty()) continue;
            draws.push_back(&draw);
            layouts.push_back(planned.pipeline->set_layout.get());
        }
    if (draws.empty()) return {};
    DERMIS_TRY(make_room(context, needed_room(draws)));
    const VkDescriptorSetAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
                                              .descriptorPool = pool_.get(),
                                              .descriptorSetCount = uint32_t(layouts.size()),
                                              .pSetLayouts = layouts.data()};
    std::vector<VkDescriptorSet> sets(layouts.size());
    const VkResult result = context.vk.vkAllocateDescriptorSets(context.device, &info, sets.data());
    DERMIS_TRY(check(result, "make the descriptor sets of a frame"));
    for (size_t i = 0; i < draws.size(); ++i) {
        draws[i]->set = sets[i];
        const DescriptorWrites writes(*draws[i], uploads);
        context.vk.vkUpdateDescriptorSets(context.device, uint32_t(writes.all().size()), writes.all().data(),
                                          0, nullptr);
    }
    return {};
}

}  // namespace dermis::gpu
