// The functions of skin.js as nodes: their text is added to the shader in the language of the renderer's back end.

import { Node } from "three/webgpu";
import { code, float } from "three/tsl";
import { glslText, wgslText } from "./skin.js";

const glslCode = /*@__PURE__*/ code(glslText), wgslCode = /*@__PURE__*/ code(wgslText);

class SkinFunctionNode extends Node {
  static get type() { return "SkinFunctionNode"; }

  constructor(name, type, inputs, inputTypes) {
    super(type);
    this.functionName = name;
    this.inputs = inputs;
    this.inputTypes = inputTypes;
  }

  customCacheKey() { return [...this.functionName].reduce((sum, letter) => (31 * sum + letter.charCodeAt(0)) | 0, 7); }

  generate(builder) {
    const text = builder.renderer.backend.isWebGPUBackend ? wgslCode : glslCode;
    text.build(builder, "void");
    const inputs = this.inputs.map((input, i) => input.build(builder, this.inputTypes[i]));
    return `${this.functionName}(${inputs.join(", ")})`;
  }
}

// A function of nodes or numbers: its name, what it returns, what it takes.
const skinFunction = (name, type, ...inputTypes) => (...inputs) => {
  if (inputs.length !== inputTypes.length) throw new Error(`${name} takes ${inputTypes.length} arguments, not ${inputs.length}`);
  return new SkinFunctionNode(name, type, inputs.map(input => typeof input === "number" ? float(input) : input), inputTypes);
};

