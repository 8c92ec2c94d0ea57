#include "dermis/view/hot_shaders.h"

namespace dermis::view {
namespace fs = std::filesystem;
namespace {

constexpr const char* kFolders[] = {"shaders", "techniques"};
constexpr const char* kFrame = "frame";  // the key of errors of several shaders together

// "folder/name.frag", as pass lists have it; empty for a file outside.
std::string shader_name(const fs::path& root, const fs::path& file) {
    for (const char* folder : kFolders) {
        const fs::path relative = file.lexically_relative(root / folder);
        if (!relative.empty() && *relative.begin() != "..") return relative.generic_string();
    }
    return "";
}

bool is_shader(const fs::path& file) {
    const fs::path extension = file.extension();
    return extension == ".frag" || extension == ".vert" || extension == ".comp";
}

}  // namespace

HotShaders::HotShaders(gpu::ShaderSource embedded, fs::path root)
    : root_(std::move(root)), embedded_(std::move(embedded)), disk_(gpu::disk_shaders(root_)) {
    files_.watch({root_ / kFolders[0], root_ / kFolders[1]});
}

gpu::ShaderSource HotShaders::source() {
    return [this](std::string_view name) { return get(name); };
}

bool HotShaders::poll() {
    bool any = false;
    for (const fs::path& file : files_.changed()) {
        if (file.extension() == ".glsl") {
            header_changed_ = any = true;
            for (const auto& [name, words] : compiled_) stale_.insert(name);
            for (const std::string& name : touched_) stale_.insert(name);
        } else if (is_shader(file)) {
            any = true;
            touched_.insert(shader_name(root_, file));
            stale_.insert(shader_name(root_, file));
        }
    }
    if (any) errors_.erase(kFrame);
    return any;
}

Result<HotShaders::Words> HotShaders::get(std::string_view name) {
    const std::string key(name);
    const auto known = compiled_.find(name);
    const bool follows = header_changed_ || touched_.contains(key);
    const bool never_tried = known == compiled_.end() && !errors_.contains(key);
    if (follows && (stale_.contains(key) || never_tried)) {
        stale_.erase(key);
        Result<Words> words = disk_(name);
        if (words) {
            errors_.erase(key);
            return compiled_[key] = std::move(*words);
        }
        errors_[key] = words.error().message;
    }
    return known != compiled_.end() ? Result<Words>(known->second) : embedded_(name);
}

void HotShaders::confirm() {
    if (!compiled_.empty()) confirmed_ = compiled_;
}

bool HotShaders::take_back(const std::string& message) {
    if (compiled_ == confirmed_) return false;
    // A version that was taken back is not tried again before its next change.
    for (const auto& [name, words] : compiled_)
        if (!confirmed_.contains(name)) {
            const Result<Words> built_in = embedded_(name);
            if (built_in) confirmed_[name] = *built_in;
        }
    compiled_ = confirmed_;
    errors_[kFrame] = message;
    return true;
}

}  // namespace dermis::view
