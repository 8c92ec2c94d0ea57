#pragma once
// A place in a JSON document with its path, so that every message names file and place. Internal to
// dermis/mesh.

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::inline mesh::gltf {

/// The errors and warnings of reading so far. Reading goes on after an error with harmless values; the caller
/// asks at the end of each step.
struct Messages {
    std::string file;
    std::optional<Error> error;  ///< the first
    std::vector<std::string> warnings;

    void fail(const std::string& place, const std::string& text);
    void warn(const std::string& place, const std::string& text);
};

/// Missing members give views that do not exist and values that fall back; members of a wrong type are
/// errors.
class JsonView {
  public:
    JsonView(const nlohmann::json* value, std::string place, Messages& messages)
        : value_(value), place_(std::move(place)), messages_(&messages) {}

    [[nodiscard]] bool exists() const { return value_ != nullptr; }
    [[nodiscard]] const std::string& place() const { return place_; }
    [[nodiscard]] JsonView operator[](const char* key) const;
    [[nodiscard]] JsonView operator[](size_t index) const;  ///< an index past the end is an error
    [[nodiscard]] size_t size() const;                      ///< elements of an array, 0 when missing

    [[nodiscard]] double number(double fallback) const;
    [[nodiscard]] uint64_t integer(uint64_t fallback) const;  ///< 0 .. 2^53
    [[nodiscard]] std::string text(const std::string& fallback) const;
    [[nodiscard]] bool boolean(bool fallback) const;
    /// An array of exactly `N` finite numbers.
    template <size_t N>
    [[nodiscard]] std::array<double, N> numbers(std::array<double, N> fallback) const {
        if (!exists()) return fallback;
        if (!value_->is_array() || value_->size() != N)
            return fail("must be an array of " + std::to_string(N) + " numbers"), fallback;
        for (size_t i = 0; i < N; ++i) fallback[i] = (*this)[i].number(fallback[i]);
        return fallback;
    }

    void fail(const std::string& text) const { messages_->fail(place_, text); }
    void warn(const std::string& text) const { messages_->warn(place_, text); }
    [[nodiscard]] bool failed() const { return messages_->error.has_value(); }

  private:
    const nlohmann::json* value_;
    std::string place_;
    Messages* messages_;
};

}  // namespace dermis::inline mesh::gltf
