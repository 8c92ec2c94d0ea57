// Paths on the surface as paths in the atlas. A step in mm is another number of texels wherever the atlas is stretched
// differently, and straight paths on a curved surface are not straight in the atlas.
#ifndef DERMIS_ATLAS_WALK_MM_GLSL
#define DERMIS_ATLAS_WALK_MM_GLSL

#include "shaders/atlas/blur_mm.glsl"
#include "shaders/atlas/surface_frame.glsl"

uniform texture2D atlas_normal;

struct Walk {
    vec2 at;           // in texels
    vec3 along_world;  // on the surface, of length 1
    vec3 n_world;
    vec2 step_texels;
    float chart;
    bool is_on_skin;
};

vec3 normal_at(vec2 at) { return texelFetch(sampler2D(atlas_normal, nearest_clamp), ivec2(floor(at)), 0).xyz; }

vec2 texels_of(vec4 steps, vec3 along_world, vec3 n_world) {
    vec3 t1, t2;
    frame_of(n_world, t1, t2);
    return mat2(steps.xy, steps.zw) * vec2(dot(t1, along_world), dot(t2, along_world));
}

// `along`: in the frame there, of length 1.
Walk walk_from(BlurCentre centre, vec2 along) {
    vec3 n = normal_at(centre.at), t1, t2;
    frame_of(n, t1, t2);
    vec2 step_texels = mat2(centre.steps.xy, centre.steps.zw) * along;
    return Walk(centre.at, t1 * along.x + t2 * along.y, n, step_texels, centre.chart, centre.is_skin);
}

// Continues straight to where the normal is `n`: turned by the smallest rotation between the normals. Tangent planes of
// equal normals are parallel, so that is parallel transport along the arc between the normals.
vec3 transported(vec3 along, vec3 n_from, vec3 n) { return along - (n_from + n) * (dot(along, n) / (1.0 + dot(n_from, n))); }

// Moves from a gutter to where the surface continues. `at` may lie beyond the gutter texel.
void cross_seam(inout Walk walk, vec2 at, ivec2 gutter_texel) {
    BlurCentre there = blur_centre(gutter_texel);
    float beyond = dot(at - vec2(gutter_texel) - 0.5, walk.step_texels) / max(dot(walk.step_texels, walk.step_texels), 1e-12);
    vec3 n = normal_at(there.at);
    walk.along_world = transported(walk.along_world, walk.n_world, n);
    walk.n_world = n;
    walk.step_texels = texels_of(there.steps, walk.along_world, n);
    walk.at = there.at + walk.step_texels * beyond;
    walk.is_on_skin = walk.is_on_skin && there.is_skin && chart_at(walk.at) == there.chart;
    walk.chart = there.chart;
}

// Moves by `distance` steps: the mean of the steps at both ends (Heun's method). It must not be longer than gutters are
// wide; where it leaves the skin the walk ends.
void advance(inout Walk walk, float distance) {
    vec2 at = walk.at + walk.step_texels * distance;
    ivec2 texel = clamp(ivec2(floor(at)), ivec2(0), textureSize(sampler2D(atlas_metric, nearest_clamp), 0) - 1);
    walk.is_on_skin = walk.is_on_skin && chart_at(at) == walk.chart;
    vec4 steps = texelFetch(sampler2D(atlas_metric, nearest_clamp), texel, 0);
    if (steps == vec4(0.0)) {
        cross_seam(walk, at, texel);
        return;
    }
    vec3 n = normal_at(vec2(texel));
    walk.along_world = transported(walk.along_world, walk.n_world, n);
    walk.n_world = n;
    vec2 step_texels = texels_of(steps, walk.along_world, n);
    walk.at += 0.5 * distance * (walk.step_texels + step_texels);
    walk.step_texels = step_texels;
}

vec4 light_at(Walk walk) { return walk.is_on_skin ? light_at(walk.at) : vec4(0.0); }

#endif
