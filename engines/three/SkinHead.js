// The head of `dermis export --engine three SCENE`: meshes with their maps bound, lights, camera and environment, as
// `dermis render` has them. Units are metres.
//
//     const head = await loadSkinHead();
//     scene.add(head.group);  scene.environment = head.environment;
//     renderer.shadowMap.enabled = true;

import {
  AnimationMixer, BufferAttribute, Color, DataTexture, DataUtils, DirectionalLight, DoubleSide, EquirectangularReflectionMapping, Group,
  HalfFloatType, LinearFilter, LinearMipmapLinearFilter, LoopOnce, NoColorSpace, ObjectSpaceNormalMap, PerspectiveCamera, PointLight, RGBAFormat,
  SpotLight, TextureLoader, Vector3,
} from "three/webgpu";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { HDRLoader } from "three/addons/loaders/HDRLoader.js";
import { changesIn, SkinHeadCurvature } from "./SkinHeadCurvature.js";
import { metres, readBytes, readSettings, readTexels, shadowFrustum } from "./SkinHeadFiles.js";
import { fineMipLevels, mipLevels, pictureOf } from "./SkinMipLevels.js";
import { loadSkinTable, SkinNodeMaterial } from "./SkinNodeMaterial.js";

const vector = lengthsMm => new Vector3(...metres(lengthsMm));

// Of lengths and factors: not colours.
async function loadData(url) {
  const texture = await new TextureLoader().loadAsync(url)
    .catch(() => { throw new Error(`A map of the head cannot be loaded from ${url}`); });
  texture.colorSpace = NoColorSpace;
  texture.flipY = false;
  return texture;
}

// A texture of directions.
function directions(mipmaps, type) {
  const [{ data, width, height }] = mipmaps, texture = new DataTexture(data, width, height, RGBAFormat, type);
  return Object.assign(texture, { mipmaps, minFilter: LinearMipmapLinearFilter, magFilter: LinearFilter, needsUpdate: true });
}

const loadPicture = async url => pictureOf(new Blob([await readBytes(url)]));
const loadDirections = async url => directions(mipLevels(await loadPicture(url)));

// Of 16 bits.
async function loadFineDirections(url) {
  const levels = fineMipLevels(await loadPicture(url));
  return directions(levels.map(level => ({ ...level, data: Uint16Array.from(level.data, DataUtils.toHalfFloat) })), HalfFloatType);
}

// One of glTF with such levels.
const withLevels = ({ image, wrapS, wrapT, channel }) => Object.assign(directions(mipLevels(image)), { wrapS, wrapT, channel });

function skinMaterial(source, settings, shared) {
  const { name, color, map, normalScale, roughness, roughnessMap, aoMap, side, shadowSide } = source;
  return new SkinNodeMaterial({
    name, color, map, normalScale, roughness, roughnessMap, aoMap, side, shadowSide, ...shared,
    normalMap: source.normalMap && withLevels(source.normalMap), f0: settings.f0, specularMap: source.specularIntensityMap ?? null, twoLobes: false,
  });
}

// The mean curvature follows the weights of the mesh's targets, whoever sets them, before the mesh is drawn.
function followTargets(mesh, texels, settings) {
  const { geometry, morphTargetDictionary } = mesh, names = [];
  for (const [name, i] of Object.entries(morphTargetDictionary)) names[i] = name;
  const numbers = geometry.getAttribute("texcoord_5"), given = geometry.getAttribute("uv2"), { count } = given;
  const places = Float32Array.from({ length: count }, (_, v) => numbers.getY(v));
  const curvature = new SkinHeadCurvature(changesIn(texels, settings, names, places), settings.most_per_mm, mesh.morphTargetInfluences);
  const bends = new BufferAttribute(new Float32Array(2 * count), 2);
  for (let v = 0; v < count; ++v) bends.setXY(v, given.getX(v), given.getY(v));
  geometry.setAttribute("uv2", bends);
  mesh.onBeforeRender = () => {
    if (!curvature.follow(mesh.morphTargetInfluences)) return;
    curvature.perMm.forEach((perMm, v) => bends.setX(v, given.getX(v) + perMm));
    bends.needsUpdate = true;
  };
}

async function loadObject(folder, object, shared, skins) {
  const { scene, animations } = await new GLTFLoader().loadAsync(folder + object.file);
  const settings = new Map(object.materials.map(one => [one.name, one])), made = new Map();
  const meshes = [], followed = object.curvature_of_targets;
  const texels = followed && await readTexels(folder + followed.file);
  scene.traverse(node => { if (node.isMesh) meshes.push(node); });
  for (const mesh of meshes) {
    const source = mesh.material, one = settings.get(source.name);
    mesh.castShadow = mesh.receiveShadow = one?.class !== "translucent";
    source.shadowSide = DoubleSide;  // three.js draws back faces alone: light would get between lips
    if (one?.class !== "skin") continue;
    if (!made.has(source)) {
      const skin = skinMaterial(source, one, shared);
      if (one.object_normal_map) {
        skin.normalMap = await loadDirections(folder + one.object_normal_map);
        skin.normalMapType = ObjectSpaceNormalMap;
      }
      made.set(source, skin);
      skins.push(skin);
    }
    mesh.material = made.get(source);
    if (followed && mesh.morphTargetInfluences) followTargets(mesh, texels, followed);
  }
  return { scene, animations };
}

