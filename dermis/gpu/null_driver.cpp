#include "dermis/gpu/null_driver.h"

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace dermis::gpu {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

bool null_driver_installed() {
    return !radv_manifest().empty();
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

}  // namespace dermis::gpu
