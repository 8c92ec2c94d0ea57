#pragma once
// A glTF 2.0 file opened: its JSON, its buffers in memory. Internal to dermis/mesh.

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/mesh/read_mesh.h"

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

/// A place in a JSON document with its path, so that every message names file and place. Missing members give
/// views that do not exist and values that fall back; members of a wrong type are errors.
class JsonView {
  public:
    JsonView(const nlohmann::json* value, std::string place, Messages& messages)
        : value_(value), place_(std::move(place)), messages_(&messages) {}

    [[nodiscard]] bool exists() const { return value_ != nullptr; }
    [[nodiscard]] const std::string& place() const { return place_; }
    [[nodiscard]] const nlohmann::json* json() const { return value_; }  ///< null where it does not exist
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

struct Document {
    nlohmann::json root;
    std::vector<std::vector<std::byte>> buffers;
    std::filesystem::path directory;  ///< of the file, for image paths
    Messages messages;
    size_t max_vertices = 0, max_nodes = 0;

    [[nodiscard]] JsonView view() { return {&root, "", messages}; }
};

/// Reads the container (GLB or bare JSON), checks the version and the required extensions, loads the buffers.
/// Errors are left in messages.
void open_document(std::span<const std::byte> bytes, const std::filesystem::path& name,
                   const ReadSibling& read_sibling, const MeshOptions& options, Document& document);

/// The bytes of a buffer view, checked against its buffer; empty after an error.
[[nodiscard]] std::span<const std::byte> buffer_view(Document& document, uint64_t index);

/// A "data:" URI's bytes, in base64 or percent-encoded; nothing when it is malformed. And a relative URI with
/// its percent escapes undone.
[[nodiscard]] std::optional<std::vector<std::byte>> decode_data_uri(std::string_view uri);
[[nodiscard]] std::string decode_percent(std::string_view uri);

}  // namespace dermis::inline mesh::gltf
