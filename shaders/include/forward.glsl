// The forward pass of every technique that shades a point from its own neighbourhood alone. The technique defines
// the two functions below; lights, shadow, specular, environment and debug views are the same for all.
#ifndef DERMIS_FORWARD_GLSL
#define DERMIS_FORWARD_GLSL

// With DERMIS_TRANSMISSION defined: light that comes through thin parts is added (shaders/include/transmission.glsl).
// DERMIS_SHADOW_WIDTH_MM: the width of a filtered shadow, when it is not the scene's penumbra.
#ifndef DERMIS_SHADOW_WIDTH_MM
#define DERMIS_SHADOW_WIDTH_MM penumbra_mm
#endif

#include "shaders/include/environment.glsl"
#include "shaders/include/gain.glsl"
#include "shaders/include/lights.glsl"
#include "shaders/include/reduced_diffuse.glsl"
#include "shaders/include/shadow.glsl"
#include "shaders/include/surface.glsl"
#ifdef DERMIS_TRANSMISSION
#include "shaders/include/transmission.glsl"
#endif
#include "shaders/include/view.glsl"

layout(location = 0) out vec4 radiance_out;

// With DERMIS_PREPARE_SURFACE defined: called once before anything that needs the geometry, or the material, to change it and
// to compute what does not depend on the light.
#ifdef DERMIS_PREPARE_SURFACE
void prepare_geometry(Surface s);
void prepare_surface(inout Surface s);
#endif

// With DERMIS_OWN_VIEW defined: what the technique's own debug view shows, as radiance.
#ifdef DERMIS_OWN_VIEW
vec3 own_view(Surface s);
#endif

#ifdef DERMIS_TRANSMISSION
// Transmission counts where it is more than the technique's own light. Lit points that face like the shaded point are left
// out: the shadow map is too coarse for them at grazing light.
const float kOwnSide = 0.15;
float part_not_counted(LightMap map, LitPoint lit) { return smoothstep(0.0, kOwnSide, turned_away(lit)); }

// With DERMIS_OWN_BODY defined: the length of the light's way through the body in the technique's own model.
#ifdef DERMIS_OWN_BODY
float own_way_mm(Surface s, vec3 to_light_world);
#else
float own_way_mm(Surface s, vec3 to_light_world) { return -1.0; }
#endif
#endif

// Radiant exitance over irradiance at normal incidence for light from one direction that nothing blocks: n_dot_l for
// Lambert.
vec3 direct_response(Surface s, vec3 to_light_world);

// The part of a light that enters around the point, of each channel: of what the profile scatters, and of what the gain adds.
struct Entering {
    vec3 profile, gain;
};

// With DERMIS_SCATTERED_VISIBILITY defined: that part. visibility: of the light at the point. All four pixels of a quad come
// here together.
#ifdef DERMIS_SCATTERED_VISIBILITY
Entering scattered_visibility(Surface s, int light, vec3 to_light_world, float visibility);
// Below 0 in some creases: main() takes light through thin parts instead, which is 0 or more.
vec3 entering_light(Entering e, vec3 gain_of_place) { return e.profile + (gain_of_place - 1.0) * e.gain; }
#else
Entering scattered_visibility(Surface s, int light, vec3 to_light_world, float visibility) {
    return Entering(vec3(visibility), vec3(visibility));
}
vec3 entering_light(Entering e, vec3 gain_of_place) { return e.profile * gain_of_place; }
#endif

// With DERMIS_OWN_CURVATURE defined: the mean curvature that the gain takes, else that of the vertices.
#ifdef DERMIS_OWN_CURVATURE
float gain_curvature_per_mm(Surface s);
#else
float gain_curvature_per_mm(Surface s) { return mean_curvature_per_mm(s); }
#endif

// Irradiance from the environment, occluded, after the response of the skin.
vec3 ambient_response(Surface s);

