// The filter of a shadow's edge, as the renderer has it (shaders/include/shadow.glsl): places on a disk in the tangent plane of the
// receiver, round as seen from the light, so that flat and convex surfaces do not shade themselves.
#ifndef DERMIS_SHADOW_DISK_GLSL
#define DERMIS_SHADOW_DISK_GLSL

const float kDiskMaxSlope = @shadow_max_slope@, kDiskFacetLift = @shadow_facet_lift@, kDiskConcavity = @shadow_concavity@;
const float kDiskGoldenAngle = @golden_angle@;

// From the point to one of `count` places at which the shadow map is read, in mm. n and to_light are of length 1; radius_mm is half
// the width of the edge, map_texel_mm the width of a texel of the shadow map.
vec3 disk_offset_mm(float index, float count, vec3 n, vec3 to_light, float radius_mm, float map_texel_mm) {
    float radius = max(radius_mm, map_texel_mm);
    vec3 up = abs(to_light.y) < 0.9 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
    vec3 x = normalize(cross(up, to_light)), y = cross(to_light, x);
    float cosine = clamp(dot(n, to_light), 0.0, 1.0), sine = sqrt(1.0 - cosine * cosine);
    // What the limited slope leaves below the surface at grazing light.
    float lacking = max(sine - kDiskMaxSlope * cosine, 0.0);
    vec2 slope = vec2(dot(n, x), dot(n, y)) * -min(1.0 / max(cosine, 1e-3), kDiskMaxSlope / max(sine, 1e-3));
    float angle = index * kDiskGoldenAngle;
    vec2 place = vec2(cos(angle), sin(angle)) * sqrt((index + 0.5) / count);
    float across = place.x * slope.x + place.y * slope.y;
    float rise = max(1.5 * map_texel_mm, kDiskFacetLift * radius) + lacking * min(radius, radius_mm) +
                 0.5 * kDiskConcavity * radius * (dot(place, place) + across * across);
    return (place.x * x + place.y * y + across * to_light) * radius + n * rise;
}

#endif
