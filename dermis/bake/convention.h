#pragma once
// A table's convention: the meaning of its numbers, stored inside the file and beside it.
//
// Pre-integrated tables from different tools differ by up to 0.2, because the files do not state integral,
// axes and encoding. The convention is one value, written as JSON and compared key by key.

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "dermis/optics/preintegration.h"

namespace dermis::inline bake {

enum class TableKind {
    diffuse,          ///< u = N.L, v = curvature or radius: pre-integrated diffuse light, about 0..1
    zonal_harmonics,  ///< u = curvature or radius, v = order: zh_0, zh_1, zh_2, 0..1.03
    beckmann,         ///< u = N.H, v = roughness m: exp(-tan^2/m^2) / (m^2 cos^4), one channel, unbounded
    shadow            ///< u = penumbra position, v = penumbra width: scattered visibility, 0..1
};

/// linear: value = min + (max - min) s; squared: min + (max - min) s^2, finer near min.
enum class AxisWarp { linear, squared };

/// Where in its cell a texel was evaluated: s = (i + 1/2) / n, i / n, or (i + 1) / n. Only `centre` is what a
/// GPU's filtering reads back; the others are what published code does.
enum class TexelSampling { centre, low_edge, high_edge };

struct TableAxis {
    std::string name;         ///< with its unit: "n_dot_l", "curvature_per_mm", "radius_mm", "order", ...
    std::string unit;         ///< "1", "1/mm", "mm"
    double min = 0, max = 1;  ///< at the first and the last texel's outer edge; min > max is a mirrored axis
    AxisWarp warp = AxisWarp::linear;
    TexelSampling sampling = TexelSampling::centre;

    [[nodiscard]] double value(double texel, int count) const;
    /// Inverse of value(): a texel index with fraction, not clamped.
    [[nodiscard]] double texel(double value, int count) const;
    friend bool operator==(const TableAxis&, const TableAxis&) = default;
};

/// Whether the file's first row (always the top of the picture) is v = 0 or v = 1.
enum class VOrigin { top, bottom };

enum class TableEncoding {
    linear,      ///< the value
    srgb,        ///< IEC 61966-2-1 curve of the value: what 8 bits need
    range,       ///< (value - encoded_min) / (encoded_max - encoded_min)
    difference,  ///< 2 (value - max(0, N.L)) + 1/2, clamped to 0..1 (FaceWorks)
    tenth_power  ///< value^0.1 / 2 (the Beckmann texture of GPU Gems 3, chapter 14)
};

/// How the integral was taken: exactly, or by the taps of one published program (bake/lut.h says which).
enum class Integration { exact, unity_taps, faceworks_taps };

struct Convention {
    TableKind kind = TableKind::diffuse;
    std::array<TableAxis, 2> axes;  ///< u (columns), v (rows)
    VOrigin v_origin = VOrigin::top;
    TableEncoding encoding = TableEncoding::linear;
    double encoded_min = 0, encoded_max = 1;  ///< of encoding `range`
    Preintegration how = {};
    Integration integration = Integration::exact;
    double shadow_sharpening = 1;  ///< of shadow tables: bake/shadow_table.h
    std::string profile;           ///< empty for beckmann
    std::string tool;              ///< "dermis 0.1.0"
};

/// The value as the file holds it and back; `n_dot_l` is used by `difference` only.
[[nodiscard]] double encode_value(const Convention& convention, double value, double n_dot_l);
[[nodiscard]] double decode_value(const Convention& convention, double stored, double n_dot_l);

/// Difference from max(0, N.L) beyond which `difference` cuts.
inline constexpr double kMostDifference = 0.25;

/// One JSON object, keys in a fixed order: same convention, same bytes.
[[nodiscard]] std::string convention_json(const Convention& convention, int width, int height);

struct ParsedConvention {
    Convention convention;
    int width = 0, height = 0;
};
/// Errors name `place` and the key: no JSON, a missing or unknown key, a value outside its range.
[[nodiscard]] Result<ParsedConvention> parse_convention(std::string_view text, std::string_view place);

/// The requirements of a use; an empty field accepts anything.
struct TableUse {
    std::optional<TableKind> kind = std::nullopt;
    std::optional<Construction> construction = std::nullopt;
    std::string u_axis = {}, v_axis = {};  ///< axis names
    std::string profile = {};
};

/// Success, or which key differs: "lut.png: convention key 'axes[1].name' is 'radius_mm', this use needs
/// 'curvature_per_mm'".
[[nodiscard]] Result<void> check_use(const Convention& convention, const TableUse& use,
                                     std::string_view place);

/// Names as JSON and the command line have them.
[[nodiscard]] std::string_view name_of(TableKind kind);
[[nodiscard]] std::string_view name_of(AxisWarp warp);
[[nodiscard]] std::string_view name_of(TexelSampling sampling);
[[nodiscard]] std::string_view name_of(VOrigin origin);
[[nodiscard]] std::string_view name_of(TableEncoding encoding);
[[nodiscard]] std::string_view name_of(Integration integration);
[[nodiscard]] std::string_view name_of(Construction construction);
[[nodiscard]] std::string_view name_of(RingWeights weights);
[[nodiscard]] Result<Construction> find_construction(std::string_view name);
[[nodiscard]] Result<AxisWarp> find_warp(std::string_view name);

/// "dermis 0.1.0".
[[nodiscard]] std::string tool_version();

}  // namespace dermis::inline bake
