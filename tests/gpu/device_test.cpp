#include "dermis/gpu/instance.h"
#include "support/gpu_fixture.h"

namespace dermis::gpu {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(Devices, are_listed_with_what_they_can) {
    const Result<std::vector<DeviceInfo>> devices = list_devices();
    ASSERT_TRUE(devices) << devices.error().message;
    ASSERT_FALSE(devices->empty());
    for (const DeviceInfo& device : *devices) {
        EXPECT_FALSE(device.name.empty());
        EXPECT_THAT(device.sample_counts, Contains(1));
    }
}

TEST(Devices, the_first_listed_is_the_one_taken) {
    const Result<std::vector<DeviceInfo>> devices = list_devices();
    ASSERT_TRUE(devices) << devices.error().message;
    const Result<Device> device = Device::create({});
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_EQ(device->info().name, devices->front().name);
    EXPECT_FALSE(device->info().driver.empty());
}

TEST(Devices, are_picked_by_part_of_their_name_in_any_case) {
    const Result<std::vector<DeviceInfo>> devices = list_devices();
    ASSERT_TRUE(devices) << devices.error().message;
    std::string part = devices->back().name.substr(0, 5);
    for (char& c : part) c = char(std::toupper(c));
    const Result<Device> device = Device::create({.name_contains = part});
    ASSERT_TRUE(device) << device.error().message;
    EXPECT_EQ(device->info().name.substr(0, 5), devices->back().name.substr(0, 5));
}

TEST(Devices, a_name_nobody_has_is_an_error_that_lists_them) {
    const Result<Device> device = Device::create({.name_contains = "voodoo"});
    ASSERT_FALSE(device);
    EXPECT_THAT(device.error().message, HasSubstr("'voodoo'"));
    EXPECT_THAT(device.error().message, HasSubstr(list_devices()->front().name));
}

TEST(Devices, that_lack_a_use_of_a_format_say_so_for_each) {
    const auto all_but = [](VkFormat lacking, VkFormatFeatureFlags feature) {
        return missing_formats(
            [=](VkFormat format) { return format == lacking ? ~feature : ~VkFormatFeatureFlags{0}; });
    };
    EXPECT_THAT(all_but(VK_FORMAT_R8_UNORM, ~VkFormatFeatureFlags{0}), IsEmpty());
    EXPECT_THAT(all_but(VK_FORMAT_R32_SFLOAT, VK_FORMAT_FEATURE_SAMPLED_IMAGE_FILTER_LINEAR_BIT),
                ElementsAre(HasSubstr("R32_SFLOAT that is filtered")));
    EXPECT_THAT(all_but(VK_FORMAT_R16G16B16A16_UNORM, VK_FORMAT_FEATURE_BLIT_SRC_BIT),
                ElementsAre(HasSubstr("normal maps")));
    EXPECT_THAT(missing_formats([](VkFormat) { return VkFormatFeatureFlags{0}; }), SizeIs(3));
}

TEST(Devices, without_drivers_the_error_names_what_to_install) {
    // The loader reads both variables when an instance is made.
    setenv("VK_DRIVER_FILES", "/nonexistent.json", 1);
    setenv("VK_ICD_FILENAMES", "/nonexistent.json", 1);
    const Result<Device> device = Device::create({});
    unsetenv("VK_DRIVER_FILES");
    unsetenv("VK_ICD_FILENAMES");
    ASSERT_FALSE(device);
    EXPECT_THAT(device.error().message, HasSubstr("mesa-vulkan-drivers"));
}

}  // namespace
}  // namespace dermis::gpu
