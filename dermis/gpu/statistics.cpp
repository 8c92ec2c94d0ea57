#include "dermis/gpu/statistics.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>

#include "dermis/gpu/pipeline.h"
#include "dermis/gpu/plan.h"

namespace dermis::gpu {
namespace fs = std::filesystem;
namespace {

std::string_view stage_name(VkShaderStageFlags stages) {
    if (stages & VK_SHADER_STAGE_COMPUTE_BIT) return "compute";
    return stages & VK_SHADER_STAGE_FRAGMENT_BIT ? "fragment" : "vertex";
}

uint64_t value_of(const VkPipelineExecutableStatisticKHR& statistic) {
    if (statistic.format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_INT64_KHR)
        return uint64_t(std::max<int64_t>(statistic.value.i64, 0));
    if (statistic.format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_FLOAT64_KHR)
        return uint64_t(std::max(statistic.value.f64, 0.0));
    return statistic.value.u64;
}

Result<ShaderStatistics> read_executable(const Context& context, VkPipeline pipeline, uint32_t index,
                                         const VkPipelineExecutablePropertiesKHR& properties) {
    const VkPipelineExecutableInfoKHR info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR,
                                              .pipeline = pipeline,
                                              .executableIndex = index};
    uint32_t count = 0;
    VkResult result = context.vk.vkGetPipelineExecutableStatisticsKHR(context.device, &info, &count, nullptr);
    std::vector<VkPipelineExecutableStatisticKHR> read(
        count, {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR});
    if (result == VK_SUCCESS)
        result = context.vk.vkGetPipelineExecutableStatisticsKHR(context.device, &info, &count, read.data());
    DERMIS_TRY(check(result, "read the compiler's statistics"));
    ShaderStatistics shader = {.stage = std::string(stage_name(properties.stages)),
                               .subgroup_size = properties.subgroupSize};
    for (const StatisticField& field : statistic_fields()) {
        const auto found = std::ranges::find_if(
            read, [&](const auto& one) { return !std::strcmp(one.name, field.driver_name); });
        if (found == read.end())
            return Error{"the driver does not report '" + std::string(field.driver_name) +
                         "'; dermis reads the statistics of Mesa 22.3 and of later ones that keep its names"};
        shader.*field.member = value_of(*found);
    }
    return shader;
}

Result<std::vector<ShaderStatistics>> read_pipeline(const Context& context, VkPipeline pipeline) {
    const VkPipelineInfoKHR info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR, .pipeline = pipeline};
    uint32_t count = 0;
    VkResult result = context.vk.vkGetPipelineExecutablePropertiesKHR(context.device, &info, &count, nullptr);
    std::vector<VkPipelineExecutablePropertiesKHR> properties(
        count, {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR});
    if (result == VK_SUCCESS)
        result =
            context.vk.vkGetPipelineExecutablePropertiesKHR(context.device, &info, &count, properties.data());
    DERMIS_TRY(check(result, "list the shaders of a pipeline"));
    std::vector<ShaderStatistics> shaders;
    for (uint32_t i = 0; i < count; ++i) {
        DERMIS_TRY_ASSIGN(ShaderStatistics shader, read_executable(context, pipeline, i, properties[i]));
        shaders.push_back(std::move(shader));
    }
    return shaders;
}

// A variable of the environment, put back at the end.
class ScopedVariable {
  public:
    ScopedVariable(const char* name, const std::string& value) : name_(name) {
        if (const char* before = std::getenv(name)) before_ = before;
        setenv(name, value.c_str(), 1);
    }
    ~ScopedVariable() {
        if (before_)
            setenv(name_, before_->c_str(), 1);
        else
            unsetenv(name_);
    }
    ScopedVariable(const ScopedVariable&) = delete;
    ScopedVariable& operator=(const ScopedVariable&) = delete;

  private:
    const char* name_;
    std::optional<std::string> before_;
};

// radeon_icd.x86_64.json in one of the loader's directories. An empty path: none.
fs::path radv_manifest() {
    for (const char* directory :
         {"/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d", "/usr/share/vulkan/icd.d"}) {
        std::error_code ec;
        for (const fs::directory_entry& entry : fs::directory_iterator(directory, ec))
            if (entry.path().filename().string().starts_with("radeon_icd")) return entry.path();
    }
    return {};
}

