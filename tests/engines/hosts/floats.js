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

// Clips and times that a page draws: ?clip=NAME&time=SECONDS, with &rest also the head without a clip before it.
export function momentsOf(query) {
  const moment = { clip: query.get("clip"), time_s: Number(query.get("time")) };
  return query.has("rest") ? [{ clip: null, time_s: 0 }, moment] : [moment];
}

// What a page draws of each moment: skin, lambert, gain or a mistake; ?looks=skin,lambert draws both. The mistakes srgb, levels and frames
// stay: each is a page's last look.
export const looksOf = query =>
  query.get("looks")?.split(",") ?? [["lambert", "gain"].find(name => query.has(name)) ?? query.get("mistake") ?? "skin"];

// Squares of floats, one below the other.
export function showFloats(squares, size) {
  const picture = new Float32Array(squares.length * size.side * size.side * 3);
  squares.forEach((floats, i) => picture.set(means(floats, size), i * size.side * size.side * 3));
  window.picture = { width: size.side, height: squares.length * size.side, base64: base64(picture) };
  document.body.dataset.state = "drawn";
}
