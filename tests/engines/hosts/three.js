// The package's material in the scenes of the test (host_scenes.h): ?environment, ?probe, ?hemisphere, ?point, ?spot, ?lights, ?shadow,
// ?bumps, ?through, ?sheet; units are metres.

import {
  BufferAttribute, BufferGeometry, Color, DirectionalLight, EquirectangularReflectionMapping, HemisphereLight, LightProbe, Mesh,
  LinearFilter, MeshBasicMaterial, NoToneMapping, PCFShadowMap, PerspectiveCamera, PointLight, Scene, SphereGeometry, SpotLight,
  TextureLoader, WebGPURenderer,
} from "three/webgpu";
import { HDRLoader } from "three/addons/loaders/HDRLoader.js";
import { loadSkinTable, SkinNodeMaterial } from "../SkinNodeMaterial.js";

const query = new URLSearchParams(location.search), message = document.getElementById("message");
const data = await (await fetch("scene.json")).json();
const skin = new SkinNodeMaterial({ color: new Color().setRGB(0.48, 0.19, 0.11), table: await loadSkinTable() });
const scene = new Scene();
scene.background = new Color().setRGB(0.02, 0.02, 0.02);

const geometryOf = ({ positions_mm, normals, tangents, uvs, indices }) => {
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new BufferAttribute(Float32Array.from(positions_mm, x => x / 1000), 3));
  geometry.setAttribute("normal", new BufferAttribute(new Float32Array(normals), 3));
  geometry.setAttribute("tangent", new BufferAttribute(new Float32Array(tangents), 4));
  geometry.setAttribute("uv", new BufferAttribute(new Float32Array(uvs), 2));
  geometry.setIndex(indices);
  return geometry;
};

// A light from behind, through skin of the thickness in thickness.png.
const addBehind = async () => {
  const light = new DirectionalLight(0xffffff, data.behind.intensity);
  light.position.fromArray(data.behind.to_light).multiplyScalar(0.15);
  scene.add(light);
  skin.thicknessMap = await new TextureLoader().loadAsync("thickness.png");
  Object.assign(skin.thicknessMap, { minFilter: LinearFilter, generateMipmaps: false });
  skin.thicknessMaxMm = data.behind.max_mm;
  return light;
};
const castShadow = (light, card, half) => {
  light.castShadow = true;
  light.shadow.mapSize.set(1024, 1024);
  Object.assign(light.shadow.camera, { left: -half, right: half, top: half, bottom: -half, near: 0.01, far: 0.3 });
  light.shadow.normalBias = 0.0001;
  const board = new Mesh(geometryOf(card), new MeshBasicMaterial({ side: 2 }));
  board.castShadow = true;
  scene.add(board);
};

const add = {
  through: addBehind,
  async sheet() { castShadow(await addBehind(), data.board, 0.02); },
  async environment() {
    scene.environment = await new HDRLoader().loadAsync("environment.hdr");
    scene.environment.mapping = EquirectangularReflectionMapping;
    scene.environmentRotation.y = Math.PI / 2;  // the middle of the panorama is -Z
  },
  probe() {
    const probe = new LightProbe();
    probe.sh.coefficients.forEach((coefficient, i) => coefficient.fromArray(data.radiance_sh[i]));
    scene.add(probe);
  },
  hemisphere() {
    const [sky, ground] = [data.sky, data.ground].map(color => new Color().setRGB(...color));
    scene.add(new HemisphereLight(sky, ground, 1));
  },
  point() {
    const light = new PointLight(0xffffff, data.point.intensity);
    light.position.fromArray(data.point.position_mm).divideScalar(1000);
    scene.add(light);
  },
  spot() {
    const { target_mm, intensity, inner_deg, outer_deg } = data.spot;
    const light = new SpotLight(0xffffff, intensity, 0, outer_deg * Math.PI / 180, 1 - inner_deg / outer_deg);
    light.position.fromArray(data.point.position_mm).divideScalar(1000);
    light.target.position.fromArray(target_mm).divideScalar(1000);
    scene.add(light, light.target);
  },
  lights() {
    add.point();
    for (const { to_light, color } of data.distant) {
      const light = new DirectionalLight(new Color().setRGB(...color), Math.PI);
      light.position.fromArray(to_light);
      scene.add(light);
    }
  },
  shadow() {
    skin.scatteredShadow = false;
    const key = new DirectionalLight(0xffffff, Math.PI);
    key.position.fromArray(data.to_light).multiplyScalar(0.15);
    scene.add(key);
    castShadow(key, data.card, 0.012);
  },
  async bumps() {
    const key = new DirectionalLight(0xffffff, Math.PI);
    key.position.fromArray(data.to_light);
    scene.add(key);
    skin.normalMap = await new TextureLoader().loadAsync("bumps.png");
    skin.normalMap.anisotropy = 1;
  },
};
const name = Object.keys(add).find(one => query.has(one));
await add[name]();
const own = { bumps: data.sphere, through: data.sphere, sheet: data.sheet }[name];
const sphere = new Mesh(own ? geometryOf(own) : new SphereGeometry(0.008, 256, 128), skin);
sphere.receiveShadow = sphere.castShadow = name === "shadow" || name === "sheet";
scene.add(sphere);

const camera = new PerspectiveCamera(7, innerWidth / innerHeight, 0.01, 10);
camera.position.set(0, 0, 0.15);
const renderer = new WebGPURenderer({ antialias: true, forceWebGL: query.has("webgl") });
renderer.toneMapping = NoToneMapping;
renderer.shadowMap.enabled = true;
renderer.shadowMap.type = PCFShadowMap;
await renderer.init().catch(error => { message.textContent = error.message; throw error; });
document.body.append(renderer.domElement);
renderer.setSize(innerWidth, innerHeight);
renderer.render(scene, camera);
await new Promise(done => requestAnimationFrame(done));
renderer.render(scene, camera);
document.body.dataset.state = "drawn";
