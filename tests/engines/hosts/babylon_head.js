// As three_head.js in Babylon.js.

import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { Constants } from "@babylonjs/core/Engines/constants.js";
import { Engine } from "@babylonjs/core/Engines/engine.js";
import { WebGPUEngine } from "@babylonjs/core/Engines/webgpuEngine.js";
import { RenderTargetTexture } from "@babylonjs/core/Materials/Textures/renderTargetTexture.js";
import { Color4 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { Scene } from "@babylonjs/core/scene.js";
import { loadSkinHead, placeSkinCamera } from "../SkinHead.js";
import { looksOf, momentsOf, showFloats } from "./floats.js";

const query = new URLSearchParams(location.search), side = Number(query.get("side")), points = Number(query.get("points"));

function dress(head, name) {
  if (name === "frames") for (const mesh of head.meshes) mesh.removeVerticesData("skin_frame");
  for (const skin of head.skins) {
    skin.whole ??= { bakedNormals: skin.bakedNormals, curvatureGain: skin.curvatureGain };
    Object.assign(skin, skin.whole, { scattering: name !== "lambert", gain: name === "gain" });
    skin.markAllDefinesAsDirty();
    if (name === "normals") skin.bakedNormals = null;
    if (name === "curvature") skin.curvatureGain = 0.001;
    if (name === "srgb" && skin.bakedNormals) for (const map of Object.values(skin.bakedNormals)) map.gammaSpace = true;
    if (name === "levels" && skin.bakedNormals)
      for (const map of Object.values(skin.bakedNormals)) map.updateSamplingMode(Constants.TEXTURE_BILINEAR_SAMPLINGMODE);
  }
}

try {
  const wide = side * points, canvas = document.createElement("canvas");
  canvas.width = canvas.height = 1;  // what is measured is drawn into a texture
  const options = { useExactSrgbConversions: true };
  const engine = query.has("webgl") ? new Engine(canvas, false, options) : new WebGPUEngine(canvas, options);
  await engine.initAsync?.();
  const scene = new Scene(engine), head = await loadSkinHead(scene);
  scene.imageProcessingConfiguration.applyByPostProcess = true;  // linear
  const camera = new FreeCamera("camera", Vector3.Zero(), scene);
  placeSkinCamera(camera, head.settings);
  const target = new RenderTargetTexture("linear", wide, scene, { type: Constants.TEXTURETYPE_FLOAT, generateMipMaps: false });
  target.clearColor = Color4.FromColor3(head.background);
  target.activeCamera = camera;
  target.renderList = head.meshes;
  scene.activeCamera = new FreeCamera("of the canvas", Vector3.Zero(), scene);
  scene.activeCamera.layerMask = 0;  // draws nothing: its shaders would be built too
  scene.customRenderTargets.push(target);
  const squares = [];
  for (const { clip, time_s } of momentsOf(query)) {
    head.motion.pose(clip, time_s);
    for (const look of looksOf(query)) {
      dress(head, look);
      await scene.whenReadyAsync();
      for (let i = 0; i < 2; ++i) scene.render();
      squares.push((await target.readPixels()).slice());
    }
  }
  showFloats(squares, { side, points, fromBottom: true });
} catch (error) {
  document.getElementById("message").textContent = error.message;
}
