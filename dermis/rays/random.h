#pragma once
// Random numbers that depend on (seed, stream, index) alone: a picture is the same for any number of threads.
//
// Two kinds. OwenSequence: Owen-scrambled Sobol points for integrals of few dimensions, where even cover
// pays. Pcg32: plain independent numbers for random walks, whose length is not bounded.

#include <cstdint>

#include "dermis/base/vec.h"

namespace dermis {

/// Two multiply-xorshift rounds; every input bit reaches every output bit (Ellis 2018, "lowbias32").
[[nodiscard]] constexpr uint32_t hash_u32(uint32_t x) {
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}
[[nodiscard]] constexpr uint32_t hash_u32(uint32_t a, uint32_t b) {
    return hash_u32(a ^ (hash_u32(b + 0x9e3779b9u) + (a << 6) + (a >> 2)));
}
[[nodiscard]] constexpr uint32_t hash_u32(uint32_t a, uint32_t b, uint32_t c) {
    return hash_u32(hash_u32(a, b), c);
}

/// The top 24 bits as a number in [0, 1).
[[nodiscard]] constexpr float unit_float(uint32_t bits) {
    return float(bits >> 8) * 0x1p-24f;
}

/// PCG-XSH-RR 64/32 (O'Neill 2014). Period 2^64; different streams do not overlap.
class Pcg32 {
  public:
    Pcg32(uint32_t seed, uint32_t stream) : increment_((uint64_t{stream} << 1) | 1) {
        next_u32();
        state_ += (uint64_t{hash_u32(seed)} << 32) | seed;
        next_u32();
    }

    uint32_t next_u32() {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005ull + increment_;
        const auto xored = uint32_t(((old >> 18) ^ old) >> 27);
        const auto turn = uint32_t(old >> 59);
        return (xored >> turn) | (xored << ((32 - turn) & 31));
    }
    /// In [0, 1).
    float next_1d() { return unit_float(next_u32()); }
    Vec2 next_2d() {
        const float x = next_1d();
        return {x, next_1d()};
    }

  private:
    uint64_t state_ = 0;
    uint64_t increment_;
};

/// Point `index` of a randomised (0,2)-sequence, a pair of dimensions at a time; pairs are independent
/// shuffles of the same two Sobol dimensions. The first 2^k points of a pair fall one into each of 2^k boxes
/// of any elementary shape. Source: Burley 2020, Practical Hash-based Owen Scrambling, sections 3 and 4.
class OwenSequence {
  public:
    OwenSequence(uint32_t seed, uint32_t index) : seed_(seed), index_(index) {}

    /// In [0, 1)^2.
    Vec2 next_2d() {
        const uint32_t pair_seed = hash_u32(seed_, pair_++);
        const uint32_t index = owen_scramble(index_, pair_seed);
        return {unit_float(owen_scramble(reverse_bits(index), hash_u32(pair_seed, 1))),
                unit_float(owen_scramble(sobol_second(index), hash_u32(pair_seed, 2)))};
    }
    float next_1d() { return next_2d().x; }

  private:
    static constexpr uint32_t reverse_bits(uint32_t x) {
        x = (x << 16) | (x >> 16);
        x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
        x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
        x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
        return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
    }
    /// Each bit is flipped by a hash of the bits above it: Laine and Karras's permutation works from the
    /// lowest bit up, hence the reversals.
    static constexpr uint32_t owen_scramble(uint32_t x, uint32_t seed) {
        x = reverse_bits(x);
        x += seed;
        x ^= x * 0x6c50b47cu;
        x ^= x * 0xb82f1e52u;
        x ^= x * 0xc7afe638u;
        x ^= x * 0x8d22f6e6u;
        return reverse_bits(x);
    }
    /// The second dimension's direction numbers: each is the one before xor itself shifted by one.
    static constexpr uint32_t sobol_second(uint32_t index) {
        uint32_t result = 0;
        for (uint32_t direction = 0x80000000u; index != 0; index >>= 1, direction ^= direction >> 1)
            if (index & 1) result ^= direction;
        return result;
    }

    uint32_t seed_;
    uint32_t index_;
    uint32_t pair_ = 0;
};

}  // namespace dermis
