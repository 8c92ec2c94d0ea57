// Sources of the spectra:
// - haemoglobin: S. Prahl, Tabulated Molar Extinction Coefficient for Hemoglobin in Water (Gratzer; Kollias),
//   every 10 nm as tabulated, between them the mean of the rows 1 nm to either side;
// - illuminant: CIE standard illuminant D65 every 10 nm, straight in between, as CIE 15:2004 has it;
// - observer: Wyman, Sloan, Shirley 2013, Simple Analytic Approximations to the CIE XYZ Color Matching
//   Functions, equation 4 (several lobes).

#include "dermis/optics/tissue/spectra.h"

#include <cmath>

#include "dermis/image/colour.h"

namespace dermis::inline optics::tissue {
namespace {

struct Extinction {
    double oxygenated, deoxygenated;  // molar, 1/(cm mol/l)
};

constexpr std::array<Extinction, kWavelengths> kHaemoglobin = {{
    {109564, 145232}, {130276, 151288}, {167748, 167780}, {221836, 196832}, {266232, 223296},
    {331462, 261958}, {466840, 303956}, {523080, 353222}, {480360, 407560}, {351134, 471520},
    {246072, 528600}, {149076, 549600}, {102580, 413280}, {78884, 259974},  {62816, 103292},
    {51524, 33434},   {44480, 23389},   {38440, 18702},   {33209, 16156},   {29482, 14921},
    {26629, 14550},   {24925, 15378},   {23684, 16684},   {22154, 18648},   {20933, 20862},
    {20182, 23289},   {20035, 25774},   {20715, 28682},   {24202, 31590},   {30883, 35171},
    {39957, 39036},   {48338, 42840},   {53236, 46592},   {50982, 50488},   {43016, 53412},
    {35646, 54530},   {32613, 53788},   {35205, 49700},   {44496, 45072},   {54424, 40904},
    {50104, 37020},   {30620, 33592},   {14401, 28324},   {6681, 21187},    {3200, 14677},
    {1959, 12040},    {1506, 9444},     {1166, 7553},     {942, 6510},      {741, 5763},
    {610, 5149},      {496, 4667},      {442, 4345},      {398, 4027},      {368, 3750},
    {340, 3481},      {320, 3227},      {306, 3011},      {294, 2795},      {284, 2591},
    {278, 2408},      {274, 2225},      {276, 2052},      {281, 1923},      {290, 1794},
    {300, 1661},      {314, 1540},      {329, 1433},      {348, 1326},      {368, 1224},
    {390, 1102},
}};

constexpr std::array<double, kWavelengths / 2 + 1> kD65 = {
    49.9755, 54.6482, 82.7549, 91.4860, 93.4318, 86.6823, 104.865, 117.008, 117.812,
    114.861, 115.923, 108.811, 109.354, 107.802, 104.790, 107.689, 104.405, 104.046,
    100.000, 96.3342, 95.7880, 88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992,
    80.0268, 80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.3490, 61.6040, 69.8856};

double d65(int i) {
    return i % 2 == 0 ? kD65[size_t(i / 2)] : 0.5 * (kD65[size_t(i / 2)] + kD65[size_t(i / 2 + 1)]);
}

double lobe(double nm, double mean, double below, double above) {
    const double t = (nm - mean) * (nm < mean ? below : above);
    return std::exp(-0.5 * t * t);
}

// The weights of one row of XYZ; white has Y = 1.
std::array<Rgb, kWavelengths> make_linear_weights() {
    std::array<Rgb, kWavelengths> xyz;
    Rgb white = {};
    for (int i = 0; i < kWavelengths; ++i) {
        const Rgb observer = observer_xyz(wavelength_nm(i));
        for (size_t c = 0; c < 3; ++c) {
            xyz[size_t(i)][c] = d65(i) * observer[c];
            white[c] += xyz[size_t(i)][c];
        }
    }
    // The fit of the observer puts white within 0.5 % of D65; dividing by it makes a white surface white.
    const Vec3 exact = kWhiteXyz;
    const Rgb wanted = {double(exact.x), double(exact.y), double(exact.z)};
    std::array<Rgb, kWavelengths> linear;
    for (size_t i = 0; i < kWavelengths; ++i) {
        Vec3 value = {float(xyz[i][0] * wanted[0] / white[0]), float(xyz[i][1] * wanted[1] / white[1]),
                      float(xyz[i][2] * wanted[2] / white[2])};
        value = kLinearFromXyz * value;
        linear[i] = {double(value.x), double(value.y), double(value.z)};
    }
    return linear;
}

}  // namespace

double blood_sigma_a_per_mm(int i, double oxygen) {
    // 2.303 e c / M in 1/cm: 150 g of haemoglobin in a litre of blood, 64,500 g/mol (Prahl).
    constexpr double kPerMm = 0.1 * 2.302585 * 150 / 64500;
    const Extinction& e = kHaemoglobin[size_t(i)];
    return kPerMm * (oxygen * e.oxygenated + (1 - oxygen) * e.deoxygenated);
}

// Jacques 2013, Optical properties of biological tissues: a review: cutaneous melanosomes.
double eumelanin_sigma_a_per_mm(int i) {
    return 51.9 * std::pow(wavelength_nm(i) / 500, -3.0);
}

// Donner, Jensen 2006, A Spectral BSSRDF for Shading Human Skin.
double pheomelanin_sigma_a_per_mm(int i) {
    return 2.9e14 * std::pow(wavelength_nm(i), -4.75);
}

// Jacques 1998, Skin Optics, section 1.1: skin without blood.
double baseline_sigma_a_per_mm(int i) {
    return 0.0244 + 8.53 * std::exp(-(wavelength_nm(i) - 154) / 66.2);
}

Rgb observer_xyz(double nm) {
    return {0.362 * lobe(nm, 442.0, 0.0624, 0.0374) + 1.056 * lobe(nm, 599.8, 0.0264, 0.0323) -
                0.065 * lobe(nm, 501.1, 0.0490, 0.0382),
            0.821 * lobe(nm, 568.8, 0.0213, 0.0247) + 0.286 * lobe(nm, 530.9, 0.0613, 0.0322),
            1.217 * lobe(nm, 437.0, 0.0845, 0.0278) + 0.681 * lobe(nm, 459.0, 0.0385, 0.0725)};
}

const std::array<Rgb, kWavelengths>& linear_weights() {
    static const std::array<Rgb, kWavelengths> kWeights = make_linear_weights();
    return kWeights;
}

}  // namespace dermis::inline optics::tissue
