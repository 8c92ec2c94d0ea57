// Where a head's picture reflections.exr has what lobes see of the environment: squares below each other, one for each roughness
// from 0 to 1, in which directions lie on an octahedron (Cigolle et al. 2014, "A Survey of Efficient Representations for
// Independent Unit Vectors"), with a border of one texel.
#ifndef DERMIS_REFLECTIONS_GLSL
#define DERMIS_REFLECTIONS_GLSL

// x, y: of the smoother one of the two squares, the first row at y 0; the rougher one is 1 / levels further. z: how much of the
// latter, 0 to 1. r is in the world; side: texels along one of a square, with its border.
vec3 reflection_place(vec3 r, float roughness, float side, float levels) {
    float level = roughness * (levels - 1.0), first = min(floor(level), levels - 2.0);
    vec2 upper = r.xz / (abs(r.x) + abs(r.y) + abs(r.z));
    vec2 lower = vec2((1.0 - abs(upper.y)) * (upper.x < 0.0 ? -1.0 : 1.0), (1.0 - abs(upper.x)) * (upper.y < 0.0 ? -1.0 : 1.0));
    vec2 at = r.y < 0.0 ? lower : upper;
    vec2 uv = ((at * 0.5 + 0.5) * (side - 2.0) + 1.0) / side;
    return vec3(uv.x, (first + uv.y) / levels, level - first);
}

#endif
