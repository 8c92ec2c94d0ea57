// The exported head, as `dermis render` draws it.

import { ArcRotateCamera } from "@babylonjs/core/Cameras/arcRotateCamera.js";
import { Constants } from "@babylonjs/core/Engines/constants.js";
import { Engine } from "@babylonjs/core/Engines/engine.js";
import { ShaderStore } from "@babylonjs/core/Engines/shaderStore.js";
import { WebGPUEngine } from "@babylonjs/core/Engines/webgpuEngine.js";
import { ShaderLanguage } from "@babylonjs/core/Materials/shaderLanguage.js";
import { Color4 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { PostProcess } from "@babylonjs/core/PostProcesses/postProcess.js";
import { Scene } from "@babylonjs/core/scene.js";
import { loadSkinHead, placeSkinCamera } from "../SkinHead.js";
import { addSkinControls } from "../SkinHeadControls.js";

const query = new URLSearchParams(location.search), message = document.getElementById("message");
const canvas = document.createElement("canvas"), options = { useExactSrgbConversions: true };

async function createEngine() {
  if (query.has("webgl") || !(await WebGPUEngine.IsSupportedAsync)) return new Engine(canvas, false, options);
  const engine = new WebGPUEngine(canvas, options);
  await engine.initAsync();
  return engine;
}

// Hable 2010, "Uncharted 2: HDR Lighting", with its bias of 2 and a white of 11.2; then sRGB.
ShaderStore.ShadersStore.skinToneMapFragmentShader = `
uniform sampler2D textureSampler;
uniform float exposure;
varying vec2 vUV;
vec3 curve(vec3 x) { return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3; }
void main(void) {
  vec3 c = clamp(curve(2.0 * exposure * texture2D(textureSampler, vUV).rgb) / curve(vec3(11.2)).x, 0.0, 1.0);
  gl_FragColor = vec4(mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, 12.92 * c, vec3(lessThanEqual(c, vec3(0.0031308)))), 1.0);
}`;
ShaderStore.ShadersStoreWGSL.skinToneMapFragmentShader = `
varying vUV: vec2f;
var textureSamplerSampler: sampler;
var textureSampler: texture_2d<f32>;
uniform exposure: f32;
fn curve(x: vec3f) -> vec3f { return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3; }
@fragment fn main(input: FragmentInputs) -> FragmentOutputs {
  let drawn = textureSample(textureSampler, textureSamplerSampler, input.vUV).rgb;
  let c = clamp(curve(2.0 * uniforms.exposure * drawn) / curve(vec3f(11.2)).x, vec3f(0.0), vec3f(1.0));
  fragmentOutputs.color = vec4f(select(1.055 * pow(c, vec3f(1.0 / 2.4)) - 0.055, 12.92 * c, c <= vec3f(0.0031308)), 1.0);
}`;

function addToneMap(engine, camera, exposure) {
  const toneMap = new PostProcess("skinToneMap", "skinToneMap", {
    uniforms: ["exposure"], size: 1, camera, engine, textureType: Constants.TEXTURETYPE_HALF_FLOAT,
    shaderLanguage: engine.isWebGPU ? ShaderLanguage.WGSL : ShaderLanguage.GLSL,
  });
  toneMap.samples = 4;
  toneMap.onApply = effect => effect.setFloat("exposure", exposure);
}

try {
  const engine = await createEngine(), scene = new Scene(engine);
  const head = await loadSkinHead(scene), { settings } = head;
  for (const skin of head.skins) skin.scattering = !query.has("lambert");
  scene.imageProcessingConfiguration.applyByPostProcess = true;  // linear until the tone map
  scene.clearColor = Color4.FromColor3(head.background);
  const camera = new ArcRotateCamera("camera", 0, 0, 1, Vector3.Zero(), scene);
  placeSkinCamera(camera, settings);
  Object.assign(camera, { lowerRadiusLimit: 0.1, wheelDeltaPercentage: 0.01, panningSensibility: 5000 });
  camera.attachControl(canvas, true);
  addToneMap(engine, camera, settings.exposure);
  document.body.append(canvas);
  engine.resize();
  addEventListener("resize", () => engine.resize());
  await scene.whenReadyAsync();
  addSkinControls(head.motion, () => {});
  engine.runRenderLoop(() => scene.render());
  await new Promise(done => scene.onAfterRenderObservable.addOnce(() => requestAnimationFrame(done)));
  document.body.dataset.state = "drawn";
} catch (error) {
  message.textContent = error.message;
}
