// In place of the files of EXR where DERMIS_WITH_EXR is off.

#include "dermis/base/not_built_in.h"
#include "dermis/image/codec/codec.h"

namespace dermis::inline image::codec {

Result<LoadedImage> decode_exr(Bytes, ImageUse) {
    return not_built_in("EXR", "DERMIS_WITH_EXR");
}
Result<LayeredImage> decode_layered_exr(Bytes) {
    return not_built_in("EXR", "DERMIS_WITH_EXR");
}
Result<Buffer> encode_exr(std::span<const ImageLayer>, const ImageText&) {
    return not_built_in("EXR", "DERMIS_WITH_EXR");
}

}  // namespace dermis::inline image::codec