// Scattered light entered around the point. The response without shadows is the mean cosine there; that of the light is
// larger where part of it is dark. For a Gaussian at the terminator it is 3.1 times the response (1.25 over 0.4 standard
// deviations), on lit skin nearly the response itself.
vec3 entered_part(Surface s, vec3 to_light_world) {
#ifdef DERMIS_TRANSMISSION
    if (reduced_diffuse == 0) return vec3(1.0);
    vec3 cosine = direct_response(s, to_light_world);
    cosine += 2.1 * max(cosine - max(dot(s.n_world, to_light_world), 0.0), vec3(0.0));
    return vec3(diffuse_entry(s, cosine.r), diffuse_entry(s, cosine.g), diffuse_entry(s, cosine.b));
#else
    return vec3(diffuse_entry(s, dot(s.n_world, to_light_world)));
#endif
}

// Results of the taps in the light's maps. They need the geometry only.
struct Arrival {
    LightSample light;  // past translucent surfaces
    float visibility;   // past opaque ones
    Entering entering;
    vec3 transmitted;   // transmitted_part()
};

Arrival arrival(Surface s, int i) {
    LightSample light = sample_light(i, s.p_world_mm);
    LightThrough through =
        light_through(i, s.p_world_mm, s.n_geometry_world, light.to_light_world, DERMIS_SHADOW_WIDTH_MM);
    light.irradiance_linear *= through.tint;
    Entering entering = scattered_visibility(s, i, light.to_light_world, through.visibility);
    Arrival a = Arrival(light, through.visibility, entering, vec3(0.0));
#ifdef DERMIS_TRANSMISSION
    float n_dot_l = dot(s.n_geometry_world, light.to_light_world), way_mm = own_way_mm(s, light.to_light_world);
    a.transmitted = transmitted_part(s, i, light.to_light_world, n_dot_l, a.visibility, way_mm);
#endif
    return a;
}

void main() {
    Surface s = load_geometry();
#ifdef DERMIS_PREPARE_SURFACE
    prepare_geometry(s);
#endif
    // With one light, its taps precede the material: fewer live registers.
    Arrival first;
    if (one_light != 0) first = arrival(s, 0);
    load_normal(s);
    load_material(s);
#ifdef DERMIS_PREPARE_SURFACE
    prepare_surface(s);
#endif
    vec3 own_radiance = vec3(0.0);
#ifdef DERMIS_OWN_VIEW
    own_radiance = own_view(s);
#endif
    vec3 gain_of_place = gain_at(gain_curvature_per_mm(s));
    vec3 exitance = gain_of_place * ambient_response(s), unscattered = vec3(0.0);
    vec3 specular_radiance =
        reflected_environment(s.n_world, s.to_eye_world, s.roughness, s.f0, s.occlusion);
    [[unroll]] for (int i = 0; i < light_count; ++i) {
        Arrival arriving;
        if (one_light != 0)
            arriving = first;
        else
            arriving = arrival(s, i);
        LightSample light = arriving.light;
        vec3 response = direct_response(s, light.to_light_world) * entering_light(arriving.entering, gain_of_place);
        vec3 direct = light.irradiance_linear * entered_part(s, light.to_light_world) * response;
#ifdef DERMIS_TRANSMISSION
        // Both are estimates of the same integral; each misses light where the other is right.
        direct = max(direct, light.irradiance_linear * s.occlusion * arriving.transmitted * transmitted_gain(gain_of_place));
#endif
        exitance += direct;
#ifdef DERMIS_TRANSMISSION
        if (has_scatter != 0) {
            float n_dot_l = max(dot(s.n_world, light.to_light_world), 0.0);
            unscattered += light.irradiance_linear * (diffuse_entry(s, n_dot_l) * n_dot_l * arriving.visibility);
        }
#endif
        specular_radiance += light.irradiance_linear * arriving.visibility *
                             specular_reflection(s.n_world, s.to_eye_world, light.to_light_world, s.roughness, s.f0);
    }
    exitance = with_links(exitance);
#ifdef DERMIS_TRANSMISSION
    if (has_scatter != 0) {
        unscattered += environment_irradiance(s.n_world) * s.occlusion;
        exitance = mix(unscattered, exitance, scatter_weight(s));
    }
#endif
    load_albedo(s);
    vec3 diffuse_radiance = diffuse_exit(s) * s.albedo_linear * exitance / kPi;
    radiance_out = vec4(shown_radiance(diffuse_radiance, specular_radiance, own_radiance), 1.0);
}

#endif
