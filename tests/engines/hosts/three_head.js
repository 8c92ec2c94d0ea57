// The head of a package as linear floats for tools/checks/host_floats.mjs, in place of head/head.js: ?side=96&points=4 (4 x 4 points in
// a pixel), &webgl, &lambert.
// Seeded mistakes: &mistake=normals (not bound), curvature (in 1/m), srgb (on a map of directions).

import { FloatType, NoToneMapping, PCFShadowMap, RenderTarget, Scene, SRGBColorSpace, WebGPURenderer } from "three/webgpu";
import { addSkinHead, loadSkinHead } from "../SkinHead.js";

const query = new URLSearchParams(location.search), side = Number(query.get("side")), points = Number(query.get("points"));

// WebGL 2 reads rows from the bottom.
function means(floats, wide, fromBottom) {
  const picture = new Float32Array(side * side * 3), share = 1 / (points * points);
  for (let y = 0; y < wide; ++y)
    for (let x = 0; x < wide; ++x)
      for (let c = 0; c < 3; ++c)
        picture[3 * (Math.floor(y / points) * side + Math.floor(x / points)) + c] +=
          share * floats[4 * ((fromBottom ? wide - 1 - y : y) * wide + x) + c];
  return picture;
}

function base64(floats) {
  const bytes = new Uint8Array(floats.buffer);
  let text = "";
  for (let i = 0; i < bytes.length; i += 4096) text += String.fromCharCode(...bytes.subarray(i, i + 4096));
  return btoa(text);
}

function makeMistake(head, name) {
  for (const skin of head.skins) {
    if (name === "normals") skin.bakedNormals = null;
    if (name === "curvature") skin.curvatureGain = 0.001;
    if (name === "srgb" && skin.bakedNormals) for (const map of Object.values(skin.bakedNormals)) map.colorSpace = SRGBColorSpace;
  }
}

try {
  const head = await loadSkinHead(), scene = new Scene(), wide = side * points;
  addSkinHead(scene, head);
  makeMistake(head, query.get("mistake"));
  for (const skin of head.skins) skin.scattering = !query.has("lambert");
  const renderer = new WebGPURenderer({ forceWebGL: query.has("webgl") });
  renderer.toneMapping = NoToneMapping;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  await renderer.init();
  const target = new RenderTarget(wide, wide, { type: FloatType });
  renderer.setRenderTarget(target);
  for (let i = 0; i < 2; ++i) renderer.render(scene, head.camera);
  const floats = await renderer.readRenderTargetPixelsAsync(target, 0, 0, wide, wide);
  window.picture = { width: side, height: side, base64: base64(means(floats, wide, !renderer.backend.isWebGPUBackend)) };
  document.body.dataset.state = "drawn";
} catch (error) {
  document.getElementById("message").textContent = error.message;
}
