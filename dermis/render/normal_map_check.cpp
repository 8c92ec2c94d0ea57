#include "dermis/render/normal_map_check.h"

#include <algorithm>
#include <cmath>

#include "dermis/base/vec.h"

namespace dermis::inline render {
namespace {

struct NormalCount {
    size_t texels = 0;  // that are neither black nor white
    size_t unit = 0;    // of them, vectors of about unit length
    double sum_z = 0;   // over those
};

// Some 65,536 texels, on a grid.
NormalCount count_normals(const Image& image) {
    constexpr int kSide = 256;
    constexpr float kTolerance = 0.2f;  // blurred and compressed maps have shorter vectors
    const int step_x = std::max(1, image.width / kSide), step_y = std::max(1, image.height / kSide);
    NormalCount count;
    for (int y = step_y / 2; y < image.height; y += step_y)
        for (int x = step_x / 2; x < image.width; x += step_x) {
            const Vec3 code = {image.at(x, y, 0), image.at(x, y, 1), image.at(x, y, 2)};
            const float low = std::min({code.x, code.y, code.z}), high = std::max({code.x, code.y, code.z});
            if (high < 0.02f || low > 0.98f) continue;
            ++count.texels;
            const Vec3 n = code * 2.0f - Vec3{1, 1, 1};
            if (std::abs(length(n) - 1) > kTolerance) continue;
            ++count.unit;
            count.sum_z += n.z;
        }
    return count;
}

}  // namespace

std::optional<std::string> doubt_of_normal_map(const Image& image, NormalSpace space) {
    // Measured on maps of heads: tangent space 0.95 and above, object space 0.1 to 0.3.
    constexpr double kTangentZ = 0.6, kLeastUnit = 0.5;
    if (image.channels < 3)
        return "a normal map has three channels, this has " + std::to_string(image.channels);
    const NormalCount count = count_normals(image);
    if (count.texels == 0) return std::nullopt;
    if (double(count.unit) < kLeastUnit * double(count.texels))
        return "most of its texels are no unit vectors: is it a colour map, or one of heights (give that as "
               "displacement)?";
    const double mean_z = count.sum_z / double(count.unit);
    if (space == NormalSpace::tangent && mean_z < kTangentZ)
        return "its normals point in all directions: if it is an object-space map, say normal_space = "
               "\"object\" under [maps]";
    if (space == NormalSpace::object && mean_z > 0.9)
        return "all of its normals point along +Z: if it is a tangent-space map, say normal_space = "
               "\"tangent\" under [maps]";
    return std::nullopt;
}

}  // namespace dermis::inline render
