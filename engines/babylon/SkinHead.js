// The head of `dermis export --engine babylon SCENE`: meshes with their maps bound, lights with shadows, environment, as
// `dermis render` has them. Units are metres.
//
//     const head = await loadSkinHead(scene);   // of an engine with useExactSrgbConversions
//     scene.activeCamera = ...                  // head.settings.camera

import { DirectionalLight } from "@babylonjs/core/Lights/directionalLight.js";
import { PointLight } from "@babylonjs/core/Lights/pointLight.js";
import { ShadowGenerator } from "@babylonjs/core/Lights/Shadows/shadowGenerator.js";
import "@babylonjs/core/Lights/Shadows/shadowGeneratorSceneComponent.js";
import { SpotLight } from "@babylonjs/core/Lights/spotLight.js";
import { HDRCubeTexture } from "@babylonjs/core/Materials/Textures/hdrCubeTexture.js";
import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import { Vector3 } from "@babylonjs/core/Maths/math.vector.js";
import { Mesh } from "@babylonjs/core/Meshes/mesh.js";
import { VertexData } from "@babylonjs/core/Meshes/mesh.vertexData.js";
import { changesIn, SkinHeadCurvature } from "./SkinHeadCurvature.js";
import { metres, readGlb, readSettings, readTexels, shadowFrustum } from "./SkinHeadFiles.js";
import { loadDirections, loadFineDirections, loadTexture, materialOf } from "./SkinHeadMaterial.js";
import { loadSkinTable } from "./SkinMaterialPlugin.js";
import { frameAttribute, headAttributes } from "./SkinSurfaceCode.js";

const kEnvironmentSide = 128;
const vector = numbers => Vector3.FromArray(numbers);

// Pairs as one attribute of four.
function fours(xy, zw) {
  const all = new Float32Array(2 * xy.length);
  for (let v = 0; v < xy.length / 2; ++v) all.set([xy[2 * v], xy[2 * v + 1], zw[2 * v], zw[2 * v + 1]], 4 * v);
  return all;
}

// Pairs of a head as the attributes of SkinSurfaceCode.js: the atlas; two pairs; a pair and the first of another.
function addHeadAttributes(mesh, { TEXCOORD_1: atlas, TEXCOORD_2: bends, TEXCOORD_3: bend, TEXCOORD_4: occlusion, TEXCOORD_5: plain,
  TEXCOORD_6: frame, TEXCOORD_7: restOfFrame }) {
  if (!plain) return;
  const count = atlas.length / 2, ofOcclusion = new Float32Array(3 * count);
  for (let v = 0; v < count; ++v) ofOcclusion.set([occlusion[2 * v], occlusion[2 * v + 1], plain[2 * v]], 3 * v);
  Object.entries(headAttributes).forEach(([name, size], i) => mesh.setVerticesData(name, [atlas, fours(bends, bend), ofOcclusion][i], false, size));
  if (frame) mesh.setVerticesData(frameAttribute, fours(frame, restOfFrame), false, 4);
}

// What gives a mesh the mean curvature of a part's targets, in the pose of the part.
function followerOf(mesh, part, { TEXCOORD_2: bends, TEXCOORD_3: bend, TEXCOORD_5: plain }, texels, settings) {
  const numbers = Float32Array.from({ length: plain.length / 2 }, (_, v) => plain[2 * v + 1]), posed = fours(bends, bend);
  const curvature = new SkinHeadCurvature(changesIn(texels, settings, part.names, numbers), settings.most_per_mm, part.weights);
  mesh.setVerticesData("skin_bends", posed, true, 4);
  return () => {
    if (!curvature.follow(part.posedWeights)) return;
    curvature.perMm.forEach((perMm, v) => { posed[4 * v] = bends[2 * v] + perMm; });
    mesh.updateVerticesData("skin_bends", posed);
  };
}

// Its vertices are those of the world: of a part that moves in the pose.
function meshOf(scene, name, { attributes, indices }, part) {
  const { POSITION: positions, NORMAL: normals, TANGENT: tangents, TEXCOORD_0: uvs } = attributes;
  const vertices = new VertexData(), mesh = new Mesh(name, scene);
  Object.assign(vertices, { positions, normals, tangents, uvs, indices }, part?.posed);
  if (part?.mirrored) for (let i = 0; i < indices.length; i += 3) indices.subarray(i + 1, i + 3).reverse();
  vertices.applyToMesh(mesh, Boolean(part));
  mesh.alwaysSelectAsActiveMesh = Boolean(part);  // its bounds move
  addHeadAttributes(mesh, attributes);
  return mesh;
}

// The clips of all objects by name.
class SkinMotion {
  constructor() {
    this.moving = [];  // { motion, drawn: [{ mesh, part, follow }] }
    this.clips = [];
  }

  add(motion, drawn) {
    this.moving.push({ motion, drawn });
    for (const { name, length_s } of motion.clips) {
      const known = this.clips.find(clip => clip.name === name);
      if (known) known.length_s = Math.max(known.length_s, length_s);
      else this.clips.push({ name, length_s });
    }
  }

  // The head at a time of a clip, whose end is held; without a name as its file opens.
  pose(name, time_s) {
    for (const { motion, drawn } of this.moving) {
      motion.pose(name, time_s);
      for (const { mesh, part: { posed }, follow } of drawn) {
        mesh.updateVerticesData("position", posed.positions);
        mesh.updateVerticesData("normal", posed.normals);
        mesh.updateVerticesData("tangent", posed.tangents);
        follow();
      }
    }
  }
}

