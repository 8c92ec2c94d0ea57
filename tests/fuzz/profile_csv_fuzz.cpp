// A profile as CSV: a sum of Gaussians or a table.
// Dictionary: dermis/optics/profile_file.cpp dermis/optics/tabulated_profile.cpp dermis/optics/tool_rows.cpp

#include <cstdint>
#include <string_view>

#include "dermis/optics/profile_file.h"
#include "use_profile.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    dermis::fuzz::use_profile(dermis::parse_profile_csv(text, "fuzz.csv"));
    return 0;
}
