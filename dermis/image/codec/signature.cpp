// Magic numbers of the formats that a library reads.

#include "dermis/image/codec/codec.h"

namespace dermis::inline image::codec {
namespace {

bool starts_with_bytes(Bytes file, std::string_view signature) {
    return file.size() >= signature.size() &&
           std::memcmp(file.data(), signature.data(), signature.size()) == 0;
}

}  // namespace

bool is_png(Bytes file) {
    return starts_with_bytes(file, "\x89PNG\r\n\x1a\n");
}
bool is_jpeg(Bytes file) {
    return starts_with_bytes(file, "\xff\xd8\xff");
}
bool is_exr(Bytes file) {
    return starts_with_bytes(file, "\x76\x2f\x31\x01");
}

}  // namespace dermis::inline image::codec
