#pragma once
// The spectra of the skin model: what blood, melanin and tissue absorb, the eye and the daylight. 380 to
// 730 nm in steps of 5 nm; an index i counts the steps.

#include <array>

#include "dermis/base/vec.h"

namespace dermis::inline optics::tissue {

inline constexpr int kWavelengths = 71;
inline constexpr double kFirstNm = 380, kStepNm = 5;
constexpr double wavelength_nm(int i) {
    return kFirstNm + kStepNm * i;
}

/// Absorption of pure blood, 150 g/l of haemoglobin; oxygen: its saturation 0..1.
[[nodiscard]] double blood_sigma_a_per_mm(int i, double oxygen);
/// Absorption of melanosomes that are filled with one kind of melanin.
[[nodiscard]] double eumelanin_sigma_a_per_mm(int i);
[[nodiscard]] double pheomelanin_sigma_a_per_mm(int i);
/// Absorption of skin without blood and melanin.
[[nodiscard]] double baseline_sigma_a_per_mm(int i);

/// CIE 1931 2 degree observer.
[[nodiscard]] Rgb observer_xyz(double nm);

/// The share of each wavelength in linear Rec. 709 red, green, blue under D65; the shares of a channel sum to
/// 1. Some are negative, because spectral colours lie outside of Rec. 709.
[[nodiscard]] const std::array<Rgb, kWavelengths>& linear_weights();

}  // namespace dermis::inline optics::tissue
