#include "dermis/mesh/gltf/json_view.h"

#include <cmath>

namespace dermis::inline mesh::gltf {

void Messages::fail(const std::string& place, const std::string& text) {
    if (!error) error = Error{file + ": " + (place.empty() ? "" : place + ": ") + text};
}

void Messages::warn(const std::string& place, const std::string& text) {
    warnings.push_back(file + ": " + (place.empty() ? "" : place + ": ") + text);
}

JsonView JsonView::operator[](const char* key) const {
    const std::string place = place_.empty() ? key : place_ + "." + key;
    const nlohmann::json* found = nullptr;
    if (value_ && value_->is_object()) {
        const auto at = value_->find(key);
        if (at != value_->end()) found = &*at;
    } else if (value_) {
        fail("must be an object");
    }
    return {found, place, *messages_};
}

JsonView JsonView::operator[](size_t index) const {
    const nlohmann::json* found = nullptr;
    if (index < size())
        found = &(*value_)[index];
    else
        fail("has no element " + std::to_string(index) + " (it has " + std::to_string(size()) + ")");
    return {found, place_ + "[" + std::to_string(index) + "]", *messages_};
}

size_t JsonView::size() const {
    if (!value_) return 0;
    if (!value_->is_array()) return fail("must be an array"), 0;
    return value_->size();
}

double JsonView::number(double fallback) const {
    if (!value_) return fallback;
    if (!value_->is_number()) return fail("must be a number"), fallback;
    const double number = value_->get<double>();
    // Everything ends as a float.
    if (!std::isfinite(float(number))) return fail("is out of range"), fallback;
    return number;
}

uint64_t JsonView::integer(uint64_t fallback) const {
    if (!value_) return fallback;
    const double number = value_->is_number() ? value_->get<double>() : -1;
    if (number < 0 || number > 9007199254740992.0 || number != std::floor(number))
        return fail("must be a non-negative integer"), fallback;
    return uint64_t(number);
}

std::string JsonView::text(const std::string& fallback) const {
    if (!value_) return fallback;
    if (!value_->is_string()) return fail("must be a string"), fallback;
    return value_->get<std::string>();
}

bool JsonView::boolean(bool fallback) const {
    if (!value_) return fallback;
    if (!value_->is_boolean()) return fail("must be true or false"), fallback;
    return value_->get<bool>();
}

}  // namespace dermis::inline mesh::gltf
