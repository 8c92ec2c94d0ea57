// Vectors are arrays of three; matrices arrays of sixteen, column after column, for WebGL's clip space.

export const add = (a, b) => a.map((x, i) => x + b[i]);
export const subtract = (a, b) => a.map((x, i) => x - b[i]);
export const scale = (a, s) => a.map(x => x * s);
export const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
export const cross = (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
export const length = a => Math.sqrt(dot(a, a));
export const normalize = a => scale(a, 1 / length(a));

// Yaw 0, pitch 0 is +z; yaw turns towards +x, pitch towards +y.
export const direction = (yaw, pitch) =>
  [Math.sin(yaw) * Math.cos(pitch), Math.sin(pitch), Math.cos(yaw) * Math.cos(pitch)];
export const yawPitch = d => [Math.atan2(d[0], d[2]), Math.asin(Math.max(-1, Math.min(1, d[1] / length(d))))];

export function multiply(a, b) {
  const m = new Array(16).fill(0);
  for (let c = 0; c < 4; ++c)
    for (let r = 0; r < 4; ++r)
      for (let k = 0; k < 4; ++k) m[4 * c + r] += a[4 * k + r] * b[4 * c + k];
  return m;
}

// The view along `forward`, a unit vector.
export function lookAlong(eye, forward) {
  const up = Math.abs(forward[1]) < 0.99 ? [0, 1, 0] : [0, 0, 1];
  const x = normalize(cross(forward, up)), y = cross(x, forward), z = scale(forward, -1);
  return [x[0], y[0], z[0], 0, x[1], y[1], z[1], 0, x[2], y[2], z[2], 0, -dot(x, eye), -dot(y, eye), -dot(z, eye), 1];
}

export function perspective(verticalFov, aspect, near, far) {
  const f = 1 / Math.tan(verticalFov / 2), d = near - far;
  return [f / aspect, 0, 0, 0, 0, f, 0, 0, 0, 0, (far + near) / d, -1, 0, 0, 2 * far * near / d, 0];
}

export function orthographic(half, near, far) {
  const d = near - far;
  return [1 / half, 0, 0, 0, 0, 1 / half, 0, 0, 0, 0, 2 / d, 0, 0, 0, (far + near) / d, 1];
}
