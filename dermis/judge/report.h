#pragma once
// A comparison as one HTML file that needs nothing else: pictures inside, a wipe slider between any two,
// error maps, scores. A content security policy forbids it to load anything.

#include <string>

#include "dermis/judge/comparison.h"

namespace dermis::inline judge {

/// The page. A picture of 512 x 512 adds about 1 MB a technique (tone-mapped picture, FLIP, linear error, as
/// PNG). Errors: a picture that cannot be encoded.
[[nodiscard]] Result<std::string> report_html(const Scene& scene, const Comparison& comparison,
                                              const ComparisonSettings& settings);

/// RFC 4648, section 4.
[[nodiscard]] std::string base64(std::span<const std::byte> bytes);

}  // namespace dermis::inline judge
