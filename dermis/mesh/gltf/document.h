#pragma once
// A glTF 2.0 file opened: its JSON, its buffers in memory. Internal to dermis/mesh.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "dermis/mesh/gltf/json_view.h"
#include "dermis/mesh/read_mesh.h"

namespace dermis::inline mesh::gltf {

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
