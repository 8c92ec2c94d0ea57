// Where a table whose ends are its first and last texels is read.
#ifndef DERMIS_TEXEL_CENTRES_GLSL
#define DERMIS_TEXEL_CENTRES_GLSL

// 0 to 1, clamped, to the texture coordinate from the centre of the first texel to that of the last.
float texel_centres(float x, float size) { return (clamp(x, 0.0, 1.0) * (size - 1.0) + 0.5) / size; }

#endif
