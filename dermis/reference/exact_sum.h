#pragma once
// A sum of real numbers that does not depend on their order or grouping.
//
// A sum is an integer of 128 bits that counts units of 2^-64. Addition of integers is exact, so any split of
// the numbers gives the same sum. Only add() rounds, each number by itself: one of float precision is exact
// from 2^-41 up, a smaller one is rounded to the unit. The sum may reach 2^60; the integer overflows at 2^63.

#include <cmath>
#include <cstdint>

namespace dermis::inline reference {

class ExactSum {
  public:
    static constexpr double kMost = 0x1p60;

    /// `value` within +-kMost.
    void add(double value) { units_ += Units(std::nearbyint(value * 0x1p64)); }
    ExactSum& operator+=(const ExactSum& other) {
        units_ += other.units_;
        return *this;
    }
    ExactSum& operator-=(const ExactSum& other) {
        units_ -= other.units_;
        return *this;
    }
    friend bool operator==(const ExactSum&, const ExactSum&) = default;

    [[nodiscard]] bool is_zero() const { return units_ == 0; }
    /// The nearest double.
    [[nodiscard]] double value() const { return double(units_) * 0x1p-64; }
    /// The rounding error of value(), to the nearest double: together they have 106 bits.
    [[nodiscard]] double remainder() const { return double(units_ - Units(double(units_))) * 0x1p-64; }

    /// Takes the nearest float out of the sum. Six calls at most leave zero; add() of what they returned
    /// gives the sum again.
    float take_float() {
        const auto leading = float(units_);
        units_ -= Units(leading);
        return leading * 0x1p-64f;
    }

  private:
    __extension__ using Units = __int128;
    Units units_ = 0;
};

}  // namespace dermis::inline reference
