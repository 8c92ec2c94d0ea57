// A material of a head's GLB as Babylon's PBRMaterial, of skin with SkinMaterialPlugin. Textures have their first row at v = 0.

import { Constants } from "@babylonjs/core/Engines/constants.js";
import { Material } from "@babylonjs/core/Materials/material.js";
import { PBRMaterial } from "@babylonjs/core/Materials/PBR/pbrMaterial.js";
import { RawTexture } from "@babylonjs/core/Materials/Textures/rawTexture.js";
import { Texture } from "@babylonjs/core/Materials/Textures/texture.js";
import { Color3 } from "@babylonjs/core/Maths/math.color.js";
import { ToHalfFloat } from "@babylonjs/core/Misc/halfFloat.js";
import { readBytes } from "./SkinHeadFiles.js";
import { fineMipLevels, mipLevels, pictureOf } from "./SkinMipLevels.js";
import { SkinMaterialPlugin } from "./SkinMaterialPlugin.js";

// A promise of a texture; of a colour it holds sRGB, else lengths, directions and factors.
export const loadTexture = (scene, url, { isColor, mimeType }) => new Promise((done, fail) => {
  const texture = new Texture(url, scene, {
    invertY: false,
    useSRGBBuffer: isColor,
    mimeType,
    onLoad: () => {
      texture.gammaSpace = isColor && !texture._texture._useSRGBBuffer;
      done(texture);
    },
    onError: message => fail(new Error(`A map of the head cannot be loaded from ${url}: ${message}`)),
  });
  texture.gammaSpace = isColor;
  texture.anisotropicFilteringLevel = 1;  // as the renderer: the baked normals are of such a normal map
});

function withLevels(texture, levels, scene) {
  const engine = scene.getEngine();
  engine.flushFramebuffer();  // WebGPU would draw its own levels later, over these
  levels.forEach(({ data, width, height }, i) => engine.updateTextureData(texture._texture, data, 0, 0, width, height, 0, i));
  return texture;
}

const loadPicture = async (url, type) => pictureOf(new Blob([await readBytes(url)], { type }));

// A promise of a texture of directions.
export async function loadDirections(scene, url, mimeType = "image/png") {
  const levels = mipLevels(await loadPicture(url, mimeType));
  return withLevels(await loadTexture(scene, url, { isColor: false, mimeType }), levels, scene);
}

// Of 16 bits.
export async function loadFineDirections(scene, url) {
  const levels = fineMipLevels(await loadPicture(url, "image/png")).map(level => ({ ...level, data: Uint16Array.from(level.data, ToHalfFloat) }));
  const [{ data, width, height }] = levels;
  const texture = new RawTexture(data, width, height, Constants.TEXTUREFORMAT_RGBA, scene, true, false, Texture.TRILINEAR_SAMPLINGMODE,
    Constants.TEXTURETYPE_HALF_FLOAT);
  Object.assign(texture, { gammaSpace: false, anisotropicFilteringLevel: 1 });
  return withLevels(texture, levels, scene);
}

// Of a texture of glTF; null where there is none.
async function embedded(scene, glb, texture, kind = "data") {
  if (!texture) return null;
  const picture = glb.pictureOf(texture), url = URL.createObjectURL(picture);
  try {
    if (kind === "directions") return await loadDirections(scene, url, picture.type);
    return await loadTexture(scene, url, { isColor: kind === "color", mimeType: picture.type });
  } finally {
    URL.revokeObjectURL(url);
  }
}

function setSurface(material, { alphaMode, alphaCutoff = 0.5, doubleSided, pbrMetallicRoughness }) {
  const { baseColorFactor = [1, 1, 1, 1], roughnessFactor = 1 } = pbrMetallicRoughness;
  material.albedoColor = Color3.FromArray(baseColorFactor);
  material.roughness = roughnessFactor;
  material.sideOrientation = Material.CounterClockWiseSideOrientation;
  material.backFaceCulling = !doubleSided;
  material.twoSidedLighting = Boolean(doubleSided);
  if (!alphaMode) return;
  material.alpha = baseColorFactor[3];
  material.transparencyMode = alphaMode === "MASK" ? Material.MATERIAL_ALPHATEST : Material.MATERIAL_ALPHABLEND;
  material.alphaCutOff = alphaCutoff;
}

async function bindMaps(scene, glb, material, { pbrMetallicRoughness, normalTexture, occlusionTexture }) {
  const { baseColorTexture, metallicRoughnessTexture } = pbrMetallicRoughness;
  material.albedoTexture = await embedded(scene, glb, baseColorTexture, "color");
  if (material.albedoTexture && material.transparencyMode !== null) {
    material.albedoTexture.hasAlpha = true;
    material.useAlphaFromAlbedoTexture = true;
  }
  material.bumpTexture = await embedded(scene, glb, normalTexture, "directions");
  if (material.bumpTexture) material.bumpTexture.level = normalTexture.scale ?? 1;
  material.invertNormalMapY = true;  // the handedness of glTF in a right-handed scene
  material.metallicTexture = await embedded(scene, glb, metallicRoughnessTexture);
  material.useRoughnessFromMetallicTextureAlpha = false;
  material.useRoughnessFromMetallicTextureGreen = true;
  if (occlusionTexture) material.ambientTexture = material.metallicTexture;
  material.useAmbientInGrayScale = true;
}

async function skinOf(scene, material, { source, glb, folder, settings, shared }) {
  const { roughness } = material, skin = new SkinMaterialPlugin(material);
  material.roughness = roughness;
  material.useRadianceOverAlpha = material.useSpecularOverAlpha = material.useRadianceOcclusion = material.useHorizonOcclusion = false;
  Object.assign(skin, shared, { f0: settings.f0, twoLobes: false });
  skin.specularTexture = await embedded(scene, glb, source.extensions?.KHR_materials_specular?.specularTexture);
  if (!settings.object_normal_map) return skin;
  material.bumpTexture = await loadDirections(scene, folder + settings.object_normal_map);
  material.useObjectSpaceNormalMap = true;
  return skin;
}

async function otherOf(scene, glb, material, { extensions = {}, emissiveFactor, emissiveTexture, pbrMetallicRoughness }) {
  material.metallic = pbrMetallicRoughness.metallicFactor ?? 1;
  material.useMetallnessFromMetallicTextureBlue = true;
  material.indexOfRefraction = extensions.KHR_materials_ior?.ior ?? 1.5;
  material.metallicF0Factor = extensions.KHR_materials_specular?.specularFactor ?? 1;
  if (emissiveFactor) material.emissiveColor = Color3.FromArray(emissiveFactor);
  material.emissiveIntensity = extensions.KHR_materials_emissive_strength?.emissiveStrength ?? 1;
  material.emissiveTexture = await embedded(scene, glb, emissiveTexture, "color");
}

// A promise of { material, skin, settings }; skin is null for another class. `settings` are those of scene.json, `shared` is what all
// skin of the head has.
export async function materialOf(scene, parts) {
  const { source, glb, settings } = parts, material = new PBRMaterial(settings.name, scene);
  setSurface(material, source);
  await bindMaps(scene, glb, material, source);
  if (settings.class !== "skin") {
    await otherOf(scene, glb, material, source);
    return { material, skin: null, settings };
  }
  return { material, skin: await skinOf(scene, material, parts), settings };
}
