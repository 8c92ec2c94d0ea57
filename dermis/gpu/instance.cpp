#include "dermis/gpu/instance.h"

#include <algorithm>
#include <cstring>

namespace dermis::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";

bool has_layer(const char* name) {
    return std::ranges::any_of(list_all<VkLayerProperties>(vkEnumerateInstanceLayerProperties),
                               [&](const auto& layer) { return !std::strcmp(layer.layerName, name); });
}

bool has_extension(const char* name) {
    constexpr const char* kOfEachLayer = nullptr;
    return std::ranges::any_of(
        list_all<VkExtensionProperties>(vkEnumerateInstanceExtensionProperties, kOfEachLayer),
        [&](const auto& one) { return !std::strcmp(one.extensionName, name); });
}

VKAPI_ATTR VkBool32 VKAPI_CALL on_message(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                          VkDebugUtilsMessageTypeFlagsEXT,
                                          const VkDebugUtilsMessengerCallbackDataEXT* data, void* user) {
    static_cast<MessageLog*>(user)->add(data->pMessage ? data->pMessage : "(no text)");
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT messenger_info(MessageLog* log) {
    return {.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
            .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT |
                               VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
            .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
            .pfnUserCallback = on_message,
            .pUserData = log};
}

Result<void> check_loader(const DeviceOptions& options) {
    if (volkInitialize() != VK_SUCCESS)
        return Error{
            "no Vulkan loader on this machine; install libvulkan1 and a driver (Debian: "
            "apt-get install libvulkan1 mesa-vulkan-drivers)"};
    if (volkGetInstanceVersion() < VK_API_VERSION_1_3)
        return Error{"the Vulkan loader is older than 1.3; update libvulkan1"};
    if (options.validation && !has_layer(kValidationLayer))
        return Error{
            "validation was asked for, but VK_LAYER_KHRONOS_validation is not installed (Debian: "
            "apt-get install vulkan-validationlayers)"};
    for (const std::string& name : options.instance_extensions)
        if (!has_extension(name.c_str()))
            return Error{"the Vulkan loader lacks the extension " + name + ", which the window needs"};
    return {};
}

}  // namespace

void MessageLog::add(std::string message) {
    const std::lock_guard lock(mutex_);
    if (on_message_) on_message_(message);
    messages_.push_back(std::move(message));
}

std::vector<std::string> MessageLog::all() const {
    const std::lock_guard lock(mutex_);
    return messages_;
}

Result<Instance> Instance::create(const DeviceOptions& options) {
    DERMIS_TRY(check_loader(options));
    Instance instance;
    instance.log_ = std::make_unique<MessageLog>(options.on_message);
    instance.has_debug_utils_ = has_extension(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);

    std::vector<const char*> extensions, layers;
    for (const std::string& name : options.instance_extensions) extensions.push_back(name.c_str());
    if (instance.has_debug_utils_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    if (options.validation) layers.push_back(kValidationLayer);

    const VkValidationFeatureEnableEXT enabled[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(instance.log_.get());
    VkValidationFeaturesEXT validation = {.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
                                          .pNext = &messenger,
                                          .enabledValidationFeatureCount = 1,
                                          .pEnabledValidationFeatures = enabled};
    const VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                           .pApplicationName = "dermis",
                                           .apiVersion = VK_API_VERSION_1_3};
    const VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                       .pNext = options.validation ? &validation : nullptr,
                                       .pApplicationInfo = &application,
                                       .enabledLayerCount = uint32_t(layers.size()),
                                       .ppEnabledLayerNames = layers.data(),
                                       .enabledExtensionCount = uint32_t(extensions.size()),
                                       .ppEnabledExtensionNames = extensions.data()};
    const VkResult result = vkCreateInstance(&info, nullptr, &instance.handle_);
    DERMIS_TRY(check(result, "start Vulkan"));
    volkLoadInstanceOnly(instance.handle_);
    if (!options.validation) return instance;

    const auto create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance.handle_, "vkCreateDebugUtilsMessengerEXT"));
    if (!create) return Error{"the validation layers lack VK_EXT_debug_utils; update them"};
    const VkResult made = create(instance.handle_, &messenger, nullptr, &instance.messenger_);
    DERMIS_TRY(check(made, "listen to the validation layers"));
    return instance;
}

Instance::~Instance() {
    if (messenger_) {
        const auto destroy = reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(handle_, "vkDestroyDebugUtilsMessengerEXT"));
        destroy(handle_, messenger_, nullptr);
    }
    if (handle_) vkDestroyInstance(handle_, nullptr);
}

Instance::Instance(Instance&& other) noexcept {
    *this = std::move(other);
}

Instance& Instance::operator=(Instance&& other) noexcept {
    std::swap(handle_, other.handle_);
    std::swap(messenger_, other.messenger_);
    std::swap(log_, other.log_);
    std::swap(has_debug_utils_, other.has_debug_utils_);
    return *this;
}

}  // namespace dermis::gpu
