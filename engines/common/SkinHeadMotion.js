// The nodes, skins, morph targets and clips of an object_N.glb, evaluated on the CPU (glTF 2.0, section 3.11 and appendix C), for an
// engine whose own are not used: positions, normals and tangents of every vertex in the world, in metres.

// Column-major 4 x 4 matrices.
const identity = () => new Float64Array([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);

function multiply(a, b) {
  const c = new Float64Array(16);
  for (let column = 0; column < 4; ++column)
    for (let row = 0; row < 4; ++row)
      for (let k = 0; k < 4; ++k) c[4 * column + row] += a[4 * k + row] * b[4 * column + k];
  return c;
}

function matrixOf({ matrix, translation = [0, 0, 0], rotation = [0, 0, 0, 1], scale = [1, 1, 1] }) {
  if (matrix) return Float64Array.from(matrix);
  const length = Math.hypot(...rotation) || 1, [x, y, z, w] = rotation.map(q => q / length);
  const columns = [
    [1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)],
    [2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)],
    [2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)],
  ];
  return Float64Array.from([...columns.flatMap((column, i) => [...column.map(q => q * scale[i]), 0]), ...translation, 1]);
}

const determinant = m => m[0] * (m[5] * m[10] - m[6] * m[9]) - m[4] * (m[1] * m[10] - m[2] * m[9]) + m[8] * (m[1] * m[6] - m[2] * m[5]);

function arc(a, b, t) {
  const cosine = a.reduce((sum, q, i) => sum + q * b[i], 0), angle = Math.acos(Math.min(1, Math.abs(cosine))), straight = angle < 1e-6;
  const ofA = straight ? 1 - t : Math.sin((1 - t) * angle) / Math.sin(angle);
  const ofB = Math.sign(cosine || 1) * (straight ? t : Math.sin(t * angle) / Math.sin(angle));
  return a.map((q, i) => ofA * q + ofB * b[i]);
}

// `width` numbers of a channel at a time; the first and the last key are held.
function sample({ times, values, width, interpolation, path }, time_s) {
  const cubic = interpolation === "CUBICSPLINE", last = times.length - 1;
  const key = (k, part = 1) => Array.from(values.subarray((cubic ? 3 * k + part : k) * width, (cubic ? 3 * k + part + 1 : k + 1) * width));
  let k = 0;
  while (k < last && times[k + 1] <= time_s) ++k;
  if (time_s <= times[0] || k === last || interpolation === "STEP") return key(k);
  const length_s = times[k + 1] - times[k], t = (time_s - times[k]) / length_s, from = key(k), to = key(k + 1);
  if (!cubic) return path === "rotation" ? arc(from, to, t) : from.map((q, i) => (1 - t) * q + t * to[i]);
  const leaves = key(k, 2), arrives = key(k + 1, 0), t2 = t * t, t3 = t2 * t;
  return from.map((q, i) => (2 * t3 - 3 * t2 + 1) * q + length_s * (t3 - 2 * t2 + t) * leaves[i] + (3 * t2 - 2 * t3) * to[i] +
    length_s * (t3 - t2) * arrives[i]);
}

// The cofactors of a matrix over the sign of its determinant, for normals.
function turnOf(m) {
  const sign = determinant(m) < 0 ? -1 : 1, at = (column, row) => m[4 * column + row], turn = new Float64Array(9);
  for (let column = 0; column < 3; ++column)
    for (let row = 0; row < 3; ++row) {
      const c = (column + 1) % 3, d = (column + 2) % 3, r = (row + 1) % 3, s = (row + 2) % 3;
      turn[3 * column + row] = sign * (at(c, r) * at(d, s) - at(c, s) * at(d, r));
    }
  return turn;
}

// A vector by a matrix whose columns begin `stride` numbers apart, of length 1.
function putTurned(to, i, m, stride, from) {
  const x = from[i], y = from[i + 1], z = from[i + 2];
  const a = m[0] * x + m[stride] * y + m[2 * stride] * z, b = m[1] * x + m[stride + 1] * y + m[2 * stride + 1] * z;
  const c = m[2] * x + m[stride + 2] * y + m[2 * stride + 2] * z, scale = 1 / (Math.sqrt(a * a + b * b + c * c) || 1);
  to[i] = a * scale;
  to[i + 1] = b * scale;
  to[i + 2] = c * scale;
}

