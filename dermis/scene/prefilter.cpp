#include "dermis/scene/prefilter.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "dermis/base/angle.h"
#include "dermis/base/parallel.h"
#include "dermis/image/half.h"
#include "dermis/scene/hammersley.h"

namespace dermis::inline scene {
// With n = v the half vector h has density D(h) n.h, its reflection D(h) / 4.
PrefilteredLobe::PrefilteredLobe(const CubePyramid& environment, float roughness, uint32_t samples,
                                 float mirror_texel_sr)
    : environment_(environment) {
    const float texel_sr = cube_texel_solid_angle(environment.size());
    if (roughness <= 0) {
        samples_ = {{{0, 0, 1}, 1, 0.5f * std::log2(mirror_texel_sr / texel_sr)}};
        return;
    }
    const float alpha = roughness * roughness;
    float weight_sum = 0;
    for (uint32_t i = 0; i < samples; ++i) {
        const Vec2 xi = hammersley(i, samples);
        const Vec3 h = sample_ggx_half_vector(xi, alpha);
        const Vec3 l = {2 * h.z * h.x, 2 * h.z * h.y, 2 * h.z * h.z - 1};
        if (l.z <= 0) continue;
        const float d = h.z * h.z * (alpha * alpha - 1) + 1;
        const float density = alpha * alpha / (kPi * d * d) / 4;
        const float sample_sr = 1 / (float(samples) * density);
        const float level = 0.5f * std::log2(sample_sr / texel_sr);
        samples_.push_back({l, l.z, std::max(level, 0.0f)});
        weight_sum += l.z;
    }
    for (Sample& sample : samples_) sample.weight /= weight_sum;
}

Vec3 PrefilteredLobe::reflected(Vec3 n) const {
    const Vec3 side = normalize(cross(std::abs(n.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, n));
    const Vec3 up = cross(n, side);
    Vec3 sum;
    for (const Sample& sample : samples_)
        sum += environment_.sample(side * sample.l.x + up * sample.l.y + n * sample.l.z, sample.level) *
               sample.weight;
    return sum;
}

uint32_t prefilter_samples(int level) {
    return level == 1 ? 256 : level == 2 ? 512 : 1024;
}

size_t prefiltered_bytes(int base_size, int mips) {
    size_t texels = 0;
    for (int mip = 0; mip < mips; ++mip)
        texels += size_t(6) * size_t(base_size >> mip) * size_t(base_size >> mip);
    return texels * 4 * sizeof(uint16_t);
}

std::vector<std::byte> prefilter_ggx(const CubePyramid& environment, int base_size, int mips) {
    std::vector<std::byte> bytes(prefiltered_bytes(base_size, mips));
    size_t offset = 0;
    for (int mip = 0; mip < mips; ++mip) {
        const int size = base_size >> mip;
        const float roughness = mips > 1 ? float(mip) / float(mips - 1) : 0;
        const PrefilteredLobe lobe(environment, roughness, prefilter_samples(mip),
                                   cube_texel_solid_angle(size));
        parallel_for(size_t(6 * size), 1, [&](size_t begin, size_t end) {
            for (size_t row = begin; row < end; ++row)
                for (int x = 0; x < size; ++x) {
                    const int face = int(row) / size, y = int(row) % size;
                    const Vec3 n = normalize(cube_direction(face, (float(x) + 0.5f) / float(size),
                                                            (float(y) + 0.5f) / float(size)));
                    const Vec3 c = lobe.reflected(n);
                    const uint16_t texel[4] = {to_half(c.x), to_half(c.y), to_half(c.z), to_half(1)};
                    std::memcpy(&bytes[offset + (row * size_t(size) + size_t(x)) * sizeof texel], texel,
                                sizeof texel);
                }
        });
        offset += size_t(6) * size_t(size) * size_t(size) * 4 * sizeof(uint16_t);
    }
    return bytes;
}

}  // namespace dermis::inline scene
