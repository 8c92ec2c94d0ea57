// A table of another tool as CSV, which lint takes as a picture of at most as many texels as there are lines.
// Dictionary: dermis/bake/lint_file.cpp

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "dermis/bake/lint_model.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    const auto picture = dermis::lint::parse_csv_picture(text, "fuzz.csv");
    if (!picture) {
        const std::string& message = picture.error().message;
        if (!message.starts_with("fuzz.csv") || message.find('\n') != std::string::npos) std::abort();
        return 0;
    }
    const auto lines = std::count(text.begin(), text.end(), '\n') + 1;
    if (int64_t(picture->image.width) * picture->image.height > lines) std::abort();
    if (picture->coordinates.find('\n') != std::string::npos) std::abort();
    return 0;
}
