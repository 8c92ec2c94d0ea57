// The package's plugin in the scenes of the test (host_scenes.h): ?environment, ?hemisphere, ?point, ?spot, ?lights, ?shadow,
// ?bumps, ?through, ?sheet; units are metres.

import { ArcRotateCamera } from "@babylonjs/core/Cameras/arcRotateCamera.js";
import { Engine } from "@babylonjs/core/Engines/engine.js";
import { WebGPUEngine } from "@babylonjs/core/Engines/webgpuEngine.js";
import { DirectionalLight } from "@babylonjs/core/Lights/directionalLight.js";
import { HemisphericLight } from "@babylonjs/core/Lights/hemisphericLight.js";
import { PointLight } from "@babylonjs/core/Lights/pointLight.js";
import { SpotLight } from "@babylonjs/core/Lights/spotLight.js";
import { ShadowGenerator } from "@babylonjs/core/Lights/Shadows/shadowGenerator.js";
import "@babylonjs/core/Lights/Shadows/shadowGeneratorSceneComponent.js";
import { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import { HDRCubeTexture } from "@babylonjs/core/Materials/Textures/hdrCubeTexture.js";
import { Texture } from "@babylonjs/core/Materials/Textures/texture.js";
import { Color3, Color4 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { CreateSphere } from "@babylonjs/core/Meshes/Builders/sphereBuilder.js";
import { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import { VertexData } from "@babylonjs/core/Meshes/mesh.vertexData.js";
import { Scene } from "@babylonjs/core/scene.js";
import { loadSkinTable, SkinMaterialPlugin } from "../SkinMaterialPlugin.js";

import { ShaderStore } from "@babylonjs/core/Engines/shaderStore.js";

const query = new URLSearchParams(location.search);
// ?changed: a version of Babylon that writes a call of its shader with a space.
if (query.has("changed")) {
  await Promise.all([import("@babylonjs/core/Shaders/pbr.fragment.js"), import("@babylonjs/core/ShadersWGSL/pbr.fragment.js")]);
  for (const includes of [ShaderStore.IncludesShadersStore, ShaderStore.IncludesShadersStoreWGSL])
    includes.lightFragment = includes.lightFragment.replaceAll("computeDiffuseLighting(preInfo,", "computeDiffuseLighting(preInfo, ");
}
const data = await (await fetch("scene.json")).json();
const canvas = document.createElement("canvas");
canvas.style = "display: block; width: 100vw; height: 100vh";
document.body.append(canvas);
const options = { antialias: true, useExactSrgbConversions: true };
const engine = query.has("webgl") ? new Engine(canvas, true, options) : new WebGPUEngine(canvas, options);
await engine.initAsync?.();

const scene = new Scene(engine);
scene.useRightHandedSystem = true;
scene.clearColor = Color4.FromColor3(new Color3(0.02, 0.02, 0.02).toGammaSpace(true));
const material = new PBRMaterial("skin", scene);
material.albedoColor = new Color3(0.48, 0.19, 0.11);
const skin = new SkinMaterialPlugin(material);
skin.table = await loadSkinTable(scene);

const meshOf = (name, { positions_mm, normals, tangents, uvs, indices }) => {
  const vertices = new VertexData();
  Object.assign(vertices, { positions: positions_mm.map(x => x / 1000), normals, tangents, uvs, indices: indices.slice().reverse() });
  const mesh = new Mesh(name, scene);
  vertices.applyToMesh(mesh);
  return mesh;
};
const keyLight = () => {
  const key = new DirectionalLight("key", Vector3.FromArray(data.to_light).scale(-1), scene);
  key.intensity = Math.PI;
  return key;
};
const name = ["environment", "hemisphere", "point", "spot", "lights", "shadow", "bumps", "through", "sheet"].find(one => query.has(one));
const own = { bumps: data.sphere, through: data.sphere, sheet: data.sheet }[name];
const sphere = own ? meshOf("sphere", own) : CreateSphere("sphere", { diameter: 0.016, segments: 96 }, scene);
sphere.material = material;

const textureOf = (file, options) => new Promise((done, fail) => {
  const texture = new Texture(file, scene, { ...options, onLoad: () => done(texture), onError: fail });
});
const castShadow = (light, card, half) => {
  light.position = light.direction.scale(-0.15);
  Object.assign(light, { autoUpdateExtends: false, autoCalcShadowZBounds: false, shadowMinZ: 0.01, shadowMaxZ: 0.3,
    orthoLeft: -half, orthoRight: half, orthoTop: half, orthoBottom: -half });
  const shadows = new ShadowGenerator(1024, light);
  shadows.usePercentageCloserFiltering = true;
  shadows.bias = 0.001;
  const board = meshOf("card", card);
  board.material = new PBRMaterial("card", scene);
  board.material.backFaceCulling = false;
  shadows.addShadowCaster(board);
  shadows.addShadowCaster(sphere);
  sphere.receiveShadows = true;
};
// A light from behind, through skin of the thickness in thickness.png.
const addBehind = async () => {
  const { to_light, intensity, max_mm } = data.behind;
  const light = new DirectionalLight("behind", Vector3.FromArray(to_light).scale(-1), scene);
  light.intensity = intensity;
  skin.thicknessTexture = await textureOf("thickness.png", { noMipmap: true, samplingMode: Texture.BILINEAR_SAMPLINGMODE });
  Object.assign(skin.thicknessTexture, { gammaSpace: false, wrapU: Texture.CLAMP_ADDRESSMODE });
  skin.thicknessMaxMm = max_mm;
  return light;
};

const add = {
  through: addBehind,
  async sheet() { castShadow(await addBehind(), data.board, 0.02); },
  environment: () => new Promise((done, fail) => {
    scene.environmentTexture = new HDRCubeTexture("environment.hdr", scene, 128, false, true, false, true, done, fail);
  }),
  hemisphere() {
    const light = new HemisphericLight("sky", Vector3.Up(), scene);
    light.diffuse = Color3.FromArray(data.sky).scale(1 / Math.PI);
    light.groundColor = Color3.FromArray(data.ground).scale(1 / Math.PI);
    material.specularIntensity = 0;
  },
  point() {
    const light = new PointLight("lamp", Vector3.FromArray(data.point.position_mm).scale(0.001), scene);
    light.intensity = data.point.intensity;
  },
  spot() {
    const { target_mm, intensity, inner_deg, outer_deg } = data.spot;
    const position = Vector3.FromArray(data.point.position_mm).scale(0.001);
    const towards = Vector3.FromArray(target_mm).scale(0.001).subtract(position);
    const light = new SpotLight("spot", position, towards, outer_deg * Math.PI / 90, 0, scene);
    light.innerAngle = inner_deg * Math.PI / 90;
    light.falloffType = SpotLight.FALLOFF_GLTF;
    light.intensity = intensity;
  },
  lights() {
    add.point();
    for (const { to_light, color } of data.distant) {
      const light = new DirectionalLight("distant", Vector3.FromArray(to_light).scale(-1), scene);
      light.diffuse = light.specular = Color3.FromArray(color);
      light.intensity = Math.PI;
    }
  },
  shadow() { castShadow(keyLight(), data.card, 0.012); },
  async bumps() {
    keyLight();
    material.bumpTexture = await textureOf("bumps.png");
    material.bumpTexture.anisotropicFilteringLevel = 1;
  },
};
await add[name]();

const camera = new ArcRotateCamera("camera", Math.PI / 2, Math.PI / 2, 0.15, Vector3.Zero(), scene);
camera.fov = 7 * Math.PI / 180;
camera.minZ = 0.01;
engine.resize();
await scene.whenReadyAsync();
engine.runRenderLoop(() => scene.render());
document.body.dataset.state = "drawn";
