// The head of a package as linear floats for tools/checks/host_floats.mjs, in place of head/head.js: ?side=96&points=4 (4 x 4 points in
// a pixel), &webgl, &lambert, &gain; &looks= and moments of a clip as floats.js says.
// Seeded mistakes: &mistake=normals (not bound), curvature (in 1/m), srgb (on a map of directions),
// levels (baked normals without mip levels), frames (bakes that do not turn with the surface).

import { FloatType, LinearFilter, NoToneMapping, PCFShadowMap, RenderTarget, Scene, SRGBColorSpace, WebGPURenderer } from "three/webgpu";
import { addSkinHead, loadSkinHead } from "../SkinHead.js";
import { looksOf, momentsOf, showFloats } from "./floats.js";

const query = new URLSearchParams(location.search), side = Number(query.get("side")), points = Number(query.get("points"));

function dress(head, name) {
  if (name === "frames") head.group.traverse(node => node.geometry?.deleteAttribute("texcoord_6"));
  for (const skin of head.skins) {
    skin.whole ??= { bakedNormals: skin.bakedNormals, curvatureGain: skin.curvatureGain };
    Object.assign(skin, skin.whole, { scattering: name !== "lambert", gain: name === "gain", needsUpdate: true });
    if (name === "normals") skin.bakedNormals = null;
    if (name === "curvature") skin.curvatureGain = 0.001;
    if (name === "srgb" && skin.bakedNormals) for (const map of Object.values(skin.bakedNormals)) map.colorSpace = SRGBColorSpace;
    if (name === "levels" && skin.bakedNormals)
      for (const map of Object.values(skin.bakedNormals)) Object.assign(map, { mipmaps: [], minFilter: LinearFilter, needsUpdate: true });
  }
}

try {
  const head = await loadSkinHead(), scene = new Scene(), wide = side * points;
  addSkinHead(scene, head);
  const renderer = new WebGPURenderer({ forceWebGL: query.has("webgl") });
  renderer.toneMapping = NoToneMapping;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  await renderer.init();
  const target = new RenderTarget(wide, wide, { type: FloatType });
  renderer.setRenderTarget(target);
  const squares = [];
  for (const { clip, time_s } of momentsOf(query)) {
    head.motion.pose(clip, time_s);
    for (const look of looksOf(query)) {
      dress(head, look);
      for (let i = 0; i < 2; ++i) renderer.render(scene, head.camera);
      squares.push(await renderer.readRenderTargetPixelsAsync(target, 0, 0, wide, wide));
    }
  }
  showFloats(squares, { side, points, fromBottom: !renderer.backend.isWebGPUBackend });
} catch (error) {
  document.getElementById("message").textContent = error.message;
}
