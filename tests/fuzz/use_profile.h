#pragma once
// What the targets that read profiles ask of any text: a profile whose functions all return, or an error of
// one line.

#include <cmath>
#include <cstdlib>

#include "dermis/base/result.h"
#include "dermis/optics/profile.h"

namespace dermis::fuzz {

inline void require(bool condition) {
    if (!condition) std::abort();
}

inline void use_profile(const Result<Profile>& profile) {
    if (!profile) {
        require(!profile.error().message.empty());
        require(profile.error().message.find('\n') == std::string::npos);
        return;
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
}

}  // namespace dermis::fuzz
