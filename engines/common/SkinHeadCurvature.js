// The mean curvature of a head's vertices as its morph targets move them: what a target of weight 1 adds is known (N_curvature.png), and
// counts as often as its weight. In a fold, whose walls come close, the sum would be too much: it is limited.

const kNone = 128, kSteps = 127;  // a value of the picture that changes nothing; steps of the largest change

// The changes that `picture` ({ data, width }, RGBA in bytes) has of a mesh's targets, by their names, in steps: of each target an array with
// one number a vertex, null where it changes nothing. settings: curvature_of_targets of scene.json; numbers: of the vertices in the picture.
export function changesIn({ data, width }, settings, names, numbers) {
  return Array.from(names, name => {
    const target = settings.targets.indexOf(name), first = target * settings.rows * width;
    return target < 0 ? null : Int8Array.from(numbers, v => data[4 * (first + v)] - kNone);
  });
}

export class SkinHeadCurvature {
  // weights: of the targets as the head opens, for which its curvature is.
  constructor(changes, mostPerMm, weights) {
    Object.assign(this, { changes, mostPerMm, opened: Array.from(weights), weights: Array.from(weights) });
    this.perMm = new Float32Array(changes.find(one => one)?.length ?? 0);
  }

  // Fills perMm, what the weights add to the mean curvature of each vertex. False where they are those of the last call.
  follow(weights) {
    if (this.weights.every((weight, i) => weight === weights[i])) return false;
    this.weights = Array.from(weights);
    const { perMm, mostPerMm } = this;
    perMm.fill(0);
    this.changes.forEach((change, i) => {
      const perStep = (weights[i] - this.opened[i]) * mostPerMm / kSteps;
      if (change && perStep !== 0) for (let v = 0; v < perMm.length; ++v) perMm[v] += perStep * change[v];
    });
    for (let v = 0; v < perMm.length; ++v) perMm[v] = Math.min(Math.max(perMm[v], -mostPerMm), mostPerMm);
    return true;
  }
}
