// OpenEXR, after the check of the header that prevents allocations of the size that a file states.
// Dictionary: dermis/image/codec/exr_header.cpp dermis/image/codec/exr_read.cpp

#include "dermis/image/codec/codec.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace dermis;
    const codec::Bytes file = std::as_bytes(std::span(data, size));
    (void)codec::decode_exr(file, ImageUse::color);
    (void)codec::decode_layered_exr(file);
    return 0;
}
