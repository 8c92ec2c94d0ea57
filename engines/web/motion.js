// Clips of the page's objects: a pose is evaluated on the CPU, then the GPU gets positions, normals, tangents and curvature.

import { SkinHeadCurvature } from "./SkinHeadCurvature.js";
import { SkinHeadMotion } from "./SkinHeadMotion.js";

const kArrays = { f32: Float32Array, s16: Int16Array, s8: Int8Array, u16: Uint16Array, u32: Uint32Array };
const kMmPerM = 1000;
const kSizes = [3, 3, 3, 1], kFloats = 10;  // of a vertex: position in mm, normal, tangent, change of the mean curvature in 1/mm
const kFirstAttribute = 6;                  // skin.vert

// Values in motion.bin (dermis/engines/web/motion.cpp). With `places` those of every other vertex are 0.
function numbersOf(buffer, { offset, count, type, scale = 1, places, total }) {
  const stored = new kArrays[type](buffer, offset, count);
  if (!places) return scale === 1 ? stored : Float32Array.from(stored, x => x * scale);
  const numbers = new Float32Array(total), width = count / places.count;
  numbersOf(buffer, places).forEach((place, i) => {
    for (let k = 0; k < width; ++k) numbers[width * place + k] = stored[width * i + k] * scale;
  });
  return numbers;
}

class MovingObject {
  constructor(gl, { motion, vertices }, buffer, array) {
    this.gl = gl;
    this.motion = new SkinHeadMotion(motion, accessor => numbersOf(buffer, accessor));
    this.curvatures = this.motion.parts.map(({ mesh, weights }) => {
      const changes = motion.meshes[mesh].primitives[0].targets.map(({ CURVATURE }) => CURVATURE ? numbersOf(buffer, CURVATURE) : null);
      return new SkinHeadCurvature(changes, motion.most_curvature_per_mm, weights);
    });
    this.places = this.motion.parts.map(({ mesh }) => numbersOf(buffer, motion.meshes[mesh].vertices));
    this.vertices = new Float32Array(kFloats * vertices.count);
    this.stream = gl.createBuffer();
    gl.bindVertexArray(array);
    gl.bindBuffer(gl.ARRAY_BUFFER, this.stream);
    gl.bufferData(gl.ARRAY_BUFFER, this.vertices.byteLength, gl.DYNAMIC_DRAW);
    kSizes.forEach((size, i) => {
      gl.enableVertexAttribArray(kFirstAttribute + i);
      gl.vertexAttribPointer(kFirstAttribute + i, size, gl.FLOAT, false, 4 * kFloats, 12 * i);
    });
    gl.bindVertexArray(null);
  }

  pose(name, time_s) {
    const { gl, motion, vertices } = this;
    motion.pose(motion.clips.some(clip => clip.name === name) ? name : null, time_s);
    motion.parts.forEach(({ posed: { positions, normals, tangents }, posedWeights }, part) => {
      const curvature = this.curvatures[part];
      curvature.follow(posedWeights);
      this.places[part].forEach((place, i) => {
        for (let k = 0, to = kFloats * place; k < 3; ++k, ++to) {
          vertices[to] = positions[3 * i + k] * kMmPerM;
          vertices[to + 3] = normals[3 * i + k];
          vertices[to + 6] = tangents[4 * i + k];
        }
        vertices[kFloats * place + 9] = curvature.perMm[i] ?? 0;
      });
    });
    gl.bindBuffer(gl.ARRAY_BUFFER, this.stream);
    gl.bufferSubData(gl.ARRAY_BUFFER, 0, vertices);
  }

  // The largest distance of a vertex from a point.
  reach_mm([x, y, z]) {
    let most = 0;
    for (let i = 0; i < this.vertices.length; i += kFloats)
      most = Math.max(most, Math.hypot(this.vertices[i] - x, this.vertices[i + 1] - y, this.vertices[i + 2] - z));
    return most;
  }
}

// What SkinHeadControls.js plays: clips, and pose(name, seconds); without a name the objects are as they were exported. `arrays` are the
// vertex arrays of the objects, which get the streams of those that move. radius_mm contains all of the pose.
export function createMotion(gl, { objects, bounds }, buffer, arrays) {
  const moving = objects.flatMap((object, i) => object.motion ? [new MovingObject(gl, object, buffer, arrays[i])] : []);
  const clips = new Map();
  for (const { motion } of moving)
    for (const { name, length_s } of motion.clips) clips.set(name, Math.max(length_s, clips.get(name) ?? 0));
  const all = {
    clips: [...clips].map(([name, length_s]) => ({ name, length_s })),
    radius_mm: bounds.radius_mm,
    pose(name, time_s) {
      for (const one of moving) one.pose(name, time_s);
      all.radius_mm = Math.max(bounds.radius_mm, ...moving.map(one => one.reach_mm(bounds.center_mm)));
    }
  };
  all.pose(null, 0);
  return all;
}
