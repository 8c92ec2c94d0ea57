// Whether this version of Babylon has in its shader what the plugin replaces and the places where it adds something. A call
// that is written otherwise would stay as it is, and the skin would be drawn without its light.

import { ShaderLanguage } from "@babylonjs/core/Materials/shaderLanguage.js";
import { ShaderStore } from "@babylonjs/core/Engines/shaderStore.js";

// The same modules that PBRMaterial loads when it is first drawn.
const loadTexts = language => Promise.all(language === ShaderLanguage.WGSL
  ? [import("@babylonjs/core/ShadersWGSL/pbr.vertex.js"), import("@babylonjs/core/ShadersWGSL/pbr.fragment.js")]
  : [import("@babylonjs/core/Shaders/pbr.vertex.js"), import("@babylonjs/core/Shaders/pbr.fragment.js")]);

// Places of SkinCode.js that a shader has not; "!" is an expression, found in the light of one light.
const missing = (points, shader, light) => Object.keys(points).filter(point =>
  point.startsWith("!") ? !new RegExp(point.slice(1)).test(light) : !shader.includes(`#define ${point}`));

// A promise of what has changed, in words; empty: nothing.
export async function faultOfEngine(code, language) {
  await loadTexts(language);
  const shaders = ShaderStore.GetShadersStore(language);
  const light = ShaderStore.GetIncludesShadersStore(language).lightFragment?.replaceAll("{X}", "0") ?? "";
  const changed = [...missing(code.vertex, shaders.pbrVertexShader ?? "", light),
    ...missing(code.fragment, shaders.pbrPixelShader ?? "", light)];
  return changed.length ? `this version of Babylon.js has not what the plugin replaces in its shader: ${changed[0]}` : "";
}
