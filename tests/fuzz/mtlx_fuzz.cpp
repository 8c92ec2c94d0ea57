// A profile as a MaterialX document.
// Dictionary: dermis/optics/mtlx.cpp dermis/optics/tool_rows.cpp

#include <cstdint>
#include <string_view>

#include "dermis/optics/mtlx.h"
#include "use_profile.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    dermis::fuzz::use_profile(dermis::parse_mtlx(text, "fuzz.mtlx"));
    return 0;
}
