#include "job_hash.h"

#include <algorithm>

#include "dermis/base/file.h"
#include "dermis/base/hash.h"
#include "dermis/scene/scene_hash.h"

namespace dermis::cli {

Result<std::string> hash_of_job(const std::vector<const Scene*>& scenes,
                                const std::vector<std::string>& words) {
    // Techniques, shaders and the drawing code have no version but the program itself.
    DERMIS_TRY_ASSIGN(const std::vector<std::byte> program, read_file("/proc/self/exe"));
    Hasher hasher;
    hasher.add(std::span(program));
    for (const Scene* scene : scenes) {
        DERMIS_TRY_ASSIGN(const std::string content, hash_of(*scene));
        // Visible in a picture, but not in hash_of().
        hasher.add(content).add(scene->exposure_ev).add(scene->tone_map).add(scene->credit);
        hasher.add(scene->technique);
        // Other poses of what moves.
        const auto moves = [](const SceneObject& object) { return !object.motion.empty(); };
        if (std::ranges::any_of(scene->objects, moves))
            for (const std::filesystem::path& path : scene->files) {
                DERMIS_TRY_ASSIGN(const std::vector<std::byte> file, read_file(path));
                hasher.add(std::span(file));
            }
        for (const auto& [name, value] : scene->settings) hasher.add(name).add(value);
    }
    for (const std::string& word : words) hasher.add(word);
    return hasher.hex();
}

}  // namespace dermis::cli
