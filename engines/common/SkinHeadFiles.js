// The files of a head of `dermis export --engine ... SCENE` for any engine in a browser: settings, meshes as arrays, pictures as
// blobs. Lengths are metres where a name has no unit.

import { SkinHeadMotion } from "./SkinHeadMotion.js";
import { pictureOf, texelsOf } from "./SkinMipLevels.js";

const kMmPerUnit = 1000, kShadowMapSide = 2048;
const kArrays = { 5123: Uint16Array, 5125: Uint32Array, 5126: Float32Array };  // glTF 2.0, accessor.componentType
const kNumbers = { SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16 };

export const metres = lengthsMm => lengthsMm.map(length => length / kMmPerUnit);

// A promise of scene.json. Rejected with a sentence where it is missing.
export async function readSettings(folder, engine) {
  const answer = await fetch(folder + "scene.json");
  if (!answer.ok) throw new Error(`The head cannot be loaded from ${folder}: export one with \`dermis export --engine ${engine} SCENE\``);
  return answer.json();
}

// A promise of the bytes of a file beside it.
export async function readBytes(url) {
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`A file of the head cannot be loaded from ${url}`);
  return answer.arrayBuffer();
}

// A promise of the texels of a picture beside it: { data, width, height }, RGBA in bytes.
export const readTexels = async url => texelsOf(await pictureOf(new Blob([await readBytes(url)])));

// Of the shadow map of a directional light: its side in texels, half the width that it covers, how far from the middle of the head the
// light is, between which distances from it the map has depths, and the width of a texel.
export function shadowFrustum({ bounds }) {
  const radius = bounds.radius_mm / kMmPerUnit;
  return { side: kShadowMapSide, radius, distance: 2 * radius, near: 0.5 * radius, far: 3.5 * radius, texel: 2 * radius / kShadowMapSide };
}

// An accessor as an array of its own: attributes may share a view, morph targets are often sparse. `bytes` of the file, whose buffer begins
// at `start`.
function numbersOf(json, start, bytes, accessor) {
  const { bufferView, byteOffset = 0, componentType, count, type, sparse } = json.accessors[accessor], each = kNumbers[type];
  const Kind = kArrays[componentType];
  if (!Kind || !each) throw new Error(`component type ${componentType} is not read`);
  const arrayOf = (view, Type, length) => new Type(bytes, start + (json.bufferViews[view].byteOffset ?? 0), length);
  const numbers = new Kind(count * each), size = Kind.BYTES_PER_ELEMENT;
  if (bufferView !== undefined) {
    const { byteLength, byteStride = size * each } = json.bufferViews[bufferView], all = arrayOf(bufferView, Kind, byteLength / size);
    const stride = byteStride / size, first = byteOffset / size;
    for (let i = 0; i < count; ++i) numbers.set(all.subarray(first + i * stride, first + i * stride + each), i * each);
  }
  if (sparse) {
    const places = arrayOf(sparse.indices.bufferView, kArrays[sparse.indices.componentType], sparse.count);
    const values = arrayOf(sparse.values.bufferView, Kind, sparse.count * each);
    places.forEach((place, i) => numbers.set(values.subarray(i * each, (i + 1) * each), place * each));
  }
  return numbers;
}

// A promise of { primitives, materials, pictureOf, motion } of an object_N.glb: of each primitive the arrays by the names of glTF, indices,
// the number of its material and of its mesh; materials as glTF has them; of a texture of glTF its picture as a blob; a SkinHeadMotion,
// null for a head that does not move.
export async function readGlb(url) {
  const bytes = await readBytes(url), header = new DataView(bytes), jsonBytes = header.getUint32(12, true), start = 20 + jsonBytes + 8;
  const json = JSON.parse(new TextDecoder().decode(new Uint8Array(bytes, 20, jsonBytes)));
  const numbers = accessor => numbersOf(json, start, bytes, accessor);
  const arrays = new Map();  // primitives share their attributes
  const shared = accessor => {
    if (!arrays.has(accessor)) arrays.set(accessor, numbers(accessor));
    return arrays.get(accessor);
  };
  const primitives = json.meshes.flatMap((mesh, number) => mesh.primitives.map(({ attributes, indices, material }) => ({
    attributes: Object.fromEntries(Object.entries(attributes).map(([name, accessor]) => [name, shared(accessor)])),
    indices: numbers(indices),
    material,
    mesh: number,
  })));
  const motion = json.animations || json.skins || json.meshes.some(mesh => mesh.primitives[0].targets) ? new SkinHeadMotion(json, shared) : null;
  const pictureOf = ({ index }) => {
    const { bufferView, mimeType } = json.images[json.textures[index].source], { byteOffset = 0, byteLength } = json.bufferViews[bufferView];
    return new Blob([new Uint8Array(bytes, start + byteOffset, byteLength)], { type: mimeType });
  };
  return { primitives, materials: json.materials, pictureOf, motion };
}
