#include "dermis/shading/literals.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "dermis/base/text.h"

namespace dermis::shading::export_text {

std::string literal(double value) {
    std::array<char, 32> digits{};
    const auto end =
        std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 6).ptr;
    std::string text(digits.data(), end);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text;
}

std::string vec3_literal(const Rgb& rgb) {
    return "vec3(" + literal(rgb[0]) + ", " + literal(rgb[1]) + ", " + literal(rgb[2]) + ")";
}

std::string vec3_constant(const std::string& name, const Rgb& value) {
    return "const vec3 " + name + " = " + vec3_literal(value) + ";\n";
}

std::string percent(double part) {
    const double rounded = double(int(part * 1e4 + 0.5)) / 100;
    return to_text(float(rounded)) + " %";
}

std::string error_text(double error) {
    const double unit = std::pow(10.0, std::floor(std::log10(std::max(error, 1e-6))) - 1);
    return literal(std::ceil(error / unit) * unit);
}

}  // namespace dermis::shading::export_text
