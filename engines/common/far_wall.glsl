// The shadow of light that comes through a thin part: the skin's own front may not cast it, what is before the far wall may.
#ifndef DERMIS_FAR_WALL_GLSL
#define DERMIS_FAR_WALL_GLSL

// Millimetres towards the light from the surface to where the shadow of this light is looked up: past the far wall. The way through
// is longer than a baked thickness where light is aslant or the part is round; and the wall may not shade itself. What is closer to it
// casts none.
float past_far_wall_mm(float thickness_mm) { return 2.0 * thickness_mm + 2.0; }

#endif