// Light of one direction: in place of max(N.L, 0), 0 to 1. N.L from -1 to 1; curvature in 1/mm, 0 to 1. Needs no table.
export const skinDiffuse = /*@__PURE__*/ skinFunction("skin_diffuse", "vec3", "float", "float");
// Where the table is read: N.L, curvature, the table's largest curvature.
export const diffuseCoordinate = /*@__PURE__*/ skinFunction("skin_diffuse_coordinate", "vec2", "float", "float", "float");
// In 1/mm: fwidth() of the normal and of the position in mm.
export const curvatureFromDerivatives = /*@__PURE__*/ skinFunction("skin_curvature_from_derivatives", "float", "vec3", "vec3");
// Light from all around: what the bands of order 1 and 2 of the environment's radiance are multiplied with, in place of
// Lambert's 2 pi / 3 and pi / 4. Curvature in 1/mm.
export const skinAmbientBand1 = /*@__PURE__*/ skinFunction("skin_ambient_band_1", "vec3", "float");
export const skinAmbientBand2 = /*@__PURE__*/ skinFunction("skin_ambient_band_2", "vec3", "float");
// Curvature in 1/mm from a tensor, its diagonal (xx, yy, zz) and its mixed elements (yz, xz, xy); with normal and direction to the
// light for light of one direction.
export const curvatureAround = /*@__PURE__*/ skinFunction("skin_curvature_around", "float", "vec3", "vec3");
export const curvatureTowards = /*@__PURE__*/ skinFunction("skin_curvature_towards", "float", "vec3", "vec3", "vec3", "vec3");
export const sphereDiagonal = /*@__PURE__*/ skinFunction("skin_sphere_diagonal", "vec3", "float", "vec3");
export const sphereMixed = /*@__PURE__*/ skinFunction("skin_sphere_mixed", "vec3", "float", "vec3");
// The tensor of a vertex of a head: three numbers in the frame of vertexTangent(normal) and the cross product of the two.
export const vertexTangent = /*@__PURE__*/ skinFunction("skin_vertex_tangent", "vec3", "vec3");
export const tangentDiagonal = /*@__PURE__*/ skinFunction("skin_tangent_diagonal", "vec3", "vec3", "vec3", "vec3");
export const tangentMixed = /*@__PURE__*/ skinFunction("skin_tangent_mixed", "vec3", "vec3", "vec3", "vec3");
// Of a head that moves: a direction in the space of the bakes, by the quaternion of a vertex' frame there and its coordinates in that frame.
export const turned = /*@__PURE__*/ skinFunction("skin_turned", "vec3", "vec4", "vec3");
// Baked normals: the level to read, 1 on skin, the mean normals of the channels by the maps' texels, and what follows from them.
export const bakedLevel = /*@__PURE__*/ skinFunction("skin_baked_level", "float", "vec2", "vec2");
export const bakedSkin = /*@__PURE__*/ skinFunction("skin_baked_skin", "float", "vec3");
export const meanNormalRed = /*@__PURE__*/ skinFunction("skin_mean_normal_red", "vec3", "vec3", "vec3", "vec3");
export const meanNormalGreen = /*@__PURE__*/ skinFunction("skin_mean_normal_green", "vec3", "vec3", "vec3", "vec3", "vec3");
export const meanNormalBlue = /*@__PURE__*/ skinFunction("skin_mean_normal_blue", "vec3", "vec3", "vec3", "vec3", "vec3");
export const curvatureOfMean = /*@__PURE__*/ skinFunction("skin_curvature_of_mean", "float", "float");
export const band2OfMeans = /*@__PURE__*/ skinFunction("skin_band_2_of_means", "vec3", "vec3");
export const spreadTowards = /*@__PURE__*/ skinFunction("skin_spread_towards", "float", "vec3", "vec2", "vec3");
// Shadows from places around the point.
export const diskOffsetMm = /*@__PURE__*/ skinFunction("skin_disk_offset_mm", "vec3", "float", "float", "vec3", "vec3", "float", "float");
export const gatherLiftMm = /*@__PURE__*/ skinFunction("skin_gather_lift_mm", "float", "float");
export const gatherTangent = /*@__PURE__*/ skinFunction("skin_gather_tangent", "vec3", "vec3", "vec3", "vec3");
export const gatherBends = /*@__PURE__*/ skinFunction("skin_gather_bends", "vec3", "vec3", "vec3", "vec3", "vec3");
export const gatherCosine = /*@__PURE__*/ skinFunction("skin_gather_cosine", "float", "vec2", "vec3", "float", "float");
export const gatherRiseMm = /*@__PURE__*/ skinFunction("skin_gather_rise_mm", "float", "vec2", "float", "vec3");
export const gatherTrust = /*@__PURE__*/ skinFunction("skin_gather_trust", "float", "vec2", "vec3");
export const gatheredLight = /*@__PURE__*/ skinFunction("skin_gathered_light", "vec3", "float", "vec3", "vec3", "float", "float");
export const gatheredTrustedLight = /*@__PURE__*/ skinFunction("skin_gathered_trusted_light", "vec3", "float", "vec3", "vec2", "float", "float");
export const gatheredWithGain = /*@__PURE__*/ skinFunction("skin_gathered_with_gain", "vec3", "float", "vec3", "vec3", "vec3");
// What all diffuse light is multiplied with, by the mean curvature in 1/mm, above 0 on convex skin; and that curvature from dFdx and dFdy
// of the position in mm and of the normal.
export const skinGain = /*@__PURE__*/ skinFunction("skin_gain", "vec3", "float");
export const meanCurvatureFromDerivatives = /*@__PURE__*/ skinFunction("skin_mean_curvature_from_derivatives", "float", "vec3", "vec3", "vec3", "vec3");
// Transmission through thin geometry, 0 to 1, by its thickness in mm.
export const skinTransmittance = /*@__PURE__*/ skinFunction("skin_transmittance", "vec3", "float");
// Of the diffuse light of a thin part, the share that has entered its far side, 0 to 0.5, by its thickness in mm.
export const skinFarShare = /*@__PURE__*/ skinFunction("skin_far_share", "vec3", "float");
// Diffuse light of a thin part: what has entered here and behind, the share of the latter, the gain of the place and that of slabs.
export const thinLight = /*@__PURE__*/ skinFunction("skin_thin_light", "vec3", "vec3", "vec3", "vec3", "vec3", "vec3");
// How far towards the light the shadow of that light is looked up, in mm, by the thickness in mm.
export const pastFarWallMm = /*@__PURE__*/ skinFunction("skin_past_far_wall_mm", "float", "float");
// Light in a penumbra 3 mm wide, by the share of the light that is visible, 0 to 1.
export const skinShadowEdge = /*@__PURE__*/ skinFunction("skin_shadow_edge", "vec3", "float");
// BRDF times N.L, per steradian, without Fresnel: N.H, N.L, N.V, perceptual roughness.
export const twoLobeGgx = /*@__PURE__*/ skinFunction("skin_two_lobe_ggx", "float", "float", "float", "float", "float");
// The same of one lobe, by the square of the roughness.
export const ggx = /*@__PURE__*/ skinFunction("skin_ggx", "float", "float", "float", "float", "float");
// Reflectance: at normal incidence, cosine of the half vector and the view.
export const fresnelSchlick = /*@__PURE__*/ skinFunction("skin_fresnel_schlick", "float", "float", "float");
// Words over the screen, 1 on their letters. A position in pixels, y downwards.
export const signOfMissingTable = /*@__PURE__*/ skinFunction("skin_sign_of_missing_table", "float", "vec2");
export const signOfMissingCurvature = /*@__PURE__*/ skinFunction("skin_sign_of_missing_curvature", "float", "vec2");
