#pragma once
// The one wording for a number outside its range.

#include <string>

#include "dermis/base/result.h"
#include "dermis/base/text.h"

namespace dermis::inline optics {

inline std::string channel_name(int channel) {
    return channel == 0 ? "red" : channel == 1 ? "green" : "blue";
}

/// "variance_mm2 of term 3 is -0.5; it must be > 0"
inline Error out_of_range(const std::string& what, double value, const std::string& range) {
    return {what + " is " + to_text(value) + "; it must be " + range};
}

}  // namespace dermis::inline optics
