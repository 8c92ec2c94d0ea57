// The shadow of light that comes through a thin part: the skin's own front may not cast it, what is before the far wall may.
#ifndef DERMIS_FAR_WALL_GLSL
#define DERMIS_FAR_WALL_GLSL

// Millimetres against the mesh's normal to where the shadow of this light is looked up: past the far wall. A baked thickness is
// a mean, 3/4 of the way through where the part is round; and the wall may not shade itself. What is closer to it casts none.
float past_far_wall_mm(float thickness_mm) { return 1.5 * thickness_mm + 1.0; }

#endif
