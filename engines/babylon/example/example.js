// A sphere of 8 mm under one light: units are metres.

import { ArcRotateCamera } from "@babylonjs/core/Cameras/arcRotateCamera.js";
import { Engine } from "@babylonjs/core/Engines/engine.js";
import { WebGPUEngine } from "@babylonjs/core/Engines/webgpuEngine.js";
import { DirectionalLight } from "@babylonjs/core/Lights/directionalLight.js";
import { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import { Color3, Color4 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { CreateSphere } from "@babylonjs/core/Meshes/Builders/sphereBuilder.js";
import { Scene } from "@babylonjs/core/scene.js";
import { loadSkinTable, SkinMaterialPlugin } from "../SkinMaterialPlugin.js";

const query = new URLSearchParams(location.search), message = document.getElementById("message");
const canvas = document.createElement("canvas");

// Without this Babylon writes colours with a power of 2.2 in place of sRGB's curve.
const options = { antialias: true, useExactSrgbConversions: true };

async function createEngine() {
  if (query.has("webgl") || !(await WebGPUEngine.IsSupportedAsync)) return new Engine(canvas, true, options);
  const engine = new WebGPUEngine(canvas, options);
  await engine.initAsync();
  return engine;
}

const engine = await createEngine().catch(error => {
  message.textContent = `No WebGPU and no WebGL 2 here: ${error.message}`;
  throw error;
});
const scene = new Scene(engine);
scene.useRightHandedSystem = true;
scene.clearColor = Color4.FromColor3(new Color3(0.02, 0.02, 0.02).toGammaSpace(true));

const material = new PBRMaterial("skin", scene);
material.albedoColor = new Color3(0.48, 0.19, 0.11);
const skin = new SkinMaterialPlugin(material);
skin.closedForm = query.has("closed");
skin.curvatureFromVertices = query.get("missing") === "curvature";
if (!skin.closedForm && query.get("missing") !== "table")
  skin.table = await loadSkinTable(scene).catch(error => { message.textContent = error.message; return null; });

CreateSphere("sphere", { diameter: 0.016, segments: 96 }, scene).material = material;
const key = new DirectionalLight("key", new Vector3(0.6275, -0.5736, -0.5266), scene);
key.intensity = Math.PI;

const camera = new ArcRotateCamera("camera", Math.PI / 2, Math.PI / 2, 0.15, Vector3.Zero(), scene);
camera.fov = 7 * Math.PI / 180;
camera.minZ = 0.01;
camera.lowerRadiusLimit = 0.03;
camera.wheelDeltaPercentage = 0.01;
camera.attachControl(canvas, true);

document.body.append(canvas);
engine.resize();
addEventListener("resize", () => engine.resize());
await scene.whenReadyAsync();
engine.runRenderLoop(() => scene.render());
document.body.dataset.state = "drawn";
