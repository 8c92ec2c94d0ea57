#pragma once
// "yaw=30 pitch=5": short texts of key=value words, as --camera and --light take them.

#include <span>
#include <string>
#include <string_view>

#include "dermis/base/result.h"

namespace dermis {

/// One key: a number, or three separated by commas, in a closed range, read into and printed from `values`.
struct TextKey {
    std::string_view name, unit;
    double min = 0, max = 1;
    float* values = nullptr;
    int components = 1;
    bool* given = nullptr;  ///< set when the text names the key; may be null
};

/// Words separated by spaces, in any order; the last one of a key wins. Errors start with "WHAT:" and name
/// the key, its range, or what the unknown key may have been meant to be.
[[nodiscard]] Result<void> parse_key_values(std::string_view what, std::string_view text,
                                            std::span<const TextKey> keys);

/// All keys in order, numbers rounded to 1e-4.
[[nodiscard]] std::string key_value_text(std::span<const TextKey> keys);

}  // namespace dermis
