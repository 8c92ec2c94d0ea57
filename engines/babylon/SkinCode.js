// What the plugin puts into the shader of PBRMaterial: by place, a name of Babylon's, or an expression to be replaced ("!").
// skinSettings: millimetres in a unit, factor on the curvature, reflectance at normal incidence, height of the picture in pixels.
// skinThicknessMaxMm: thickness in mm of a map value of 1.
//
// Light that comes through thin parts has entered on their far side: its shadow is looked up past the far wall, as the skin would
// shade its own back. That is a second look into the shadow map, with the same call at another place. Cascades have several maps:
// there this light has no shadow.
//
// Light from all around: Babylon has computed an irradiance E(n) for Lambert, three bands of spherical harmonics (Ramamoorthi,
// Hanrahan 2001). The even ones are in (E(n) + E(-n)) / 2, the odd one is (E(n) - E(-n)) / 2; skin multiplies those of order 1
// and 2 by factors, which depend on its curvature.

import { glslText, wgslText } from "./skin.js";

// The light of one light of the scene, in the loop that Babylon unrolls; preInfo and diffuse0, diffuse1 ... are its words.
const kDiffuseCall = "!computeDiffuseLighting\\(preInfo,(\\w+)\\.rgb\\);";
const kSpecularCall = "!computeSpecularLighting\\(preInfo,normalW,[^;]*?,(\\w+)\\.rgb\\);";
// The place in the light's map; for point lights in the world.
const kShadowCall = "!shadow=(computeShadow\\w*)\\(((?:fragmentInputs\\.)?)vPositionFromLight(\\d+),(?:fragmentInputs\\.)?vDepthMetric\\d+,([^;]*)\\);";
const kCubeShadowCall = "!shadow=(computeShadow\\w*)\\(((?:fragmentInputs\\.)?)vPositionW,([^;]*)\\);";
const kSum = "!diffuseBase\\+=info\\.diffuse\\*shadow;";
const kHemisphericCall = "!computeHemisphericDiffuseLighting\\(preInfo,(\\w+)\\.rgb,(\\w+)\\.vLightGround\\);";

// Of both languages.
const cubeShadow = `shadow=$1($2vPositionW,$3);
#ifdef SKIN_THICKNESS
skinFarShadow = $1(skinFarPosition,$3);
#endif
`;
const sumWith = (vec3) => `diffuseBase+=info.diffuse*shadow;
#ifdef SKIN_THICKNESS
diffuseBase += skinBehind * skinFarShadow;
skinBehind = ${vec3}(0.0);
skinFarShadow = 1.0;
#endif
`;

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
#ifdef SKIN_THICKNESS
uniform sampler2D skinThickness;

float skinDepth(vec4 placeInMap, vec2 depthValues) {
#ifdef USE_REVERSE_DEPTHBUFFER
  return (depthValues.x - placeInMap.z) / depthValues.y;
#else
  return (depthValues.x + placeInMap.z) / depthValues.y;
#endif
}
#endif
const float kSkinMaxCurvaturePerMm = @max_curvature_per_mm@;

vec3 skinDiffuseLight(preLightingInfo info, float curvature, vec3 lightColor) {
#ifdef SKIN_TABLE
  vec2 uv = skin_diffuse_coordinate(info.NdotLUnclamped, curvature, kSkinMaxCurvaturePerMm);
  vec3 light = textureLod(skinTable, uv, 0.0).rgb;
#else
  vec3 light = skin_diffuse(info.NdotLUnclamped, curvature);
#endif
  return light * info.attenuation * lightColor / kSkinPi;
}

vec3 skinSpecularLight(preLightingInfo info, vec3 n, vec3 lightColor) {
  if (info.NdotLUnclamped <= 0.0) return vec3(0.0);
  float nDotH = clamp(dot(n, info.H), 0.0, 1.0);
  float lobes = skin_two_lobe_ggx(nDotH, info.NdotLUnclamped, max(info.NdotV, 1e-3), clamp(info.roughness, 0.03, 1.0));
  return lobes * skin_fresnel_schlick(skinSettings.z, info.VdotH) * info.attenuation * lightColor;
}

// What Lambert's bands are multiplied with.
vec3 skinBand1(float curvature) { return skin_ambient_band_1(curvature) * (1.5 / kSkinPi); }
vec3 skinBand2(float curvature) { return skin_ambient_band_2(curvature) * (4.0 / kSkinPi); }

