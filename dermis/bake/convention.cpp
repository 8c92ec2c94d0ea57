#include "dermis/bake/convention.h"

#include <algorithm>
#include <cmath>

#include "dermis/image/colour.h"

namespace dermis::inline bake {

double TableAxis::value(double texel, int count) const {
    const double offset = sampling == TexelSampling::centre     ? 0.5
                          : sampling == TexelSampling::low_edge ? 0
                                                                : 1;
    const double s = (texel + offset) / count;
    return min + (max - min) * (warp == AxisWarp::squared ? s * s : s);
}

double TableAxis::texel(double value, int count) const {
    const double offset = sampling == TexelSampling::centre     ? 0.5
                          : sampling == TexelSampling::low_edge ? 0
                                                                : 1;
    const double s = (value - min) / (max - min);
    return (warp == AxisWarp::squared ? std::sqrt(std::max(0.0, s)) : s) * count - offset;
}

double encode_value(const Convention& convention, double value, double n_dot_l) {
    switch (convention.encoding) {
        case TableEncoding::linear:
            return value;
        case TableEncoding::srgb:
            return srgb_encode(float(value));
        case TableEncoding::range:
            return (value - convention.encoded_min) / (convention.encoded_max - convention.encoded_min);
        case TableEncoding::difference:
            return std::clamp(2 * (value - std::max(0.0, n_dot_l)) + 0.5, 0.0, 1.0);
        case TableEncoding::tenth_power:
            return 0.5 * std::pow(std::max(0.0, value), 0.1);
    }
    return value;
}

double decode_value(const Convention& convention, double stored, double n_dot_l) {
    switch (convention.encoding) {
        case TableEncoding::linear:
            return stored;
        case TableEncoding::srgb:
            return srgb_decode(float(stored));
        case TableEncoding::range:
            return convention.encoded_min + stored * (convention.encoded_max - convention.encoded_min);
        case TableEncoding::difference:
            return 0.5 * (stored - 0.5) + std::max(0.0, n_dot_l);
        case TableEncoding::tenth_power:
            return std::pow(2 * std::max(0.0, stored), 10);
    }
    return stored;
}

namespace {

template <class T>
Error differs(std::string_view place, std::string_view key, const T& is, const T& needed) {
    return Error{std::string(place) + ": convention key '" + std::string(key) + "' is '" + std::string(is) +
                 "', this use needs '" + std::string(needed) + "'"};
}

}  // namespace

Result<void> check_use(const Convention& convention, const TableUse& use, std::string_view place) {
    if (use.kind && *use.kind != convention.kind)
        return differs(place, "kind", name_of(convention.kind), name_of(*use.kind));
    if (use.construction && *use.construction != convention.how.construction)
        return differs(place, "construction", name_of(convention.how.construction),
                       name_of(*use.construction));
    if (!use.u_axis.empty() && use.u_axis != convention.axes[0].name)
        return differs(place, "axes[0].name", convention.axes[0].name, use.u_axis);
    if (!use.v_axis.empty() && use.v_axis != convention.axes[1].name)
        return differs(place, "axes[1].name", convention.axes[1].name, use.v_axis);
    if (!use.profile.empty() && use.profile != convention.profile)
        return differs(place, "profile", convention.profile, use.profile);
    return {};
}

std::string tool_version() {
    return "dermis " DERMIS_VERSION;
}

}  // namespace dermis::inline bake
