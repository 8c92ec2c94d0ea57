#pragma once
// What unity_head and unreal_head read of a GLB.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "dermis/base/result.h"

namespace dermis::drawn_head {

struct Glb {
    nlohmann::json document;
    std::vector<std::byte> binary;  ///< the only buffer
};

[[nodiscard]] Result<Glb> read_glb(const std::filesystem::path& path);

/// All numbers of an accessor, one element after the other. Floats may be sparse.
[[nodiscard]] std::vector<float> floats_of(const Glb& glb, size_t accessor);
[[nodiscard]] std::vector<uint32_t> integers_of(const Glb& glb, size_t accessor);

}  // namespace dermis::drawn_head
