// What the plugin puts into the shader of PBRMaterial: by place, a name of Babylon's, or an expression to be replaced ("!").
// skinSettings: millimetres in a unit, factor on the curvature, reflectance at normal incidence, height of the picture in pixels.
// skinShadowSettings: half the width of a shadow's edge in mm, thickness in mm of a map value of 1, size of the baked normals in texels.
//
// Light that comes through thin parts has entered on their far side: its shadow is looked up past the far wall, as the skin would
// shade its own back. That is a second look into the shadow map, with the same call at another place. Cascades have several maps:
// there this light has no shadow.

import { glslText, wgslText } from "./skin.js";
import { glsl, wgsl } from "./SkinLanguage.js";
import {
  addAmbient, ambientDefinitions, readSurface, shadowDefinitions, surfaceDefinitions, vertexDefinitions, vertexEnd,
} from "./SkinSurfaceCode.js";

// The light of one light of the scene, in the loop that Babylon unrolls; preInfo and diffuse0, diffuse1 ... are its words.
const kDiffuseCall = "!computeDiffuseLighting\\(preInfo,(\\w+)\\.rgb\\);";
const kSpecularCall = "!computeSpecularLighting\\(preInfo,normalW,[^;]*?,(\\w+)\\.rgb\\);";
// The place in the light's map; for point lights in the world.
const kShadowCall = "!shadow=(computeShadow\\w*)\\(((?:fragmentInputs\\.)?)vPositionFromLight(\\d+),(?:fragmentInputs\\.)?vDepthMetric\\d+,([^;]*)\\);";
const kCubeShadowCall = "!shadow=(computeShadow\\w*)\\(((?:fragmentInputs\\.)?)vPositionW,([^;]*)\\);";
const kSum = "!diffuseBase\\+=info\\.diffuse\\*shadow;";
const kHemisphericCall = "!computeHemisphericDiffuseLighting\\(preInfo,(\\w+)\\.rgb,(\\w+)\\.vLightGround\\);";

const definitions = (l, text) => `${text}
${surfaceDefinitions(l)}
#ifdef SKIN_THICKNESS
${l.map("skinThickness")}
#endif
#ifdef SKIN_SPECULAR
${l.map("skinSpecular")}
#endif
${l.global("float", "skinF0")}
${l.global("vec3", "skinArriving")}

${l.method("float", "skinDepth", ["vec4", "placeInMap"], ["vec2", "depthValues"])} {
#ifdef USE_REVERSE_DEPTHBUFFER
  return (depthValues.x - placeInMap.z) / depthValues.y;
#else
  return (depthValues.x + placeInMap.z) / depthValues.y;
#endif
}
${shadowDefinitions(l)}
${ambientDefinitions(l)}

${l.method("vec3", "skinDiffuseLight", ["preLightingInfo", "info"], ["vec3", "lightColor"])} {
  return skinEntered(info.NdotLUnclamped, info.L) * info.attenuation * lightColor / kSkinPi;
}

${l.method("vec3", "skinSpecularLight", ["preLightingInfo", "info"], ["vec3", "n"], ["vec3", "lightColor"])} {
  if (info.NdotLUnclamped <= 0.0) { return vec3(0.0); }
  ${l.local("float", "nDotH")} = clamp(dot(n, info.H), 0.0, 1.0);
  ${l.local("float", "nDotV")} = max(info.NdotV, 1e-3);
  ${l.local("float", "perceptual")} = clamp(info.roughness, 0.03, 1.0);
#ifdef SKIN_ONE_LOBE
  ${l.local("float", "lobes")} = skin_ggx(nDotH, info.NdotLUnclamped, nDotV, perceptual * perceptual);
#else
  ${l.local("float", "lobes")} = skin_two_lobe_ggx(nDotH, info.NdotLUnclamped, nDotV, perceptual);
#endif
  return lobes * skin_fresnel_schlick(skinF0, info.VdotH) * info.attenuation * lightColor;
}

${l.method("vec3", "skinHemisphericLight", ["preLightingInfo", "info"], ["vec3", "sky"], ["vec3", "ground"])} {
#ifdef SKIN_SCATTERING
  return mix(ground, sky, 0.5 + (info.NdotL - 0.5) * skinBand1(skinCurvature));
#else
  return mix(ground, sky, info.NdotL);
#endif
}`;

