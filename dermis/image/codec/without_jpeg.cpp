// In place of jpeg.cpp where DERMIS_WITH_JPEG is off.

#include "dermis/base/not_built_in.h"
#include "dermis/image/codec/codec.h"

namespace dermis::inline image {

Result<LoadedImage> codec::decode_jpeg(Bytes, ImageUse) {
    return not_built_in("JPEG", "DERMIS_WITH_JPEG");
}
Result<std::vector<std::byte>> encode_jpeg(const Image&, int) {
    return not_built_in("JPEG", "DERMIS_WITH_JPEG");
}

}  // namespace dermis::inline image
