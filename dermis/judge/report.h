#pragma once
// A comparison as one HTML file that needs nothing else: pictures inside, a wipe slider between any two,
// error maps, scores. A content security policy forbids it to load anything.

#include <string>

#include "dermis/base/vec.h"
#include "dermis/image/image.h"
#include "dermis/judge/comparison.h"

namespace dermis::inline judge {

/// The page. A picture of 512 x 512 adds about 1 MB a technique (tone-mapped picture, FLIP, linear error, as
/// PNG). Errors: a picture that cannot be encoded.
[[nodiscard]] Result<std::string> report_html(const Scene& scene, const Comparison& comparison,
                                              const ComparisonSettings& settings);

/// RFC 4648, section 4.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

// Numbers as colours: black, violet, red, orange, pale yellow, of evenly rising lightness; and signed ones
// from blue over black to red.

/// 0 to 1 (clamped) to sRGB-encoded colour.
[[nodiscard]] Vec3 heat_color(float value);

/// A one-channel map as u8 sRGB: `full` and above is the brightest colour; outside the mask a neutral grey.
[[nodiscard]] Image heat_map(const Image& values, double full, const Image& mask);

/// -1 to 1 (clamped) to sRGB-encoded colour: blue below 0, red above, black at 0, lightness by the size.
[[nodiscard]] Vec3 signed_color(float value);

/// The mean of an RGB map's channels as u8 sRGB: `full` and above is the reddest colour, -full and below the
/// bluest; outside the mask a neutral grey.
[[nodiscard]] Image signed_map(const Image& rgb, double full, const Image& mask);

}  // namespace dermis::inline judge
