#include "dermis/mesh/pose.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/text.h"

namespace dermis::inline mesh {
namespace {

// Whether `name` is one of the names or the number of one.
bool names_one(const std::string& name, const std::vector<std::string>& names) {
    if (std::ranges::find(names, name) != names.end()) return true;
    for (size_t i = 0; name.starts_with('#') && i < names.size(); ++i)
        if (numbered_name(i) == name) return true;
    return false;
}

Error unknown(const std::string& what, const std::string& name, const std::vector<std::string>& names) {
    if (names.empty()) return Error{what + " '" + name + "': the mesh has none"};
    return Error{unknown_name(what, name, names)};
}

}  // namespace

std::string numbered_name(size_t index) {
    return "#" + std::to_string(index + 1);
}

Result<void> check_pose(const Pose& pose, std::span<const Motion> motions) {
    if (!std::isfinite(pose.time_s)) return Error{"time_s must be a finite number of seconds"};
    std::vector<std::string> clips, targets;
    for (const Motion& motion : motions) {
        for (const ClipInfo& clip : motion.clips) clips.push_back(clip.name);
        targets.insert(targets.end(), motion.targets.begin(), motion.targets.end());
    }
    if (!pose.clip.empty() && !names_one(pose.clip, clips)) return unknown("clip", pose.clip, clips);
    for (const auto& [name, weight] : pose.morph) {
        if (!names_one(name, targets)) return unknown("morph target", name, targets);
        if (!std::isfinite(weight)) return Error{"the weight of " + name + " must be a finite number"};
    }
    return {};
}

}  // namespace dermis::inline mesh
