#pragma once
// The bust of default parameters, made once for all tests of this folder.

#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "subjects/bust/bust.h"
#include "subjects/bust/field.h"

namespace dermis {

/// A cache folder of its own, which the test of the cache reads; it is removed when the program ends.
class TestCache {
  public:
    TestCache() { std::filesystem::remove_all(folder()), setenv("DERMIS_CACHE", folder().c_str(), 1); }
    ~TestCache() {
        std::error_code ignored;
        std::filesystem::remove_all(folder(), ignored);
    }
    TestCache(const TestCache&) = delete;
    TestCache& operator=(const TestCache&) = delete;
    [[nodiscard]] static std::filesystem::path folder() {
        return std::filesystem::temp_directory_path() / ("dermis_test_bust_" + std::to_string(getpid()));
    }
};

inline const Bust& standard_bust() {
    static const TestCache cache;
    static const Bust bust = make_bust().value();
    return bust;
}

inline const BustField& standard_field() {
    static const BustField field{BustParams{}};
    return field;
}

/// For every vertex, the first one at the same place: what a seam has cut apart is one again.
inline std::vector<uint32_t> welded(const Mesh& mesh) {
    std::map<std::array<float, 3>, uint32_t> first;
    std::vector<uint32_t> id;
    for (uint32_t i = 0; i < mesh.positions_mm.size(); ++i) {
        const Vec3 p = mesh.positions_mm[i];
        id.push_back(first.try_emplace({p.x, p.y, p.z}, i).first->second);
    }
    return id;
}

}  // namespace dermis
