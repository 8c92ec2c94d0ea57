// A sphere of 8 mm under one light: units are metres.

import {
  Color, DirectionalLight, Mesh, NoToneMapping, PerspectiveCamera, Scene, SphereGeometry, WebGPURenderer,
} from "three/webgpu";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { loadSkinTable, SkinNodeMaterial } from "../SkinNodeMaterial.js";

const query = new URLSearchParams(location.search), message = document.getElementById("message");

const skin = new SkinNodeMaterial({ color: new Color().setRGB(0.48, 0.19, 0.11), closedForm: query.has("closed") });
if (!skin.closedForm && query.get("missing") !== "table")
  skin.table = await loadSkinTable().catch(error => { message.textContent = error.message; return null; });
if (query.get("missing") === "curvature") skin.curvatureAttribute = "curvature_per_mm";

const scene = new Scene();
scene.background = new Color().setRGB(0.02, 0.02, 0.02);
scene.add(new Mesh(new SphereGeometry(0.008, 256, 128), skin));
const key = new DirectionalLight(0xffffff, Math.PI);
key.position.set(-0.6275, 0.5736, 0.5266);
scene.add(key);

const camera = new PerspectiveCamera(7, innerWidth / innerHeight, 0.01, 10);
camera.position.set(0, 0, 0.15);

const renderer = new WebGPURenderer({ antialias: true, forceWebGL: query.has("webgl") });
renderer.toneMapping = NoToneMapping;
await renderer.init().catch(error => { message.textContent = `No WebGPU and no WebGL 2 here: ${error.message}`; throw error; });
document.body.append(renderer.domElement);

const draw = () => {
  camera.aspect = innerWidth / innerHeight;
  camera.updateProjectionMatrix();
  renderer.setSize(innerWidth, innerHeight);
  renderer.render(scene, camera);
};
new OrbitControls(camera, renderer.domElement).addEventListener("change", draw);
addEventListener("resize", draw);
draw();
document.body.dataset.state = "drawn";
