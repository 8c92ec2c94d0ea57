// The exported head, as `dermis render` draws it.

import { CustomToneMapping, PCFShadowMap, Scene, Vector3, WebGPURenderer } from "three/webgpu";
import { Fn, vec3 } from "three/tsl";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { addSkinHead, loadSkinHead } from "../SkinHead.js";
import { addSkinControls } from "../SkinHeadControls.js";

const query = new URLSearchParams(location.search), message = document.getElementById("message");

// Hable 2010, "Uncharted 2: HDR Lighting", with its bias of 2 and a white of 11.2.
const curve = x => x.mul(x.mul(0.15).add(0.05)).add(0.004).div(x.mul(x.mul(0.15).add(0.5)).add(0.06)).sub(0.02 / 0.3);
const hable = Fn(([color, exposure]) => curve(color.mul(exposure).mul(2)).div(curve(vec3(11.2)).x).clamp());

try {
  const head = await loadSkinHead(), scene = new Scene(), { camera } = head;
  addSkinHead(scene, head);
  for (const skin of head.skins) skin.scattering = !query.has("lambert");
  const renderer = new WebGPURenderer({ antialias: true, forceWebGL: query.has("webgl") });
  renderer.library.addToneMapping(hable, CustomToneMapping);
  renderer.toneMapping = CustomToneMapping;
  renderer.toneMappingExposure = head.settings.exposure;
  renderer.shadowMap.enabled = true;
  renderer.shadowMap.type = PCFShadowMap;
  await renderer.init();
  document.body.append(renderer.domElement);
  const draw = () => {
    camera.aspect = innerWidth / innerHeight;
    camera.updateProjectionMatrix();
    renderer.setSize(innerWidth, innerHeight);
    renderer.render(scene, camera);
  };
  const controls = new OrbitControls(camera, renderer.domElement);
  controls.target = new Vector3(...head.settings.camera.target_mm).divideScalar(1000);
  controls.update();
  controls.addEventListener("change", draw);
  addEventListener("resize", draw);
  addSkinControls(head.motion, draw);
  draw();
  await new Promise(done => requestAnimationFrame(done));
  draw();
  document.body.dataset.state = "drawn";
} catch (error) {
  message.textContent = error.message;
}
