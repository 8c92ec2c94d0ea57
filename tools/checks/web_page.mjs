// Opens the page of `dermis export --web` in headless Chromium.
//
//     node web_page.mjs CHROMIUM drive FOLDER              moves every control and checks that the pixels follow
//     node web_page.mjs CHROMIUM clips FOLDER              plays the first clip, pauses it, moves its time
//     node web_page.mjs CHROMIUM shot FOLDER SIDE PICTURE[?QUERY]...
//                                                          pictures alone, without controls, as PNG; QUERY: clip=NAME&time=SECONDS
//     node web_page.mjs CHROMIUM load FOLDER               prints when the first picture was there, at 1280 x 800

import { writeFileSync } from "node:fs";
import { openBrowser, serve, until } from "./browser.mjs";

const [chromium, mode, folder, side, ...pictures] = process.argv.slice(2);
const kDrawn = "document.body.dataset.state === 'drawn'", kEnded = "['drawn', 'error'].includes(document.body?.dataset.state)";

const visit = async (page, server, query) => {
  await page.load(`${server.origin}/${query}`);
  await until(page, kEnded, "the first picture");
};
const open = async (server, size, query = "", prepare = "") => {
  const page = await openBrowser(chromium, size);
  if (prepare) await page.call("Page.addScriptToEvaluateOnNewDocument", { source: prepare });
  await visit(page, server, query);
  return page;
};
const check = (good, message) => { if (!good) throw new Error(message); };

// What a user does to a control; the picture is drawn anew before this returns.
const change = async (page, script) => {
  await page.evaluate("document.body.dataset.state = ''");
  await page.evaluate(script);
  await until(page, kDrawn, `a picture after ${script}`);
};
const slide = (page, id, value) => change(page,
  `{ const c = document.getElementById("${id}"); c.value = ${value}; c.dispatchEvent(new Event("input")); }`);
const press = (page, selector) => change(page, `document.querySelector(${JSON.stringify(selector)}).click()`);

// The canvas without what lies over it.
const picture = async page => {
  await page.evaluate("document.getElementById('divider').style.visibility = 'hidden'");
  const box = await page.evaluate("(() => { const b = document.getElementById('picture').getBoundingClientRect(); return { x: b.x, y: b.y, width: b.width, height: b.height }; })()");
  return (await page.call("Page.captureScreenshot", { format: "png", clip: { ...box, scale: 1 } })).data;
};
// Decodes pictures in the page; `measure` is a function of their pixels' arrays, width and height.
const measured = (page, pictures, measure) => page.evaluate(`(async () => {
  const all = [];
  let canvas;
  for (const data of ${JSON.stringify(pictures)}) {
    const image = new Image();
    image.src = "data:image/png;base64," + data;
    await image.decode();
    canvas = new OffscreenCanvas(image.width, image.height);
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    all.push(context.getImageData(0, 0, image.width, image.height).data);
  }
  return (${measure})(all, canvas.width, canvas.height);
})()`);
// The share of pixels that clearly differ within columns from..to (of the width).
const differing = (page, a, b, from = 0, to = 1) => measured(page, [a, b], `([a, b], width, height) => {
  let count = 0, all = 0;
  for (let y = 0; y < height; ++y)
    for (let x = Math.round(width * ${from}); x < Math.round(width * ${to}); ++x, ++all)
      count += [0, 1, 2].some(c => Math.abs(a[4 * (y * width + x) + c] - b[4 * (y * width + x) + c]) > 3);
  return count / all;
}`);
const brightness = (page, picture) => measured(page, [picture], "([a]) => { let sum = 0; for (const v of a) sum += v; return sum / a.length; }");

async function drive(server) {
  const page = await open(server, { width: 900, height: 500 });
  try {
    check(await page.evaluate(kDrawn), await page.evaluate("document.getElementById('message').textContent"));
    await slide(page, "wipe", 100);
    const lambert = await picture(page);
    await slide(page, "wipe", 0);
    const scattered = await picture(page);
    await slide(page, "wipe", 50);
    const both = await picture(page);
    const shares = [await differing(page, lambert, scattered), await differing(page, both, lambert, 0, 0.49),
      await differing(page, both, scattered, 0.51, 1), await differing(page, both, scattered, 0, 0.49)];
    check(shares[0] > 0.002 && shares[1] === 0 && shares[2] === 0 && shares[3] > 0.001,
      "the picture does not follow the wipe: " + shares.map(s => s.toFixed(4)).join(" "));

    await press(page, "#tones label:last-child input");
    check(await brightness(page, await picture(page)) < await brightness(page, both) - 3, "the darkest tone is not darker");
    await press(page, "#tones label:first-child input");
    check(await differing(page, await picture(page), both) === 0, "the first tone does not come back");

    await slide(page, "yaw", 60);
    const turned = await picture(page);
    check(await differing(page, turned, both) > 0.05, "the picture does not follow the light");
    await press(page, "#reset");
    check(await differing(page, await picture(page), both) < 0.01, "the start view does not come back");

    await press(page, "[name=show][value='1']");
    check(await differing(page, await picture(page), both) > 0.05, "curvature is not shown");
    await press(page, "[name=show][value='0']");
    await change(page, `for (const [type, x] of [["pointerdown", 100], ["pointermove", 220], ["pointerup", 220]])
      { const c = document.getElementById("picture"); c.setPointerCapture = () => {};
        c.dispatchEvent(new PointerEvent(type, { pointerId: 7, clientX: x, clientY: 100, buttons: 1 })); }`);
    check(await differing(page, await picture(page), both) > 0.02, "dragging does not turn the picture");
    const dragged = await picture(page);
    await change(page, `document.getElementById("picture").dispatchEvent(new KeyboardEvent("keydown", { key: "ArrowRight" }))`);
    check(await differing(page, await picture(page), dragged) > 0.01, "arrow keys do not turn the picture");
    const foreign = page.requests.filter(url => !url.startsWith(server.origin) && !/^(data|blob):/.test(url));
    check(foreign.length === 0, "the page asks for " + foreign[0]);
    check(page.problems.length === 0, "the console says: " + page.problems[0]);
  } finally {
    await page.close();
  }
}

