#include "test_shaders.h"

namespace dermis::gpu {

std::vector<float> texel(const Image& image, int x, int y) {
    std::vector<float> values;
    for (int channel = 0; channel < image.channels; ++channel) values.push_back(image.at(x, y, channel));
    return values;
}

}  // namespace dermis::gpu