Result<Device> open_as(const fs::path& manifest, const std::string& family) {
    // The loader reads the first two when an instance is made (the newer name wins where it is known), the
    // driver the third when devices are listed.
    const ScopedVariable driver("VK_DRIVER_FILES", manifest.string());
    const ScopedVariable icd("VK_ICD_FILENAMES", manifest.string());
    const ScopedVariable variable("RADV_FORCE_FAMILY", family);
    Result<Device> device = Device::create({.keep_statistics = true});
    if (!device)
        return device.error().within("RADV (" + manifest.string() + ") without hardware, as '" + family +
                                     "'");
    return device;
}

// Mesa 22 calls RDNA 3's chip by its instruction set. Each version ends the process at the other's name, so
// the version is read from a device of a chip that all of them know.
Result<std::string> family_of(const fs::path& manifest, std::string_view chip) {
    if (chip != "navi31") return std::string(chip);
    DERMIS_TRY_ASSIGN(const Device known, open_as(manifest, "navi21"));
    return std::string(known.info().driver.find("Mesa 22.") != std::string::npos ? "gfx1100" : chip);
}

Result<Device> open_null_driver(std::string_view chip) {
    const fs::path manifest = radv_manifest();
    if (manifest.empty())
        return Error{
            "no radeon_icd*.json in /usr/share/vulkan/icd.d: Mesa's RADV compiles for the chip and is not "
            "installed (Debian: apt-get install mesa-vulkan-drivers)"};
    DERMIS_TRY_ASSIGN(const std::string family, family_of(manifest, chip));
    return open_as(manifest, family);
}

}  // namespace

bool null_driver_installed() {
    return !radv_manifest().empty();
}

std::span<const StatisticField> statistic_fields() {
    using S = ShaderStatistics;
    static constexpr StatisticField kFields[] = {
        {"instructions", "Instructions", &S::instructions},
        {"copies", "Copies", &S::copies},
        {"branches", "Branches", &S::branches},
        {"vgprs", "VGPRs", &S::vgprs},
        {"sgprs", "SGPRs", &S::sgprs},
        {"spilled_vgprs", "Spilled VGPRs", &S::spilled_vgprs},
        {"spilled_sgprs", "Spilled SGPRs", &S::spilled_sgprs},
        {"subgroups_per_simd", "Subgroups per SIMD", &S::subgroups_per_simd},
        {"code_bytes", "Code size", &S::code_bytes},
        {"lds_bytes", "LDS size", &S::lds_bytes},
        {"scratch_bytes", "Scratch size", &S::scratch_bytes},
        {"vmem_clauses", "VMEM Clause", &S::vmem_clauses},
        {"smem_clauses", "SMEM Clause", &S::smem_clauses},
        {"latency_cycles", "Latency", &S::latency_cycles},
        {"inverse_throughput_cycles", "Inverse Throughput", &S::inverse_throughput_cycles}};
    return kFields;
}

struct NullDevice::State {
    State(Device opened, ShaderSource source)
        : device(std::move(opened)), shaders(std::move(source)), pipelines(device.state()) {}
    Device device;
    ShaderLibrary shaders;
    PipelineStore pipelines;
};

Result<NullDevice> NullDevice::open(std::string_view chip, ShaderSource shaders) {
    DERMIS_TRY_ASSIGN(Device device, open_null_driver(chip));
    return NullDevice(std::make_unique<State>(std::move(device), std::move(shaders)));
}

Result<std::vector<PassStatistics>> NullDevice::compile(const PassList& list) {
    std::vector<PassStatistics> passes;
    for (const Pass& pass : list.passes) {
        PassStatistics& statistics = passes.emplace_back(PassStatistics{.pass = pass.name});
        DERMIS_TRY_ASSIGN(const Pipeline* pipeline,
                          pass_pipeline(list, pass, state_->shaders, state_->pipelines));
        if (!pipeline) continue;
        Result<std::vector<ShaderStatistics>> shaders =
            read_pipeline(state_->device.state().context, pipeline->handle.get());
        if (!shaders) return shaders.error().within(pass_label(pass));
        statistics.shaders = std::move(*shaders);
        for (const StageVariable& input : pipeline->inputs)
            statistics.vertex_bytes += uint32_t(input.components) * 4;
        for (const Binding& binding : pipeline->bindings)
            if (binding.kind == BindingKind::texture || binding.kind == BindingKind::sampled_texture)
                statistics.textures.push_back(binding.name);
    }
    return passes;
}

const DeviceInfo& NullDevice::info() const {
    return state_->device.info();
}

NullDevice::NullDevice(std::unique_ptr<State> state) : state_(std::move(state)) {}
NullDevice::~NullDevice() = default;
NullDevice::NullDevice(NullDevice&&) noexcept = default;
NullDevice& NullDevice::operator=(NullDevice&&) noexcept = default;

}  // namespace dermis::gpu
