// The tangent frame of the atlas's metric.
#ifndef DERMIS_ATLAS_SURFACE_FRAME_GLSL
#define DERMIS_ATLAS_SURFACE_FRAME_GLSL

// Depends on the normal alone (Frisvad 2012, with its hole at n = -y).
void frame_of(vec3 n, out vec3 t1, out vec3 t2) {
    float f = 1.0 / max(1.0 + n.y, 1e-3);
    t1 = vec3(1.0 - n.x * n.x * f, -n.x, -n.x * n.z * f);
    t2 = vec3(-n.x * n.z * f, -n.z, 1.0 - n.z * n.z * f);
}

#endif
