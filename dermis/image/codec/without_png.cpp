// In place of the files of PNG where DERMIS_WITH_PNG is off.

#include "dermis/base/not_built_in.h"
#include "dermis/image/codec/codec.h"

namespace dermis::inline image::codec {

Result<LoadedImage> decode_png(Bytes, ImageUse) {
    return not_built_in("PNG", "DERMIS_WITH_PNG");
}
Result<Buffer> encode_png(const Image&, const ImageText&) {
    return not_built_in("PNG", "DERMIS_WITH_PNG");
}

}  // namespace dermis::inline image::codec
