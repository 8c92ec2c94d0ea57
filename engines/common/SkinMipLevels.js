// Mip levels of maps that hold directions, each filtered from the unrounded one before it. A device that draws levels from each other rounds
// to 8 bits every time, and halves upwards: by an eighth of 1/255 a level. All normals of a normal map then lean to one side; in a picture
// of a head of 48 x 48 pixels this changes the light by a seventh of what scattering does.

// The shares of texels 2 * place and following in a texel of the next level, whose sides are half, rounded down.
function sharesOf(size, place) {
  if (size === 1) return [1];
  const half = size >> 1;
  return size === 2 * half ? [0.5, 0.5] : [half - place, half, place + 1].map(share => share / size);
}

function halved({ data, width, height }) {
  const wide = Math.max(width >> 1, 1), high = Math.max(height >> 1, 1), halves = new Float32Array(4 * wide * high);
  const columns = Array.from({ length: wide }, (_, x) => sharesOf(width, x));
  for (let y = 0; y < high; ++y)
    sharesOf(height, y).forEach((share, j) => {
      for (let x = 0, to = 4 * y * wide; x < wide; ++x, to += 4) {
        const column = columns[x];
        for (let k = 0, from = 4 * ((2 * y + j) * width + 2 * x); k < column.length; ++k, from += 4)
          for (let c = 0; c < 4; ++c) halves[to + c] += share * column[k] * data[from + c];
      }
    });
  return { data: halves, width: wide, height: high };
}

// Of a picture that a canvas can draw: { data, width, height }, RGBA in bytes.
export function texelsOf(picture) {
  const { width, height } = picture, context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  context.drawImage(picture, 0, 0);
  return { data: new Uint8Array(context.getImageData(0, 0, width, height).data.buffer), width, height };
}

// Unrounded, down to 1 x 1.
function levelsOf(texels) {
  const levels = [texels];
  for (let level = texels; level.width > 1 || level.height > 1; levels.push(level)) level = halved(level);
  return levels;
}

// [{ data, width, height }], the picture first, in bytes.
export const mipLevels = picture => levelsOf(texelsOf(picture)).map(level => ({ ...level, data: Uint8Array.from(level.data, Math.round) }));

// The same of 16 bits, of which the high bytes are above the low ones: floats, 0 to 1.
export function fineMipLevels(picture) {
  const { data, width, height } = texelsOf(picture), count = data.length / 2;
  return levelsOf({ data: Float32Array.from({ length: count }, (_, i) => (256 * data[i] + data[count + i]) / 65535), width, height: height / 2 });
}

// A promise of a picture with the texels that are stored in a blob: no colour management.
export const pictureOf = blob => createImageBitmap(blob, { colorSpaceConversion: "none", premultiplyAlpha: "none" });
