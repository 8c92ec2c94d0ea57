// Any text gives a profile whose functions all return, or an error of one line.
// Dictionary: dermis/optics/mtlx.cpp dermis/optics/tool_rows.cpp

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "dermis/optics/mtlx.h"

namespace {

void require(bool condition) {
    if (!condition) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace dermis;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const Result<Profile> profile = parse_mtlx(text, "fuzz.mtlx");
    if (!profile) {
        require(!profile.error().message.empty());
        require(profile.error().message.find('\n') == std::string::npos);
        return 0;
    }
    require(bool(check(*profile)));
    require(profile->source.find('\n') == std::string::npos);
    for (int c = 0; c < 3; ++c) {
        require(diffuse_albedo(*profile, c) >= 0);
        const double median_mm = inverse_cdf_mm(*profile, c, 0.5);
        require(median_mm >= 0 && std::isfinite(median_mm));
        require(std::isfinite(mean_radius_mm(*profile, c)));
        require(reflectance_per_mm2(*profile, c, median_mm) >= 0);
        const double transmitted = slab_transmittance(*profile, c, 1);
        require(transmitted >= 0 && transmitted <= 1);
    }
    return 0;
}
