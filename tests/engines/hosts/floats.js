// What tools/checks/host_floats.mjs takes from a page: means over squares of pixels, as text.

// Of `floats`, RGBA of a square of side * points pixels; rows from the bottom or from the top.
function means(floats, { side, points, fromBottom }) {
  const wide = side * points, picture = new Float32Array(side * side * 3), share = 1 / (points * points);
  for (let y = 0; y < wide; ++y)
    for (let x = 0; x < wide; ++x)
      for (let c = 0; c < 3; ++c)
        picture[3 * (Math.floor(y / points) * side + Math.floor(x / points)) + c] +=
          share * floats[4 * ((fromBottom ? wide - 1 - y : y) * wide + x) + c];
  return picture;
}

function base64(floats) {
  const bytes = new Uint8Array(floats.buffer);
  let text = "";
  for (let i = 0; i < bytes.length; i += 4096) text += String.fromCharCode(...bytes.subarray(i, i + 4096));
  return btoa(text);
}

export function showFloats(floats, size) {
  window.picture = { width: size.side, height: size.side, base64: base64(means(floats, size)) };
  document.body.dataset.state = "drawn";
}
