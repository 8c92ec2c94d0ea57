#pragma once
// What `dermis export` makes of a skin or a scene: shading functions as text, a package for an engine, a
// page.

#include <filesystem>
#include <string>
#include <vector>

#include "dermis/base/file.h"
#include "dermis/engines/package.h"
#include "scene_choice.h"

namespace dermis::cli {

inline constexpr const char* kExportProfile = "gpu_gems_3";  ///< without a profile and a scene

struct ExportOptions {
    std::string language, engine, profile, functions;
    std::string output;  ///< a file; a folder with engine, web or every language
    SceneChoice scene;
    bool web = false, native = false;

    /// What is known before it is made. Errors: options that do not go together, unknown names.
    [[nodiscard]] Result<FileUse> files() const;
};

struct Exported {
    std::vector<PackageFile> files;             ///< paths with the output before them
    std::vector<std::filesystem::path> inputs;  ///< files that may not be overwritten
    std::vector<std::string> warnings;
};

/// Errors as files(), SceneChoice::load() and find_profile().
[[nodiscard]] Result<Exported> make_export(const ExportOptions& options);

/// All files or none.
[[nodiscard]] Result<void> write_export(const Exported& made);

}  // namespace dermis::cli