// A mesh of the file: what it is, and `posed`, what it is in the pose: positions, normals, tangents (their fourth number is the handedness).
class Part {
  constructor(json, node, numbers) {
    const { mesh, skin } = json.nodes[node], { primitives, weights = [], extras } = json.meshes[mesh], { attributes, targets = [] } = primitives[0];
    this.node = node;
    this.mesh = mesh;
    this.skin = skin;
    this.weights = weights;  // of the targets, as the file opens
    this.posedWeights = weights;
    this.names = extras?.targetNames ?? [];
    [this.positions, this.normals, this.tangents] = ["POSITION", "NORMAL", "TANGENT"].map(name => numbers(attributes[name]));
    this.targets = targets.map(target => ({ moves: numbers(target.POSITION), turns: numbers(target.NORMAL) }));
    this.sets = [];
    for (let i = 0; `JOINTS_${i}` in attributes; ++i)
      this.sets.push({ joints: numbers(attributes[`JOINTS_${i}`]), weights: numbers(attributes[`WEIGHTS_${i}`]) });
    this.posed = { positions: this.positions.slice(), normals: this.normals.slice(), tangents: this.tangents.slice() };
  }

  morph(weights) {
    const positions = this.positions.slice(), normals = this.normals.slice();
    this.targets.forEach(({ moves, turns }, i) => {
      if (!weights[i]) return;
      for (let k = 0; k < positions.length; ++k) {
        positions[k] += weights[i] * moves[k];
        normals[k] += weights[i] * turns[k];
      }
    });
    return { positions, normals };
  }

  // matrices: of the joints, or one of all vertices.
  pose(weights, matrices) {
    this.posedWeights = weights;
    const { positions: p, normals: n } = this.morph(weights), { posed, tangents: t } = this, skinned = this.sets.length > 0;
    let m = matrices[0], turn = turnOf(m);
    this.mirrored = determinant(m) < 0;  // its triangles show their backs
    if (skinned) m = new Float64Array(16);
    for (let v = 0, i = 0, k = 0; i < p.length; ++v, i += 3, k += 4) {
      if (skinned) {
        this.blend(matrices, v, m);
        turn = turnOf(m);
      }
      for (let row = 0; row < 3; ++row) posed.positions[i + row] = m[row] * p[i] + m[4 + row] * p[i + 1] + m[8 + row] * p[i + 2] + m[12 + row];
      putTurned(posed.normals, i, turn, 3, n);
      putTurned(posed.tangents, k, m, 4, t);
    }
  }

  blend(joints, v, sum) {
    sum.fill(0);
    for (const set of this.sets)
      for (let i = 4 * v; i < 4 * v + 4; ++i) {
        const weight = set.weights[i];
        if (weight === 0) continue;
        const m = joints[set.joints[i]];
        for (let k = 0; k < 16; ++k) sum[k] += weight * m[k];
      }
  }
}

export class SkinHeadMotion {
  // json and numbers(accessor) of readGlb().
  constructor(json, numbers) {
    this.nodes = json.nodes;
    this.roots = json.scenes[json.scene].nodes;
    this.parts = json.nodes.flatMap((node, i) => node.mesh === undefined ? [] : [new Part(json, i, numbers)]);
    this.skins = (json.skins ?? []).map(({ joints, inverseBindMatrices }) => ({ joints, binds: numbers(inverseBindMatrices) }));
    this.animations = (json.animations ?? []).map(({ name, channels, samplers }) => ({ name, channels: channels.map(({ sampler, target }) => {
      const { input, output, interpolation } = samplers[sampler], times = numbers(input), values = numbers(output);
      return { ...target, times, values, interpolation, width: values.length / times.length / (interpolation === "CUBICSPLINE" ? 3 : 1) };
    }) }));
    this.clips = this.animations.map(({ name, channels }) => ({ name, length_s: Math.max(...channels.map(({ times }) => times.at(-1))) }));
    this.pose(null, 0);
  }

  // Fills `posed` of the parts: at a time of a clip, whose end is held; without a name as the file opens.
  pose(name, time_s) {
    const changed = new Map();  // by node
    for (const channel of this.animations.find(one => one.name === name)?.channels ?? [])
      changed.set(channel.node, { ...changed.get(channel.node), [channel.path]: sample(channel, time_s) });
    const world = [];
    const visit = (i, parent) => {
      world[i] = multiply(parent, matrixOf({ ...this.nodes[i], ...changed.get(i) }));
      for (const child of this.nodes[i].children ?? []) visit(child, world[i]);
    };
    for (const root of this.roots) visit(root, identity());
    const joints = this.skins.map(skin => skin.joints.map((node, i) => multiply(world[node], skin.binds.subarray(16 * i, 16 * i + 16))));
    for (const part of this.parts)
      part.pose(changed.get(part.node)?.weights ?? part.weights, part.sets.length ? joints[part.skin] : [world[part.node]]);
  }
}
