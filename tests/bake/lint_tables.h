#pragma once
// Tables as pictures, for the tests of the linter.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "dermis/bake/lut.h"
#include "dermis/bake/table.h"
#include "dermis/image/image.h"

namespace dermis::test {

inline Table baked(std::string_view convention, int width = 64, int height = 32) {
    LutOptions lut = *lut_options(convention);
    lut.width = width;
    lut.height = height;
    return *bake_lut(lut);
}

// Saved as by a tool without conventions, with `change` applied to the decoded values.
template <class Change>
Image picture_of(const Table& table, PixelFormat format, Change change) {
    Image image(table.width, table.height, 3);
    for (size_t i = 0; i < table.data.size(); ++i) image.floats()[i] = change(table.data[i]);
    return convert(image, format, Encoding::linear);
}

inline float as_it_is(float value) {
    return value;
}

inline bool mentions(const std::vector<std::string>& lines, std::string_view text) {
    return std::ranges::any_of(lines,
                               [&](const std::string& line) { return line.find(text) != std::string::npos; });
}

}  // namespace dermis::test
