#include "dermis/view/model.h"

#include <algorithm>

#include "dermis/base/text.h"
#include "dermis/scene/scene_hash.h"

namespace dermis::view {
ParameterValues& TechniqueChoice::values() {
    return values_.try_emplace(technique_->id, technique_->parameters).first->second;
}

void Notices::inform(std::string topic, std::string text, double now_s) {
    clear(topic);
    all_.push_back({.topic = std::move(topic), .text = std::move(text), .until_s = now_s + 4});
}

void Notices::report_error(std::string topic, std::string text) {
    clear(topic);
    all_.push_back({.topic = std::move(topic), .text = std::move(text), .is_error = true});
}

void Notices::clear(const std::string& topic) {
    std::erase_if(all_, [&](const Notice& notice) { return notice.topic == topic; });
}

void Notices::expire(double now_s) {
    std::erase_if(all_, [&](const Notice& notice) { return !notice.is_error && notice.until_s < now_s; });
}

void Warnings::add(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings)
        if (!std::ranges::count(unread_, warning) && !std::ranges::count(read_, warning))
            unread_.push_back(warning);
}

void Warnings::read(size_t index) {
    read_.push_back(unread_.at(index));
    unread_.erase(unread_.begin() + std::ptrdiff_t(index));
}

void Warnings::read_all() {
    while (!unread_.empty()) read(0);
}

std::string picture_key(Model& model, size_t choice) {
    const Scene& scene = *model.scene;
    TechniqueChoice& chosen = model.choices[choice];
    std::string key = chosen.technique().id + ' ' + model.view + ' ';
    for (const Parameter& parameter : chosen.technique().parameters.parameters)
        key += chosen.values().text(parameter) + ' ';
    return key + to_text(scene.exposure_ev) + ' ' + std::to_string(int(scene.tone_map)) + ' ' +
           hash_of_views(scene);
}

std::string neighbour(const std::vector<std::string>& names, const std::string& name, int step) {
    const auto found = std::ranges::find(names, name);
    if (found == names.end()) return names.front();
    const auto count = std::ptrdiff_t(names.size());
    return names[size_t((found - names.begin() + step + count) % count)];
}

}  // namespace dermis::view
