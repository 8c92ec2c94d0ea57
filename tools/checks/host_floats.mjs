// Linear pictures of a head's page in headless Chromium, as EXR: what `dermis compare --picture` takes.
//
//     node host_floats.mjs CHROMIUM FOLDER PAGE OUTPUT.exr [PAGE OUTPUT.exr ...]
//
// FOLDER has packages with node_modules beside their modules; a PAGE is a path in it with a query. The page sets
// document.body.dataset.state to "drawn" and window.picture to { width, height, base64 } of RGB floats, rows from the top, or
// writes what is wrong into its message. Exit status: 0, 1 with a line for each page that has no picture.

import { writeFileSync } from "node:fs";
import { openBrowser, serve, until } from "./browser.mjs";

const [chromium, folder, ...jobs] = process.argv.slice(2);

// OpenEXR, scan lines of floats, not compressed: "Technical Introduction to OpenEXR", "File Layout".
function exr({ width, height, base64 }) {
  const floats = Buffer.from(base64, "base64"), parts = [];
  const u32 = value => { const bytes = Buffer.alloc(4); bytes.writeInt32LE(value); return bytes; };
  const attribute = (name, type, value) => parts.push(Buffer.from(`${name}\0${type}\0`), u32(value.length), value);
  const box = Buffer.concat([0, 0, width - 1, height - 1].map(u32)), one = Buffer.alloc(4), kFloat = 2;
  one.writeFloatLE(1);
  parts.push(u32(20000630), u32(2));
  attribute("channels", "chlist", Buffer.concat([..."BGR"].map(name =>
    Buffer.concat([Buffer.from(`${name}\0`), u32(kFloat), u32(0), u32(1), u32(1)])).concat(Buffer.alloc(1))));
  attribute("compression", "compression", Buffer.alloc(1));
  attribute("dataWindow", "box2i", box);
  attribute("displayWindow", "box2i", box);
  attribute("lineOrder", "lineOrder", Buffer.alloc(1));
  attribute("pixelAspectRatio", "float", one);
  attribute("screenWindowCenter", "v2f", Buffer.alloc(8));
  attribute("screenWindowWidth", "float", one);
  parts.push(Buffer.alloc(1));
  const start = Buffer.concat(parts), lineBytes = 8 + 12 * width, offsets = [], lines = [];
  for (let y = 0; y < height; ++y) {
    const offset = Buffer.alloc(8), line = Buffer.alloc(12 * width);
    offset.writeBigInt64LE(BigInt(start.length + 8 * height + y * lineBytes));
    offsets.push(offset);
    for (let c = 0; c < 3; ++c)
      for (let x = 0; x < width; ++x) floats.copy(line, 4 * (c * width + x), 4 * (3 * (y * width + x) + 2 - c), 4 * (3 * (y * width + x) + 3 - c));
    lines.push(u32(y), u32(12 * width), line);
  }
  return Buffer.concat([start, ...offsets, ...lines]);
}

const server = await serve(folder);
const page = await openBrowser(chromium, { width: 64, height: 64, flags: ["--enable-features=Vulkan", "--use-vulkan=swiftshader"] });
for (let i = 0; i < jobs.length; i += 2) {
  page.problems.length = 0;
  try {
    await page.load(`${server.origin}/${jobs[i]}`);
    const message = "document.getElementById('message').textContent";
    await until(page, `document.body.dataset.state === "drawn" || ${message} !== ""`, "a picture", 100);
    const said = await page.evaluate(message);
    if (said) throw new Error(said);
    writeFileSync(jobs[i + 1], exr(await page.evaluate("window.picture")));
    if (page.problems.length) throw new Error(page.problems[0].slice(0, 600));
  } catch (error) {
    console.error(`${jobs[i]}: ${error.message} ${page.problems.join(" ").slice(0, 600)}`);
    process.exitCode = 1;
  }
}
await page.close();
server.close();
