// A part of a picture: the header as JSON, sums as floats. What is taken for a part adds up without an
// overflow.
// Dictionary: dermis/jobs/part.cpp

#include "dermis/image/codec/codec.h"
#include "dermis/jobs/part.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace dermis;
    Result<LayeredImage> file = codec::decode_layered_exr(std::as_bytes(std::span(data, size)));
    if (!file) return 0;
    const Result<Part> part = part_of(std::move(*file), "part");
    if (!part) {
        if (part.error().message.find('\n') != std::string::npos) std::abort();
        return 0;
    }
    const PartFacts& facts = part->facts;
    PictureSums sums{.width = facts.width, .height = facts.height, .pixels = {}};
    sums.pixels.resize(size_t(facts.width) * size_t(facts.height));
    part->add_to(sums);
    (void)picture_of(sums);
    return 0;
}
