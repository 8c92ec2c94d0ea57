#pragma once
// The bust of default parameters, made once for all tests of this folder.

#include <array>
#include <map>

#include "dermis/bust/bust.h"
#include "dermis/bust/field.h"

namespace dermis {

inline constexpr int kTestMapSide = 512;

inline const Bust& standard_bust() {
    static const Bust bust = build_bust({}, kTestMapSide).value();
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