// The clips of all objects by name. For another control of them, `animations` of the parts are three.js' own.
class SkinMotion {
  constructor(parts) {
    this.parts = parts.map(part => ({ ...part, mixer: new AnimationMixer(part.scene) }));
    const lengths = new Map();
    for (const { name, duration } of parts.flatMap(({ animations }) => animations)) lengths.set(name, Math.max(duration, lengths.get(name) ?? 0));
    this.clips = [...lengths].map(([name, length_s]) => ({ name, length_s }));
  }

  // The head at a time of a clip, whose end is held; without a name as its file opens.
  pose(name, time_s) {
    for (const { mixer, animations } of this.parts) {
      mixer.stopAllAction();
      const clip = animations.find(one => one.name === name);
      if (!clip) continue;
      const action = mixer.clipAction(clip).setLoop(LoopOnce);
      action.clampWhenFinished = true;
      action.play();
      mixer.setTime(time_s);
    }
  }
}

function castShadow(light, { side, radius, near, far, texel }) {
  const { shadow } = light;
  light.castShadow = true;
  shadow.mapSize.set(side, side);
  shadow.normalBias = 1.5 * texel;
  if (!light.isDirectionalLight) return;
  Object.assign(shadow.camera, { left: -radius, right: radius, top: radius, bottom: -radius, near, far });
}

function lightOf(settings, { bounds }, frustum) {
  const { kind, color_linear, intensity, to_light, position_mm, inner_angle_rad, outer_angle_rad } = settings;
  const color = new Color().setRGB(...color_linear), centre = vector(bounds.center_mm);
  const toLight = new Vector3(...to_light);
  let light = null;
  if (kind === "directional") {
    light = new DirectionalLight(color, intensity);
    light.position.copy(centre).addScaledVector(toLight, frustum.distance);
    light.target.position.copy(centre);
  } else if (kind === "point") {
    light = new PointLight(color, intensity);
    light.position.copy(vector(position_mm));
  } else {
    light = new SpotLight(color, intensity, 0, outer_angle_rad, 1 - inner_angle_rad / outer_angle_rad);
    light.position.copy(vector(position_mm));
    light.target.position.copy(light.position).sub(toLight);
  }
  light.name = settings.name;
  if (settings.casts_shadow) castShadow(light, frustum);
  return light;
}

// A promise of { group, skins, motion, camera, environment, environmentIntensity, environmentYaw, background, settings }. Rejected with a
// sentence where a file is missing. An aspect is for the camera. motion.clips are [{ name, length_s }], motion.pose(name, seconds) moves the head.
export async function loadSkinHead(folder = new URL("./head/", import.meta.url).href) {
  const settings = await readSettings(folder, "three"), { baked_normals, thickness, environment, camera } = settings;
  const shared = { table: await loadSkinTable(), penumbraMm: settings.penumbra_mm }, frustum = shadowFrustum(settings);
  if (environment) shared.environmentHarmonics = environment.radiance_sh.map(color => new Vector3(...color));
  if (baked_normals) {
    const [red, green, spread] = await Promise.all(
      baked_normals.map((file, i) => (i === 0 ? loadFineDirections : loadDirections)(folder + file)));
    shared.bakedNormals = { red, green, spread };
  }
  if (thickness) {
    shared.thicknessMap = await loadData(folder + thickness.file);
    shared.thicknessMap.channel = 1;
    shared.thicknessMaxMm = thickness.max_mm;
  }
  const group = new Group(), skins = [], parts = [];
  for (const object of settings.objects) parts.push(await loadObject(folder, object, shared, skins));
  group.add(...parts.map(({ scene }) => scene));
  for (const one of settings.lights) {
    const light = lightOf(one, settings, frustum);
    group.add(light);
    if (light.target) group.add(light.target);
  }
  const eye = new PerspectiveCamera(camera.vertical_fov_rad * 180 / Math.PI, 1, 0.05, 20);
  eye.position.copy(vector(camera.eye_mm));
  eye.up.set(...camera.up);
  eye.lookAt(vector(camera.target_mm));
  const motion = new SkinMotion(parts);
  const head = { group, skins, motion, camera: eye, settings, background: new Color().setRGB(...settings.background_linear), environment: null };
  if (environment) {
    head.environment = await new HDRLoader().loadAsync(folder + environment.file);
    head.environment.mapping = EquirectangularReflectionMapping;
  }
  return head;
}

// Puts all of it into a scene.
export function addSkinHead(scene, head) {
  const { environment } = head.settings;
  scene.add(head.group);
  scene.background = head.background;
  if (!environment) return;
  scene.environment = head.environment;
  scene.environmentIntensity = environment.intensity;
  scene.environmentRotation.y = Math.PI / 2 - environment.yaw_rad;  // the middle of the panorama is -Z
}
