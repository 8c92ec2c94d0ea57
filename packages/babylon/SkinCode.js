// What the plugin puts into the shader of PBRMaterial: by place, a name of Babylon's, or an expression to be replaced ("!").
// skinSettings: millimetres in a unit, factor on the curvature, reflectance at normal incidence, height of the picture in pixels.

import { glslText, wgslText } from "./skin.js";

// The light of one light of the scene, in the loop that Babylon unrolls; preInfo and diffuse0, diffuse1 ... are its words.
const kDiffuseCall = "!computeDiffuseLighting\\(preInfo,(\\w+)\\.rgb\\);";
const kSpecularCall = "!computeSpecularLighting\\(preInfo,normalW,[^;]*?,(\\w+)\\.rgb\\);";

export const glslCode = {
  vertex: {
    CUSTOM_VERTEX_DEFINITIONS: `
#ifdef SKIN_VERTEX_CURVATURE
attribute float curvature_per_mm;
varying float vSkinCurvature;
#endif`,
    CUSTOM_VERTEX_MAIN_END: `
#ifdef SKIN_VERTEX_CURVATURE
vSkinCurvature = curvature_per_mm;
#endif`,
  },
  fragment: {
    CUSTOM_FRAGMENT_DEFINITIONS: glslText + `
#ifdef SKIN_VERTEX_CURVATURE
varying float vSkinCurvature;
#endif
#ifdef SKIN_TABLE
uniform sampler2D skinTable;
#endif
const float kMaxCurvaturePerMm = @max_curvature_per_mm@;

vec3 skinDiffuseLight(preLightingInfo info, float curvature, vec3 lightColor) {
#ifdef SKIN_TABLE
  vec2 uv = diffuse_coordinate(info.NdotLUnclamped, curvature, kMaxCurvaturePerMm);
  vec3 light = textureLod(skinTable, uv, 0.0).rgb;
#else
  vec3 light = skin_diffuse(info.NdotLUnclamped, curvature);
#endif
  return light * info.attenuation * lightColor / kPi;
}

vec3 skinSpecularLight(preLightingInfo info, vec3 n, vec3 lightColor) {
  if (info.NdotLUnclamped <= 0.0) return vec3(0.0);
  float nDotH = clamp(dot(n, info.H), 0.0, 1.0);
  float lobes = two_lobe_ggx(nDotH, info.NdotLUnclamped, max(info.NdotV, 1e-3), clamp(info.roughness, 0.03, 1.0));
  return lobes * fresnel_schlick(skinSettings.z, info.VdotH) * info.attenuation * lightColor;
}`,
    // Of the mesh: a bump of the map is smaller than what scatters.
    CUSTOM_FRAGMENT_BEFORE_LIGHTS: `
#ifdef SKIN_VERTEX_CURVATURE
float skinCurvature = abs(vSkinCurvature);
#else
float skinCurvature = curvature_from_derivatives(fwidth(geometricNormalW), fwidth(vPositionW) * skinSettings.x);
#endif
skinCurvature = min(skinCurvature * skinSettings.y, kMaxCurvaturePerMm);`,
    [kDiffuseCall]: "skinDiffuseLight(preInfo, skinCurvature, $1.rgb);",
    [kSpecularCall]: "skinSpecularLight(preInfo, normalW, $1.rgb);",
    CUSTOM_FRAGMENT_BEFORE_FRAGCOLOR: `
#if defined(SKIN_NO_TABLE) || defined(SKIN_NO_CURVATURE)
vec2 skinPixel = vec2(gl_FragCoord.x, skinSettings.w - gl_FragCoord.y);
#endif
#ifdef SKIN_NO_TABLE
finalColor = vec4(vec3(mix(0.02, 1.0, sign_of_missing_table(skinPixel))), 1.0);
#endif
#ifdef SKIN_NO_CURVATURE
finalColor = vec4(vec3(mix(0.02, 1.0, sign_of_missing_curvature(skinPixel))), 1.0);
#endif`,
  },
};

export const wgslCode = {
  vertex: {
    CUSTOM_VERTEX_DEFINITIONS: `
#ifdef SKIN_VERTEX_CURVATURE
attribute curvature_per_mm: f32;
varying vSkinCurvature: f32;
#endif`,
    CUSTOM_VERTEX_MAIN_END: `
#ifdef SKIN_VERTEX_CURVATURE
vertexOutputs.vSkinCurvature = vertexInputs.curvature_per_mm;
#endif`,
  },
  fragment: {
    CUSTOM_FRAGMENT_DEFINITIONS: wgslText + `
#ifdef SKIN_VERTEX_CURVATURE
varying vSkinCurvature: f32;
#endif
#ifdef SKIN_TABLE
var skinTableSampler: sampler;
var skinTable: texture_2d<f32>;
#endif
const kMaxCurvaturePerMm: f32 = @max_curvature_per_mm@;

fn skinDiffuseLight(info: preLightingInfo, curvature: f32, lightColor: vec3f) -> vec3f {
#ifdef SKIN_TABLE
  let uv = diffuse_coordinate(info.NdotLUnclamped, curvature, kMaxCurvaturePerMm);
  let light = textureSampleLevel(skinTable, skinTableSampler, uv, 0.0).rgb;
#else
  let light = skin_diffuse(info.NdotLUnclamped, curvature);
#endif
  return light * info.attenuation * lightColor / kPi;
}

fn skinSpecularLight(info: preLightingInfo, n: vec3f, lightColor: vec3f) -> vec3f {
  if (info.NdotLUnclamped <= 0.0) { return vec3f(0.0); }
  let nDotH = clamp(dot(n, info.H), 0.0, 1.0);
  let lobes = two_lobe_ggx(nDotH, info.NdotLUnclamped, max(info.NdotV, 1e-3), clamp(info.roughness, 0.03, 1.0));
  return lobes * fresnel_schlick(uniforms.skinSettings.z, info.VdotH) * info.attenuation * lightColor;
}`,
    CUSTOM_FRAGMENT_BEFORE_LIGHTS: `
#ifdef SKIN_VERTEX_CURVATURE
var skinCurvature: f32 = abs(fragmentInputs.vSkinCurvature);
#else
var skinCurvature: f32 = curvature_from_derivatives(fwidth(geometricNormalW),
    fwidth(fragmentInputs.vPositionW) * uniforms.skinSettings.x);
#endif
skinCurvature = min(skinCurvature * uniforms.skinSettings.y, kMaxCurvaturePerMm);`,
    [kDiffuseCall]: "skinDiffuseLight(preInfo, skinCurvature, $1.rgb);",
    [kSpecularCall]: "skinSpecularLight(preInfo, normalW, $1.rgb);",
    CUSTOM_FRAGMENT_BEFORE_FRAGCOLOR: `
#if defined(SKIN_NO_TABLE) || defined(SKIN_NO_CURVATURE)
let skinPixel = vec2f(fragmentInputs.position.x, uniforms.skinSettings.w - fragmentInputs.position.y);
#endif
#ifdef SKIN_NO_TABLE
finalColor = vec4f(vec3f(mix(0.02, 1.0, sign_of_missing_table(skinPixel))), 1.0);
#endif
#ifdef SKIN_NO_CURVATURE
finalColor = vec4f(vec3f(mix(0.02, 1.0, sign_of_missing_curvature(skinPixel))), 1.0);
#endif`,
  },
};
