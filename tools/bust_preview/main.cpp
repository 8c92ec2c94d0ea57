// bust_preview [clay|sketch|crop|skin|obj FILE MM_PER_UNIT] SIZE VIEW... [--tone T] [--sheet FILE]
// Renders views of the built-in bust (or of an OBJ to hold beside it) to VIEW.png, or three a row into one
// sheet; tools/bust_pictures uses it.

#include <cstdio>
#include <cstring>

#include "dermis/base/text.h"
#include "dermis/image/io.h"
#include "render.h"

namespace {

using namespace dermis;
using namespace dermis::preview;

struct Arguments {
    std::string kind = "clay", obj, sheet;
    double mm_per_unit = 1;
    int side = 512;
    BustParams params;
    std::vector<const View*> views;
};

Result<Arguments> parse(int count, char** values) {
    Arguments a;
    std::vector<std::string> words(values + 1, values + count);
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& w = words[i];
        const auto next = [&] { return i + 1 < words.size() ? words[++i] : std::string(); };
        if (w == "clay" || w == "sketch" || w == "crop" || w == "skin") {
            a.kind = w;
        } else if (w == "obj") {
            a.kind = w;
            a.obj = next();
            a.mm_per_unit = parse_number(next()).value_or(1);
        } else if (w == "--sheet") {
            a.sheet = next();
        } else if (w == "--tone") {
            a.params.tone = parse_number(next()).value_or(0);
        } else if (const auto number = parse_number(w)) {
            a.side = int(*number);
        } else if (const View* view = find_view(w)) {
            a.views.push_back(view);
        } else {
            return Error{"unknown view '" + w + "'; known: " + view_names()};
        }
    }
    if (a.views.empty()) return Error{"name at least one view of: " + view_names()};
    if (a.side < 16 || a.side > 4096) return Error{"the size must be between 16 and 4096"};
    if (const auto checked = check_bust_params(a.params); !checked) return checked.error();
    return a;
}

Result<Subject> subject_of(const Arguments& a) {
    if (a.kind == "skin") return skin_subject(a.params);
    if (a.kind == "obj") return obj_subject(a.obj, a.mm_per_unit);
    if (a.kind == "sketch") return sketch_subject(a.params);
    if (a.kind == "crop") return crop_subject(a.params, *a.views[0]);
    return clay_subject(a.params);
}

Result<void> run(const Arguments& a) {
    const Result<Subject> subject = subject_of(a);
    if (!subject) return subject.error();
    const int kColumns = a.views.size() == 4 ? 2 : 3;
    const int columns = std::min(kColumns, int(a.views.size())),
              rows = (int(a.views.size()) + columns - 1) / columns;
    Image sheet(columns * a.side, rows * a.side, 3, PixelFormat::u8, Encoding::srgb);
    for (size_t i = 0; i < a.views.size(); ++i) {
        const bool crop = a.kind == "crop" && i > 0;
        const Image image = crop ? render(crop_subject(a.params, *a.views[i]), *a.views[i], a.side)
                                 : render(*subject, *a.views[i], a.side);
        if (a.sheet.empty()) {
            if (auto written = write_image(a.views[i]->name + ".png", image); !written) return written;
            continue;
        }
        const size_t row_bytes = size_t(a.side) * 3, column = i % size_t(columns), row = i / size_t(columns);
        for (size_t y = 0; y < size_t(a.side); ++y)
            std::memcpy(
                sheet.bytes.data() + ((row * size_t(a.side) + y) * size_t(columns) + column) * row_bytes,
                image.bytes.data() + y * row_bytes, row_bytes);
    }
    return a.sheet.empty() ? Result<void>{} : write_image(a.sheet, sheet);
}

}  // namespace

int main(int count, char** values) {
    const Result<Arguments> arguments = parse(count, values);
    const Result<void> done = arguments ? run(*arguments) : Result<void>(arguments.error());
    if (done) return 0;
    std::fprintf(stderr, "bust_preview: %s\n", done.error().message.c_str());
    return 1;
}