const beforeLights = l => `
${readSurface(l)}
skinF0 = ${l.own("skinSettings")}.z;
#ifdef SKIN_SPECULAR
skinF0 *= ${l.read("skinSpecular", l.input("vMainUV1"))}.a;
#endif
skinArriving = vec3(-1.0);
#ifdef SKIN_THICKNESS
#ifdef SKIN_HEAD
${l.local("vec2", "skinThicknessPlace")} = ${l.input("v_skin_atlas")};
#else
${l.local("vec2", "skinThicknessPlace")} = ${l.input("vMainUV1")};
#endif
${l.local("float", "skinThicknessMm")} = ${l.read("skinThickness", "skinThicknessPlace")}.g * ${l.own("skinShadowSettings")}.y;
${l.local("vec3", "skinFarShare")} = skin_far_share(skinThicknessMm);
${l.local("vec3", "skinFarPosition")} = ${l.input("vPositionW")};
${l.local("vec3", "skinBehind")} = vec3(0.0);
${l.local("float", "skinFarShadow")} = 1.0;
#endif`;

const diffuseCall = l => `skinDiffuseLight(preInfo, $1.rgb);
#if defined(SKIN_THICKNESS) && defined(SKIN_SCATTERING)
info.diffuse *= 1.0 - skinFarShare;
skinBehind = skinFarShare * max(-dot(geometricNormalW, preInfo.L), 0.0) * preInfo.attenuation * $1.rgb / kSkinPi;
#ifdef SKIN_GAIN
// All diffuse light is multiplied with skinGain later.
skinBehind *= skin_gain_through(skinGain, kSkinGainOfSlabs) / max(skinGain, vec3(1e-3));
#endif
skinFarPosition = ${l.input("vPositionW")} + preInfo.L * (skin_past_far_wall_mm(skinThicknessMm) / ${l.own("skinSettings")}.x);
#endif
`;

const shadowCall = l => `shadow=$1($2vPositionFromLight$3,$2vDepthMetric$3,$4);
#if defined(SKIN_DISK) && defined(SHADOWPCF$3)
skinArriving = skinShadow(${l.own("lightMatrix$3")}, light$3.depthValues, ${l.shadowMap("shadowTexture$3")}, light$3.shadowsInfo,
    geometricNormalW, preInfo.L);
shadow = skinVisible;
#endif
#ifdef SKIN_THICKNESS
{
  ${l.local("vec4", "placeInMap")} = ${l.own("lightMatrix$3")} * vec4(skinFarPosition, 1.0);
  skinFarShadow = $1(placeInMap, skinDepth(placeInMap, light$3.depthValues), $4);
}
#endif
`;

const cubeShadow = `shadow=$1($2vPositionW,$3);
#ifdef SKIN_THICKNESS
skinFarShadow = $1(skinFarPosition,$3);
#endif
`;

const sum = l => `diffuseBase += info.diffuse * ${l.select("skinArriving.x < 0.0", "vec3(shadow)", "skinArriving")};
skinArriving = vec3(-1.0);
#ifdef SKIN_THICKNESS
diffuseBase += skinBehind * skinFarShadow;
skinBehind = vec3(0.0);
skinFarShadow = 1.0;
#endif
`;

const signs = l => `
#if defined(SKIN_NO_TABLE) || defined(SKIN_NO_CURVATURE) || defined(SKIN_CHANGED_ENGINE)
${l.local("vec2", "skinPixel")} = vec2(${l.pixel}.x, ${l.own("skinSettings")}.w - ${l.pixel}.y);
#endif
${[["SKIN_NO_TABLE", "missing_table"], ["SKIN_NO_CURVATURE", "missing_curvature"], ["SKIN_CHANGED_ENGINE", "changed_engine"]]
    .map(([define, sign]) => `#ifdef ${define}
finalColor = vec4(vec3(mix(0.02, 1.0, skin_sign_of_${sign}(skinPixel))), 1.0);
#endif`).join("\n")}`;

const codeIn = (l, text) => ({
  vertex: { CUSTOM_VERTEX_DEFINITIONS: vertexDefinitions(l, text), CUSTOM_VERTEX_MAIN_END: vertexEnd(l) },
  fragment: {
    CUSTOM_FRAGMENT_DEFINITIONS: definitions(l, text),
    CUSTOM_FRAGMENT_BEFORE_LIGHTS: beforeLights(l),
    [kDiffuseCall]: diffuseCall(l),
    [kShadowCall]: shadowCall(l),
    [kCubeShadowCall]: cubeShadow,
    [kSum]: sum(l),
    [kSpecularCall]: "skinSpecularLight(preInfo, normalW, $1.rgb);",
    [kHemisphericCall]: "skinHemisphericLight(preInfo, $1.rgb, $2.vLightGround);",
    CUSTOM_FRAGMENT_BEFORE_FINALCOLORCOMPOSITION: addAmbient(l),
    CUSTOM_FRAGMENT_BEFORE_FRAGCOLOR: signs(l),
  },
});

export const glslCode = codeIn(glsl, glslText);
export const wgslCode = codeIn(wgsl, wgslText);
