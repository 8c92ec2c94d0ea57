#pragma once
// Random numbers that depend on (seed, stream, index) alone: a picture is the same for any number of threads.
//
// Two kinds. OwenSequence: Owen-scrambled Sobol points for integrals of few dimensions, where even cover
// pays. Pcg32: plain independent numbers for random walks, whose length is not bounded.

#include <cstdint>

#include "dermis/base/vec.h"

namespace dermis::inline rays {

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

/// Fills [0, 1) evenly over successive indices, from a start by chance: steps of the golden ratio (Weyl
/// 1916).
[[nodiscard]] constexpr float golden_1d(uint32_t start, uint32_t index) {
    return unit_float(start + index * 0x9e3779b9u);
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
    OwenSequence(uint32_t seed, uint32_t index) : seed_(seed), reversed_index_(reverse_bits(index)) {}

    /// In [0, 1)^2.
    Vec2 next_2d() {
        const uint32_t pair_seed = hash_u32(seed_, pair_++);
        const uint32_t index = shuffled_index(pair_seed);
        return {first(index, pair_seed), second(index, pair_seed)};
    }
    float next_1d() {
        const uint32_t pair_seed = hash_u32(seed_, pair_++);
        return first(shuffled_index(pair_seed), pair_seed);
    }

  private:
    static constexpr uint32_t reverse_bits(uint32_t x) {
        x = (x << 16) | (x >> 16);
        x = ((x & 0x00ff00ffu) << 8) | ((x & 0xff00ff00u) >> 8);
        x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
        x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
        return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
    }
    /// Owen scrambling flips each bit by a hash of the bits above it; Laine and Karras's permutation works
    /// from the lowest bit up. So points are kept with their bits reversed until the end.
    static constexpr uint32_t scramble_reversed(uint32_t x, uint32_t seed) {
        x += seed;
        x ^= x * 0x6c50b47cu;
        x ^= x * 0xb82f1e52u;
        x ^= x * 0xc7afe638u;
        return x ^ (x * 0x8d22f6e6u);
    }
    /// The second dimension, reversed. Its direction numbers are each the one before xor itself shifted by
    /// one, which makes Pascal's triangle modulo 2: bit m of the result is the sum over all bits b of the
    /// index whose number has the bits of m (Lucas: the binomial of b over m is then odd). Summed a bit of
    /// the numbers at a time.
    static constexpr uint32_t sobol_second_reversed(uint32_t index) {
        index ^= (index >> 1) & 0x55555555u;
        index ^= (index >> 2) & 0x33333333u;
        index ^= (index >> 4) & 0x0f0f0f0fu;
        index ^= (index >> 8) & 0x00ff00ffu;
        return index ^ (index >> 16);
    }
    [[nodiscard]] uint32_t shuffled_index(uint32_t pair_seed) const {
        return reverse_bits(scramble_reversed(reversed_index_, pair_seed));
    }
    /// The first dimension is the index reversed, so that its own reversal is the index.
    [[nodiscard]] static float first(uint32_t index, uint32_t pair_seed) {
        return unit_float(reverse_bits(scramble_reversed(index, hash_u32(pair_seed, 1))));
    }
    [[nodiscard]] static float second(uint32_t index, uint32_t pair_seed) {
        const uint32_t reversed = sobol_second_reversed(index);
        return unit_float(reverse_bits(scramble_reversed(reversed, hash_u32(pair_seed, 2))));
    }

    uint32_t seed_;
    uint32_t reversed_index_;
    uint32_t pair_ = 0;
};

}  // namespace dermis::inline rays