// The clip's list, play and pause, and the time.
async function playClips(server) {
  const page = await open(server, { width: 900, height: 500 });
  const time = () => page.evaluate("Number(document.querySelector('#clips input').value)");
  try {
    check(await page.evaluate(kDrawn), await page.evaluate("document.getElementById('message').textContent"));
    await slide(page, "wipe", 0);
    const rest = await picture(page);
    await change(page, `{ const list = document.querySelector("#clips select"); list.selectedIndex = 1; list.dispatchEvent(new Event("change")); }`);
    await until(page, "Number(document.querySelector('#clips input').value) > 0.1", "the clip's time going on");
    await press(page, "#clips button");
    const paused = await time();
    await new Promise(resolve => setTimeout(resolve, 300));
    check(await time() === paused, "the clip goes on after pause");
    const end = await page.evaluate("Number(document.querySelector('#clips input').max)");
    const show = time_s => change(page, `{ const c = document.querySelector("#clips input"); c.value = ${time_s}; c.dispatchEvent(new Event("input")); }`);
    await show(0.8 * end);
    const moved = await picture(page);
    check(await differing(page, moved, rest) > 0.005, "the picture does not follow the clip");
    await show(0.4 * end);
    check(await differing(page, await picture(page), moved) > 0.005, "the picture does not follow the clip's time");
    await show(0.8 * end);
    check(await differing(page, await picture(page), moved) === 0, "the same time is another picture");
    await change(page, `{ const list = document.querySelector("#clips select"); list.selectedIndex = 0; list.dispatchEvent(new Event("change")); }`);
    check(await differing(page, await picture(page), rest) === 0, "the pose of the export does not come back");
    check(page.problems.length === 0, "the console says: " + page.problems[0]);
  } finally {
    await page.close();
  }
}

// Controls that a thumb can use, and nothing wider than the screen.
async function checkPhone(server) {
  const page = await open(server, { width: 390, height: 844, phone: true });
  try {
    const small = await page.evaluate(`[...document.querySelectorAll("#controls input, #controls button")].filter(c => {
      const b = c.getBoundingClientRect();
      return b.width > 0 && (b.height < 40 || b.width < 40);
    }).map(c => c.id || c.name)`);
    check(small.length === 0, "too small on a phone: " + small.join(", "));
    const fine = await page.evaluate(`[...document.querySelectorAll("body *")].filter(e => e.offsetParent && parseFloat(getComputedStyle(e).fontSize) < 12 &&
      [...e.childNodes].some(n => n.nodeType === Node.TEXT_NODE && n.data.trim())).map(e => e.textContent)`);
    check(fine.length === 0, "text under 12 px on a phone: " + fine.join(", "));
    check(await page.evaluate("document.documentElement.scrollWidth") <= 390, "the page is wider than a phone");
  } finally {
    await page.close();
  }
}

// What is missing is said in words.
async function checkMessages(server) {
  const size = { width: 320, height: 240 };
  for (const [prepare, words] of [
    ["HTMLCanvasElement.prototype.getContext = () => null;", "WebGL 2"],
    ["const get = window.fetch; window.fetch = path => get(path === 'scene.bin' ? 'no.bin' : path);", "scene.bin is missing"]]) {
    const page = await open(server, size, "", prepare);
    try {
      const said = await page.evaluate("document.getElementById('message').textContent");
      check(said.includes(words), `the page says "${said}" instead of something with ${words}`);
    } finally {
      await page.close();
    }
  }
}

// All pictures by one browser: it takes seconds to start.
async function shoot(server) {
  const page = await openBrowser(chromium, { width: Number(side), height: Number(side) });
  try {
    for (const picture of pictures) {
      const [output, query = ""] = picture.split("?");
      await visit(page, server, `?controls=0&${query}`);
      check(await page.evaluate(kDrawn), await page.evaluate("document.getElementById('message').textContent"));
      writeFileSync(output, Buffer.from((await page.call("Page.captureScreenshot", { format: "png" })).data, "base64"));
    }
  } finally {
    await page.close();
  }
}

// From the navigation to the first picture, with an empty cache.
async function load(server) {
  const page = await open(server, { width: 1280, height: 800 }, "",
    "new MutationObserver((_, seen) => { if (document.body?.dataset.state === 'drawn') { window.drawnMs ??= performance.now(); seen.disconnect(); } })" +
    ".observe(document, { subtree: true, childList: true, attributes: true });");
  try {
    const [ms, bytes] = await page.evaluate("[window.drawnMs, performance.getEntriesByType('resource').reduce((sum, r) => sum + r.encodedBodySize, 0)]");
    console.log(`first picture after ${(ms / 1000).toFixed(1)} s, ${(bytes / 1e6).toFixed(1)} MB`);
  } finally {
    await page.close();
  }
}

const server = await serve(folder);
try {
  if (mode === "shot") await shoot(server);
  else if (mode === "load") await load(server);
  else if (mode === "clips") await playClips(server);
  else {
    await drive(server);
    await checkPhone(server);
    await checkMessages(server);
  }
} catch (error) {
  console.error(error.message);
  process.exitCode = 1;
}
server.close();