function lightOf(scene, settings, frustum, centre) {
  const { name, kind, color_linear, intensity, to_light, position_mm, inner_angle_rad, outer_angle_rad } = settings;
  const away = vector(to_light).scale(-1);
  let light = null;
  if (kind === "directional") {
    light = new DirectionalLight(name, away, scene);
    light.position = centre.subtract(away.scale(frustum.distance));
    const half = frustum.radius;
    Object.assign(light, { autoUpdateExtends: false, autoCalcShadowZBounds: false, shadowOrthoScale: 0, shadowMinZ: frustum.near, shadowMaxZ: frustum.far,
      orthoLeft: -half, orthoRight: half, orthoTop: half, orthoBottom: -half });
  } else if (kind === "point") {
    light = new PointLight(name, vector(metres(position_mm)), scene);
  } else {
    light = new SpotLight(name, vector(metres(position_mm)), away, 2 * outer_angle_rad, 0, scene);
    light.innerAngle = 2 * inner_angle_rad;
    light.falloffType = SpotLight.FALLOFF_GLTF;
  }
  light.diffuse = light.specular = Color3.FromArray(color_linear);
  light.intensity = intensity;
  return light;
}

function castShadow(light, { side, near, far, texel }, meshes) {
  const shadows = new ShadowGenerator(side, light);
  shadows.usePercentageCloserFiltering = true;
  shadows.bias = texel / (far - near);
  for (const mesh of meshes) shadows.addShadowCaster(mesh, false);
  return shadows;
}

const loadEnvironment = (scene, url) => new Promise((done, fail) => {
  const texture = new HDRCubeTexture(url, scene, kEnvironmentSide, false, true, false, true, () => done(texture),
    message => fail(new Error(`The environment of the head cannot be loaded from ${url}: ${message}`)));
});

async function addEnvironment(scene, { file, intensity, yaw_rad }, folder) {
  const texture = await loadEnvironment(scene, folder + file);
  texture.rotationY = -yaw_rad;
  texture.level = intensity;
  scene.environmentTexture = texture;
}

// The maps that all skin of the head shares.
async function sharedMaps(scene, { baked_normals, thickness }, folder) {
  const shared = { table: await loadSkinTable(scene) };
  if (baked_normals) {
    const [red, green, spread] = await Promise.all(
      baked_normals.map((file, i) => (i === 0 ? loadFineDirections : loadDirections)(scene, folder + file)));
    shared.bakedNormals = { red, green, spread };
  }
  if (thickness) {
    shared.thicknessTexture = await loadTexture(scene, folder + thickness.file, { isColor: false });
    shared.thicknessMaxMm = thickness.max_mm;
  }
  return shared;
}

// Adds all of it to a scene, which becomes right-handed. A promise of { meshes, skins, motion, lights, shadows, background, settings };
// skins are of SkinMaterialPlugin; motion.clips are [{ name, length_s }], motion.pose(name, seconds) moves the head. Rejected with a
// sentence where a file is missing.
export async function loadSkinHead(scene, folder = new URL("./head/", import.meta.url).href) {
  const settings = await readSettings(folder, "babylon"), frustum = shadowFrustum(settings), centre = vector(metres(settings.bounds.center_mm));
  scene.useRightHandedSystem = true;
  const shared = { ...await sharedMaps(scene, settings, folder), penumbraMm: settings.penumbra_mm };
  const meshes = [], casters = [], skins = [], motion = new SkinMotion();
  for (const object of settings.objects) {
    const glb = await readGlb(folder + object.file);
    const made = await Promise.all(glb.materials.map((source, i) =>
      materialOf(scene, { source, glb, folder, settings: object.materials[i], shared })));
    skins.push(...made.map(({ skin }) => skin).filter(skin => skin));
    const drawn = [], followed = object.curvature_of_targets;
    const texels = followed && await readTexels(folder + followed.file);
    for (const primitive of glb.primitives) {
      const part = glb.motion?.parts.find(one => one.mesh === primitive.mesh), mesh = meshOf(scene, object.name, primitive, part), { material, settings: one } = made[primitive.material];
      mesh.material = material;
      meshes.push(mesh);
      mesh.receiveShadows = one.class !== "translucent";
      if (mesh.receiveShadows) casters.push(mesh);
      const follows = followed && one.class === "skin";
      drawn.push({ mesh, part, follow: follows ? followerOf(mesh, part, primitive.attributes, texels, followed) : () => {} });
    }
    if (glb.motion) motion.add(glb.motion, drawn);
  }
  const lights = settings.lights.map(one => lightOf(scene, one, frustum, centre));
  const shadows = lights.filter((_, i) => settings.lights[i].casts_shadow).map(light => castShadow(light, frustum, casters));
  if (settings.environment) await addEnvironment(scene, settings.environment, folder);
  return { meshes, skins, motion, lights, shadows, background: Color3.FromArray(settings.background_linear), settings };
}

// Eye, target and field of view of the scene's camera on one of Babylon's.
export function placeSkinCamera(camera, { camera: { eye_mm, target_mm, up, vertical_fov_rad } }) {
  camera.upVector = vector(up);
  camera.position = vector(metres(eye_mm));
  camera.setTarget(vector(metres(target_mm)));
  Object.assign(camera, { fov: vertical_fov_rad, minZ: 0.05, maxZ: 20 });
}
