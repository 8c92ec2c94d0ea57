#include "dermis/optics/tissue/pigment_maps.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dermis/base/parallel.h"
#include "dermis/image/colour.h"

namespace dermis::inline optics {
namespace {

constexpr double kResidueStops = 16;

double factor_of(double value) {
    return std::exp2((value - 0.5) * kResidueStops);
}
double value_of_factor(double factor) {
    return 0.5 + std::log2(factor) / kResidueStops;
}

Rgb linear_texel(const Image& image, int x, int y) {
    Rgb rgb;
    for (int c = 0; c < 3; ++c) {
        const float value = image.at(x, y, image.channels >= 3 ? c : 0);
        rgb[size_t(c)] = double(image.encoding == Encoding::srgb ? srgb_decode(value) : value);
    }
    return rgb;
}

// Bilinear, for a mask of another size.
double mask_at(const Image& mask, double u, double v) {
    const double px = u * mask.width - 0.5, py = v * mask.height - 0.5;
    const int x = int(std::floor(px)), y = int(std::floor(py));
    const auto at = [&](int i, int j) {
        return double(mask.at(std::clamp(i, 0, mask.width - 1), std::clamp(j, 0, mask.height - 1), 0));
    };
    const double s = px - x, t = py - y;
    return (1 - t) * ((1 - s) * at(x, y) + s * at(x + 1, y)) +
           t * ((1 - s) * at(x, y + 1) + s * at(x + 1, y + 1));
}

Pigments pigments_at(const PigmentPainting& painting, int x, int y) {
    Pigments pigments = painting.missing;
    if (!painting.maps->melanin.empty())
        pigments.melanin = pigment_fraction(double(painting.maps->melanin.at(x, y, 0)), kMostMelanin);
    if (!painting.maps->blood.empty())
        pigments.blood = pigment_fraction(double(painting.maps->blood.at(x, y, 0)), kMostBlood);
    return pigments;
}

Pigments edited(const Pigments& p, const SkinEdit& edit, double mask, const Pigments& mean) {
    const auto mixed = [mask](double from, double to) { return from + mask * (to - from); };
    const double uneven = mean.melanin + (p.melanin - mean.melanin) * (1 + edit.age);
    const double melanin = std::max(0.0, uneven) + kTanMelanin * edit.tan;
    constexpr double kBloodOfAge = 1.0 / 3;
    const double blood =
        p.blood * (1 - edit.pallor) * (1 - kBloodOfAge * edit.age) + kBlushBlood * edit.blush;
    return {mixed(p.melanin, melanin * edit.melanin_scale),
            mixed(p.blood, std::max(0.0, blood) * edit.blood_scale)};
}

// The first of the maps, whose size counts.
Result<const Image*> size_of(const PigmentMaps& maps) {
    const Image* first = nullptr;
    for (const Image* map : {&maps.melanin, &maps.blood, &maps.residue}) {
        if (map->empty()) continue;
        if (!first) first = map;
        if (map->width != first->width || map->height != first->height)
            return Error{"maps of pigments have different sizes, " + std::to_string(first->width) + " x " +
                         std::to_string(first->height) + " and " + std::to_string(map->width) + " x " +
                         std::to_string(map->height) + "; bake them from one albedo map"};
    }
    if (!first) return Error{"no map of melanin or blood"};
    return first;
}

void over_rows(int height, int width, const PigmentProgress& progress,
               const std::function<void(int y)>& row) {
    parallel_for(size_t(height), 4, [&](size_t begin, size_t end) {
        for (size_t y = begin; y < end; ++y) {
            row(int(y));
            if (progress) progress(size_t(width));
        }
    });
}

void set_residue(PigmentMaps& maps, int x, int y, const Rgb& wanted, const PigmentTable& table) {
    const Rgb made = table.albedo(pigments_at({.maps = &maps}, x, y));
    constexpr double kLeast = 1.0 / 8192;
    for (size_t c = 0; c < 3; ++c)
        maps.residue.set(x, y, int(c), float(value_of_factor(std::max(wanted[c], kLeast) / made[c])));
}

}  // namespace

void add_residue(PigmentMaps& maps, const Image& albedo, const PigmentTable& table) {
    maps.residue = Image(albedo.width, albedo.height, 3, PixelFormat::u16);
    over_rows(albedo.height, albedo.width, {}, [&](int y) {
        for (int x = 0; x < albedo.width; ++x) set_residue(maps, x, y, linear_texel(albedo, x, y), table);
    });
}

PigmentMaps pigment_maps_of(const Image& albedo, const PigmentTable& table, double exposure,
                            const PigmentProgress& progress) {
    PigmentMaps maps{Image(albedo.width, albedo.height, 1, PixelFormat::u16),
                     Image(albedo.width, albedo.height, 1, PixelFormat::u16),
                     Image(albedo.width, albedo.height, 3, PixelFormat::u16)};
    over_rows(albedo.height, albedo.width, progress, [&](int y) {
        for (int x = 0; x < albedo.width; ++x) {
            const Rgb wanted = linear_texel(albedo, x, y);
            const Pigments found =
                table.nearest({wanted[0] / exposure, wanted[1] / exposure, wanted[2] / exposure});
            maps.melanin.set(x, y, 0, float(pigment_texel(found.melanin, kMostMelanin)));
            maps.blood.set(x, y, 0, float(pigment_texel(found.blood, kMostBlood)));
            // The residue belongs to the pigments after rounding to 16 bits.
            set_residue(maps, x, y, wanted, table);
        }
    });
    return maps;
}

Pigments mean_pigments(const PigmentPainting& painting) {
    const auto mean = [&](const Image& map, double most, double missing) {
        if (map.empty()) return missing;
        std::vector<float> values;
        const int stride = std::max(1, std::max(map.width, map.height) / 256);
        for (int y = 0; y < map.height; y += stride)
            for (int x = 0; x < map.width; x += stride) values.push_back(map.at(x, y, 0));
        std::sort(values.begin(), values.end());
        double sum = 0;
        const size_t first = values.size() / 10, last = values.size() - first;
        for (size_t i = first; i < last; ++i) sum += pigment_fraction(double(values[i]), most);
        return sum / double(last - first);
    };
    return {mean(painting.maps->melanin, kMostMelanin, painting.missing.melanin),
            mean(painting.maps->blood, kMostBlood, painting.missing.blood)};
}

Result<Image> albedo_of(const PigmentPainting& painting, const PigmentTable& table,
                        const PigmentProgress& progress) {
    DERMIS_TRY_ASSIGN(const Image* const first, size_of(*painting.maps));
    const int width = first->width, height = first->height;
    const Pigments mean = mean_pigments(painting);
    const bool unedited = painting.edit == SkinEdit{};
    Image out(width, height, 3, PixelFormat::u8, Encoding::srgb);
    over_rows(height, width, progress, [&](int y) {
        for (int x = 0; x < width; ++x) {
            Pigments pigments = pigments_at(painting, x, y);
            const double mask =
                painting.mask ? mask_at(*painting.mask, (x + 0.5) / width, (y + 0.5) / height) : 1;
            if (!unedited) pigments = edited(pigments, painting.edit, mask, mean);
            const Rgb made = table.albedo(pigments);
            for (int c = 0; c < 3; ++c) {
                const double factor = painting.maps->residue.empty()
                                          ? 1
                                          : factor_of(double(painting.maps->residue.at(x, y, c)));
                out.set(x, y, c, srgb_encode(float(made[size_t(c)] * factor)));
            }
        }
    });
    return out;
}

}  // namespace dermis::inline optics
