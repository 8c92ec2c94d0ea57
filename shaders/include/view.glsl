// Which part of the light the picture shows.
#ifndef DERMIS_VIEW_GLSL
#define DERMIS_VIEW_GLSL

#include "shaders/include/emission.glsl"

layout(constant_id = 1) const int view = kViewFinal;

vec3 shown_radiance(vec3 diffuse_radiance, vec3 specular_radiance, vec3 own_radiance) {
    if (view == kViewOwn) return own_radiance;
    vec3 radiance = emitted_radiance();
    if (view != kViewSpecular) radiance += diffuse_radiance;
    if (view != kViewDiffuse) radiance += specular_radiance;
    return radiance;
}

#endif
