// GpuTest expects no messages from the layers: this shows that they do report errors.

#include "dermis/gpu/device_state.h"
#include "support/gpu_fixture.h"

namespace dermis::gpu {
namespace {

using ::testing::Contains;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class ValidationTest : public GpuTest {};

TEST_F(ValidationTest, a_wrong_call_is_reported) {
    const Context& context = device().state().context;
    const VkBufferCreateInfo no_size = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = 0, .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT};
    VkBuffer buffer = VK_NULL_HANDLE;
    context.vk.vkCreateBuffer(context.device, &no_size, nullptr, &buffer);
    const OwnedBuffer owner(context, buffer);
    EXPECT_THAT(take_messages(), Contains(HasSubstr("VUID-VkBufferCreateInfo-size")));
}

TEST_F(ValidationTest, messages_are_passed_on_as_they_come) {
    std::vector<std::string> heard;
    const Result<Device> own = Device::create(
        {.validation = true, .on_message = [&](const std::string& message) { heard.push_back(message); }});
    ASSERT_TRUE(own);
    const Context& context = own->state().context;
    const VkBufferCreateInfo no_size = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, .size = 0, .usage = VK_BUFFER_USAGE_VERTEX_BUFFER_BIT};
    VkBuffer buffer = VK_NULL_HANDLE;
    EXPECT_THAT(heard, IsEmpty());
    context.vk.vkCreateBuffer(context.device, &no_size, nullptr, &buffer);
    const OwnedBuffer owner(context, buffer);
    EXPECT_THAT(heard, Contains(HasSubstr("VUID-VkBufferCreateInfo-size")));
}

TEST_F(ValidationTest, a_missing_barrier_is_reported) {
    const Context& context = device().state().context;
    const Result<Buffer> buffer =
        make_buffer(context, "raced", 64, VK_BUFFER_USAGE_TRANSFER_DST_BIT, MemoryUse::device);
    ASSERT_TRUE(buffer);
    const Result<void> done = run_once(device().state(), "a race", [&](VkCommandBuffer commands) {
        context.vk.vkCmdFillBuffer(commands, buffer->handle.get(), 0, 64, 1);
        context.vk.vkCmdFillBuffer(commands, buffer->handle.get(), 0, 64, 2);
    });
    ASSERT_TRUE(done);
    EXPECT_THAT(take_messages(), Contains(ContainsRegex("WRITE[-_]AFTER[-_]WRITE")));
}

}  // namespace
}  // namespace dermis::gpu
