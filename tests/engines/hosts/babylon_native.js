// The edge of a light on flat skin in Babylon.js with the profile of ../skin_profile.js, for tools/checks/host_floats.mjs: a row of linear
// pixels, from the lit half to the dark one. A pixel is 0.04 mm; ?pixels=1024 is the row's length, ?lambert leaves the profile out.

import { FreeCamera } from "@babylonjs/core/Cameras/freeCamera.js";
import { Engine } from "@babylonjs/core/Engines/engine.js";
import { DirectionalLight } from "@babylonjs/core/Lights/directionalLight.js";
import { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import { Color3, Color4 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import { VertexData } from "@babylonjs/core/Meshes/mesh.vertexData.js";
import { Scene } from "@babylonjs/core/scene.js";
import { applySkinProfile } from "../skin_profile.js";

const kMetresPerPixel = 0.04e-3, kDistance = 0.2, kHigh = 64;

// Half of a plane that faces the camera; without light where its normals are across.
function half(scene, material, { from, to, normal }) {
  const mesh = new Mesh("half", scene), vertices = new VertexData();
  const positions = [from, -1, 0, to, -1, 0, to, 1, 0, from, 1, 0], normals = [normal, normal, normal, normal].flat();
  Object.assign(vertices, { positions, normals, indices: [0, 1, 2, 0, 2, 3] });
  vertices.applyToMesh(mesh);
  mesh.material = material;
}

function addPlane(scene) {
  const material = new PBRMaterial("skin", scene);
  Object.assign(material, { metallic: 0, roughness: 1, specularIntensity: 0, albedoColor: new Color3(0.5, 0.5, 0.5), backFaceCulling: false });
  half(scene, material, { from: -1, to: 0, normal: [0, 0, 1] });
  half(scene, material, { from: 0, to: 1, normal: [1, 0, 0] });
  return material;
}

const linear = level => level / 255 <= 0.04045 ? level / 255 / 12.92 : ((level / 255 + 0.055) / 1.055) ** 2.4;

try {
  const query = new URLSearchParams(location.search), canvas = document.createElement("canvas");
  canvas.width = Number(query.get("pixels"));
  canvas.height = kHigh;
  const engine = new Engine(canvas, false, { useExactSrgbConversions: true, preserveDrawingBuffer: true }), scene = new Scene(engine);
  scene.useRightHandedSystem = true;
  scene.clearColor = new Color4(0, 0, 0, 1);
  const camera = new FreeCamera("camera", new Vector3(0, 0, kDistance), scene);
  camera.setTarget(Vector3.Zero());
  Object.assign(camera, { fov: 2 * Math.atan(kHigh * kMetresPerPixel / 2 / kDistance), minZ: 0.05, maxZ: 1 });
  const light = new DirectionalLight("light", new Vector3(0, 0, -1), scene), material = addPlane(scene);
  light.intensity = 2;
  if (!query.has("lambert")) applySkinProfile(material);
  await scene.whenReadyAsync();
  const isReady = () => !scene.subSurfaceConfiguration || scene.subSurfaceConfiguration.postProcess?.isReady();
  for (let late = 0; late < 3; late += Number(Boolean(isReady()))) {  // frames after the blur's shader is there
    scene.render();
    await new Promise(done => setTimeout(done, 20));
  }
  scene.render();
  const rgba = await engine.readPixels(0, kHigh / 2, canvas.width, 1), row = new Float32Array(3 * canvas.width);
  for (let x = 0; x < canvas.width; ++x) for (let c = 0; c < 3; ++c) row[3 * x + c] = linear(rgba[4 * x + c]);
  window.picture = { width: canvas.width, height: 1, base64: btoa(String.fromCharCode(...new Uint8Array(row.buffer))) };
  document.body.dataset.state = "drawn";
} catch (error) {
  document.getElementById("message").textContent = error.message;
}