vec3 skinHemisphericLight(preLightingInfo info, float curvature, vec3 sky, vec3 ground) {
  return mix(ground, sky, 0.5 + (info.NdotL - 0.5) * skinBand1(curvature));
}

#ifdef SKIN_ENVIRONMENT
// What scattering changes in the environment's irradiance; n in its space.
vec3 skinEnvironmentChange(vec3 n, float curvature) {
#ifdef SPHERICAL_HARMONICS
  vec3 mean = vSphericalL00;
#else
  vec3 mean = vSphericalZZ + (vSphericalXX_ZZ + vSphericalYY_ZZ) / 3.0;
#endif
  vec3 towards = computeEnvironmentIrradiance(n), away = computeEnvironmentIrradiance(-n);
  return (towards - away) * 0.5 * (skinBand1(curvature) - 1.0) +
         ((towards + away) * 0.5 - mean) * (skinBand2(curvature) - 1.0);
}
#endif`,
    // Of the mesh: a bump of the map is smaller than what scatters.
    CUSTOM_FRAGMENT_BEFORE_LIGHTS: `
#ifdef SKIN_VERTEX_CURVATURE
float skinCurvature = abs(vSkinCurvature);
#else
float skinCurvature = skin_curvature_from_derivatives(fwidth(geometricNormalW), fwidth(vPositionW) * skinSettings.x);
#endif
skinCurvature = min(skinCurvature * skinSettings.y, kSkinMaxCurvaturePerMm);
#ifdef SKIN_THICKNESS
float skinThicknessMm = texture2D(skinThickness, vMainUV1).g * skinThicknessMaxMm;
vec3 skinFarShare = skin_far_share(skinThicknessMm);
vec3 skinFarPosition = vPositionW;
vec3 skinBehind = vec3(0.0);
float skinFarShadow = 1.0;
#endif`,
    [kDiffuseCall]: `skinDiffuseLight(preInfo, skinCurvature, $1.rgb);
#ifdef SKIN_THICKNESS
info.diffuse *= 1.0 - skinFarShare;
skinBehind = skinFarShare * max(-dot(geometricNormalW, preInfo.L), 0.0) * preInfo.attenuation * $1.rgb / kSkinPi;
skinFarPosition = vPositionW + preInfo.L * (skin_past_far_wall_mm(skinThicknessMm) / skinSettings.x);
#endif
`,
    [kShadowCall]: `shadow=$1($2vPositionFromLight$3,$2vDepthMetric$3,$4);
#ifdef SKIN_THICKNESS
{
  vec4 placeInMap = lightMatrix$3 * vec4(skinFarPosition, 1.0);
  skinFarShadow = $1(placeInMap, skinDepth(placeInMap, light$3.depthValues), $4);
}
#endif
`,
    [kCubeShadowCall]: cubeShadow,
    [kSum]: sumWith("vec3"),
    [kSpecularCall]: "skinSpecularLight(preInfo, normalW, $1.rgb);",
    [kHemisphericCall]: "skinHemisphericLight(preInfo, skinCurvature, $1.rgb, $2.vLightGround);",
    CUSTOM_FRAGMENT_BEFORE_FINALCOLORCOMPOSITION: `
#ifdef SKIN_ENVIRONMENT
vec3 skinNormal = (reflectionMatrix * vec4(normalW, 0.0)).xyz;
#ifdef REFLECTIONMAP_OPPOSITEZ
skinNormal.z *= -1.0;
#endif
#ifdef INVERTCUBICMAP
skinNormal.y *= -1.0;
#endif
finalIrradiance += skinEnvironmentChange(skinNormal, skinCurvature) * vReflectionColor * vReflectionInfos.x * surfaceAlbedo *
                   vLightingIntensity.z * aoOut.ambientOcclusionColor;
#endif
#ifdef SKIN_REFLECTION
vec3 skinReflectance = getReflectanceFromBRDFLookup(vec3(skinSettings.z), environmentBrdf);
#if defined(RADIANCEOCCLUSION) && !defined(BENTNORMAL)
skinReflectance *= seo;
#endif
#if defined(HORIZONOCCLUSION) && defined(BUMP) && defined(REFLECTIONMAP_3D)
skinReflectance *= eho;
#endif
finalRadianceScaled += reflectionOut.environmentRadiance.rgb * skinReflectance * vLightingIntensity.z;
#endif`,
    CUSTOM_FRAGMENT_BEFORE_FRAGCOLOR: `
#if defined(SKIN_NO_TABLE) || defined(SKIN_NO_CURVATURE) || defined(SKIN_CHANGED_ENGINE)
vec2 skinPixel = vec2(gl_FragCoord.x, skinSettings.w - gl_FragCoord.y);
#endif
#ifdef SKIN_NO_TABLE
finalColor = vec4(vec3(mix(0.02, 1.0, skin_sign_of_missing_table(skinPixel))), 1.0);
#endif
#ifdef SKIN_NO_CURVATURE
finalColor = vec4(vec3(mix(0.02, 1.0, skin_sign_of_missing_curvature(skinPixel))), 1.0);
#endif
#ifdef SKIN_CHANGED_ENGINE
finalColor = vec4(vec3(mix(0.02, 1.0, skin_sign_of_changed_engine(skinPixel))), 1.0);
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
#ifdef SKIN_THICKNESS
var skinThicknessSampler: sampler;
var skinThickness: texture_2d<f32>;

fn skinDepth(placeInMap: vec4f, depthValues: vec2f) -> f32 {
#ifdef USE_REVERSE_DEPTHBUFFER
  return (depthValues.x - placeInMap.z) / depthValues.y;
#else
  return (depthValues.x + placeInMap.z) / depthValues.y;
#endif
}
#endif
const kSkinMaxCurvaturePerMm: f32 = @max_curvature_per_mm@;

fn skinDiffuseLight(info: preLightingInfo, curvature: f32, lightColor: vec3f) -> vec3f {
#ifdef SKIN_TABLE
  let uv = skin_diffuse_coordinate(info.NdotLUnclamped, curvature, kSkinMaxCurvaturePerMm);
  let light = textureSampleLevel(skinTable, skinTableSampler, uv, 0.0).rgb;
#else
  let light = skin_diffuse(info.NdotLUnclamped, curvature);
#endif
  return light * info.attenuation * lightColor / kSkinPi;
}

fn skinSpecularLight(info: preLightingInfo, n: vec3f, lightColor: vec3f) -> vec3f {
  if (info.NdotLUnclamped <= 0.0) { return vec3f(0.0); }
  let nDotH = clamp(dot(n, info.H), 0.0, 1.0);
  let lobes = skin_two_lobe_ggx(nDotH, info.NdotLUnclamped, max(info.NdotV, 1e-3), clamp(info.roughness, 0.03, 1.0));
  return lobes * skin_fresnel_schlick(uniforms.skinSettings.z, info.VdotH) * info.attenuation * lightColor;
}

fn skinBand1(curvature: f32) -> vec3f { return skin_ambient_band_1(curvature) * (1.5 / kSkinPi); }
fn skinBand2(curvature: f32) -> vec3f { return skin_ambient_band_2(curvature) * (4.0 / kSkinPi); }

fn skinHemisphericLight(info: preLightingInfo, curvature: f32, sky: vec3f, ground: vec3f) -> vec3f {
  return mix(ground, sky, 0.5 + (info.NdotL - 0.5) * skinBand1(curvature));
}

#ifdef SKIN_ENVIRONMENT
fn skinEnvironmentChange(n: vec3f, curvature: f32) -> vec3f {
#ifdef SPHERICAL_HARMONICS
  let mean: vec3f = uniforms.vSphericalL00;
#else
  let mean: vec3f = uniforms.vSphericalZZ + (uniforms.vSphericalXX_ZZ + uniforms.vSphericalYY_ZZ) / 3.0;
#endif
  let towards: vec3f = computeEnvironmentIrradiance(n);
  let away: vec3f = computeEnvironmentIrradiance(-n);
  return (towards - away) * 0.5 * (skinBand1(curvature) - 1.0) +
         ((towards + away) * 0.5 - mean) * (skinBand2(curvature) - 1.0);
}
#endif`,
    CUSTOM_FRAGMENT_BEFORE_LIGHTS: `
#ifdef SKIN_VERTEX_CURVATURE
var skinCurvature: f32 = abs(fragmentInputs.vSkinCurvature);
#else
var skinCurvature: f32 = skin_curvature_from_derivatives(fwidth(geometricNormalW),
    fwidth(fragmentInputs.vPositionW) * uniforms.skinSettings.x);
#endif
skinCurvature = min(skinCurvature * uniforms.skinSettings.y, kSkinMaxCurvaturePerMm);
#ifdef SKIN_THICKNESS
let skinThicknessMm = textureSample(skinThickness, skinThicknessSampler, fragmentInputs.vMainUV1).g * uniforms.skinThicknessMaxMm;
let skinFarShare = skin_far_share(skinThicknessMm);
var skinFarPosition = fragmentInputs.vPositionW;
var skinBehind = vec3f(0.0);
var skinFarShadow = 1.0;
#endif`,
    [kDiffuseCall]: `skinDiffuseLight(preInfo, skinCurvature, $1.rgb);
#ifdef SKIN_THICKNESS
info.diffuse *= 1.0 - skinFarShare;
skinBehind = skinFarShare * max(-dot(geometricNormalW, preInfo.L), 0.0) * preInfo.attenuation * $1.rgb / kSkinPi;
skinFarPosition = fragmentInputs.vPositionW + preInfo.L * (skin_past_far_wall_mm(skinThicknessMm) / uniforms.skinSettings.x);
#endif
`,
    [kShadowCall]: `shadow=$1($2vPositionFromLight$3,$2vDepthMetric$3,$4);
#ifdef SKIN_THICKNESS
{
  let placeInMap = uniforms.lightMatrix$3 * vec4f(skinFarPosition, 1.0);
  skinFarShadow = $1(placeInMap, skinDepth(placeInMap, light$3.depthValues), $4);
}
#endif
`,
    [kCubeShadowCall]: cubeShadow,
    [kSum]: sumWith("vec3f"),
    [kSpecularCall]: "skinSpecularLight(preInfo, normalW, $1.rgb);",
    [kHemisphericCall]: "skinHemisphericLight(preInfo, skinCurvature, $1.rgb, $2.vLightGround);",
    CUSTOM_FRAGMENT_BEFORE_FINALCOLORCOMPOSITION: `
#ifdef SKIN_ENVIRONMENT
var skinNormal: vec3f = (uniforms.reflectionMatrix * vec4f(normalW, 0.0)).xyz;
#ifdef REFLECTIONMAP_OPPOSITEZ
skinNormal.z *= -1.0;
#endif
#ifdef INVERTCUBICMAP
skinNormal.y *= -1.0;
#endif
finalIrradiance += skinEnvironmentChange(skinNormal, skinCurvature) * uniforms.vReflectionColor * uniforms.vReflectionInfos.x * surfaceAlbedo *
                   uniforms.vLightingIntensity.z * aoOut.ambientOcclusionColor;
#endif
#ifdef SKIN_REFLECTION
var skinReflectance: vec3f = getReflectanceFromBRDFLookup(vec3f(uniforms.skinSettings.z), environmentBrdf);
#if defined(RADIANCEOCCLUSION) && !defined(BENTNORMAL)
skinReflectance *= seo;
#endif
#if defined(HORIZONOCCLUSION) && defined(BUMP) && defined(REFLECTIONMAP_3D)
skinReflectance *= eho;
#endif
finalRadianceScaled += reflectionOut.environmentRadiance.rgb * skinReflectance * uniforms.vLightingIntensity.z;
#endif`,
    CUSTOM_FRAGMENT_BEFORE_FRAGCOLOR: `
#if defined(SKIN_NO_TABLE) || defined(SKIN_NO_CURVATURE) || defined(SKIN_CHANGED_ENGINE)
let skinPixel = vec2f(fragmentInputs.position.x, uniforms.skinSettings.w - fragmentInputs.position.y);
#endif
#ifdef SKIN_NO_TABLE
finalColor = vec4f(vec3f(mix(0.02, 1.0, skin_sign_of_missing_table(skinPixel))), 1.0);
#endif
#ifdef SKIN_NO_CURVATURE
finalColor = vec4f(vec3f(mix(0.02, 1.0, skin_sign_of_missing_curvature(skinPixel))), 1.0);
#endif
#ifdef SKIN_CHANGED_ENGINE
finalColor = vec4f(vec3f(mix(0.02, 1.0, skin_sign_of_changed_engine(skinPixel))), 1.0);
#endif`,
  },
};
