#include "dermis/scene/projection.h"

namespace dermis::inline scene {

Mat4 operator*(const Mat4& a, const Mat4& b) {
    Mat4 product;
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row) {
            float sum = 0;
            for (int k = 0; k < 4; ++k) sum += a.m[4 * k + row] * b.m[4 * column + k];
            product.m[4 * column + row] = sum;
        }
    return product;
}

// The rows of the rotation are the camera's axes; the shift takes the eye to the origin.
Mat4 look_along(Vec3 eye_mm, Vec3 forward, Vec3 up) {
    const Vec3 right = normalize(cross(forward, up)), above = cross(right, forward);
    return {{right.x, above.x, -forward.x, 0,  //
             right.y, above.y, -forward.y, 0,  //
             right.z, above.z, -forward.z, 0,  //
             -dot(right, eye_mm), -dot(above, eye_mm), dot(forward, eye_mm), 1}};
}

// A point at depth d = -z has w = d and z_clip = far (d - near) / (far - near).
Mat4 perspective(float vertical_fov_rad, float aspect, float near_mm, float far_mm) {
    const float half_height = std::tan(vertical_fov_rad / 2), range_mm = far_mm - near_mm;
    return {{1 / (aspect * half_height), 0, 0, 0,  //
             0, 1 / half_height, 0, 0,             //
             0, 0, -far_mm / range_mm, -1,         //
             0, 0, -(far_mm * near_mm) / range_mm, 0}};
}

Mat4 orthographic(float half_side_mm, float near_mm, float far_mm) {
    const float range_mm = far_mm - near_mm;
    return {{1 / half_side_mm, 0, 0, 0,  //
             0, 1 / half_side_mm, 0, 0,  //
             0, 0, -1 / range_mm, 0,     //
             0, 0, -near_mm / range_mm, 1}};
}

// p = R q + t gives q = R' p - R' t.
Mat4 inverse_view(const Mat4& view) {
    const float* m = view.m;
    const Vec3 x = {m[0], m[4], m[8]}, y = {m[1], m[5], m[9]}, z = {m[2], m[6], m[10]};
    const Vec3 eye_mm = -(x * m[12] + y * m[13] + z * m[14]);
    return {{x.x, x.y, x.z, 0, y.x, y.y, y.z, 0, z.x, z.y, z.z, 0, eye_mm.x, eye_mm.y, eye_mm.z, 1}};
}

// w_clip = -z and z_clip = a z + b w, thus z = -w_clip and w = (z_clip + a w_clip) / b.
Mat4 inverse_perspective(const Mat4& projection) {
    const float a = projection.m[10], b = projection.m[14];
    return {{1 / projection.m[0], 0, 0, 0,  //
             0, 1 / projection.m[5], 0, 0,  //
             0, 0, 0, 1 / b,                //
             0, 0, -1, a / b}};
}

}  // namespace dermis::inline scene
