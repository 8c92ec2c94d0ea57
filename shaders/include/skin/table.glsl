// Where the tables are read: texture coordinates, 0 to 1. All tables are read with linear filtering, clamped, without
// mip levels, as linear data.
#ifndef DERMIS_SKIN_TABLE_GLSL
#define DERMIS_SKIN_TABLE_GLSL

// x from 0 to 1, clamped, to the coordinate between the centre of the first texel and that of the last, for a table of
// `size` texels whose ends hold x = 0 and x = 1.
float texel_centres(float x, float size) { return (clamp(x, 0.0, 1.0) * (size - 1.0) + 0.5) / size; }

// Diffuse table: n_dot_l from -1 to 1 by curvature from 0 to max_curvature_per_mm, over the whole texture.
vec2 diffuse_coordinate(float n_dot_l, float curvature_per_mm, float max_curvature_per_mm) {
    return vec2(n_dot_l * 0.5 + 0.5, curvature_per_mm / max_curvature_per_mm);
}

// Beckmann table: it holds the tenth root of the distribution, which bends gently enough along these axes to be
// interpolated.
vec2 beckmann_coordinate(float n_dot_h, float alpha) { return vec2(sqrt(1.0 - n_dot_h), sqrt(alpha)); }

// The distribution, per steradian, from its tenth root.
float beckmann_from_root(float root) {
    float root2 = root * root, root4 = root2 * root2;
    return root4 * root4 * root2;
}

#endif
