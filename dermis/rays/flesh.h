#pragma once
// Selects the skin surfaces that enclose flesh. Scans have empty eye sockets and mouths; the inner faces of
// such cavities are not skin, and the cavities count as flesh.
//
// A face is hidden if no ray that leaves it reaches the outside. The hidden part grows over neighbours that
// see almost nothing (the inner side of closed lips), includes what it encloses, and loses patches too small
// to be a cavity (bottoms of creases). Caps close the holes where hidden faces were and where the mesh is
// open (a neck); walks are reflected by caps, as if the flesh continued behind them. A sheet, which encloses
// almost nothing, is the front of a body: its caps are walls and a floor behind it.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "dermis/base/result.h"
#include "dermis/base/vec.h"
#include "dermis/scene/scene.h"

namespace dermis::inline rays {

/// Below this volume over area skin is a sheet; the body behind it is so deep, more than light goes in skin.
inline constexpr double kSheetMm = 0.2, kSheetDepthMm = 30;

/// A face of skin: seen by the outside; the inner side of a cavity; or inside another part's flesh.
enum class SkinFace : uint8_t { visible, cavity, buried };

struct Flesh {
    std::vector<SkinFace> faces;            ///< one a triangle of the mesh; `visible` for what is not skin
    std::vector<std::array<Vec3, 3>> caps;  ///< mm, facing out; those of cavities first
    size_t cavity_caps = 0;                 ///< how many: the others close openings of the mesh
    size_t hidden_triangles = 0;
    double hidden_area_mm2 = 0, skin_area_mm2 = 0;  ///< the second with the hidden part
    size_t mesh_openings = 0;                       ///< closed borders of the skin as the mesh has it
    bool is_sheet = false;                          ///< encloses almost nothing: its caps lie behind it
};

/// Treatment of cavities: flesh, or open as in the mesh, with their inner faces counted as skin.
enum class Cavities { flesh, open };

/// Every object by itself: its own opaque triangles hide its skin, other objects do not. Deterministic,
/// cached by content. Cost: 17,684 triangles in 0.3 s, 135,328 in 1.5 s on two cores. Errors: the ray library
/// fails.
[[nodiscard]] Result<std::vector<Flesh>> find_flesh(std::span<const SceneObject> objects,
                                                    Cavities cavities = Cavities::flesh);

/// Where walks start: the visible triangles of skin that have an area.
[[nodiscard]] std::vector<bool> walked_triangles(const SceneObject& object, const Flesh& flesh);
/// The error where there are none, or none of the walks return.
inline constexpr const char* kNoWalkedSkin = "there is no skin that returns light to the outside";

}  // namespace dermis::inline rays
