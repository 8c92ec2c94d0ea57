// PNG through libpng, and its chunks read without it.

#include "dermis/bake/table_io.h"
#include "dermis/image/codec/codec.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace dermis;
    const codec::Bytes file = std::as_bytes(std::span(data, size));
    (void)codec::decode_png(file, ImageUse::color);
    (void)png_is_flagged_srgb(file);
    return 0;
}
