// Opens a report in headless Chromium, moves the slider by key and by pointer, and checks that the pixels follow.
//
//     node page.mjs CHROMIUM REPORT.html [SCREENSHOT.png]

import { writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { openBrowser } from "./browser.mjs";

const [chromium, report, screenshot] = process.argv.slice(2);
const page = await openBrowser(chromium, { width: 1300, height: 1000 });
const { call, evaluate } = page;
const finish = async message => {
  await page.close();
  if (message) console.error(message);
  process.exit(message ? 1 : 0);
};
const check = async (good, message) => { if (!good) await finish(message); };
await page.load("file://" + resolve(report));

const box = await evaluate("(() => { const b = document.getElementById('stage').getBoundingClientRect(); return { x: b.x, y: b.y, width: b.width, height: b.height }; })()");
const stage = async () => (await call("Page.captureScreenshot", { format: "png", clip: { ...box, scale: 1 } })).data;
// The share of pixels that clearly differ between two screenshots, within columns from..to (of the width).
const differing = (a, b, from = 0, to = 1) => evaluate(`(async () => {
  const pixels = async data => {
    const image = new Image();
    image.src = "data:image/png;base64," + data;
    await image.decode();
    const canvas = document.createElement("canvas");
    canvas.width = image.width;
    canvas.height = image.height;
    const context = canvas.getContext("2d");
    context.drawImage(image, 0, 0);
    const x = Math.round(image.width * ${from});
    return context.getImageData(x, 0, Math.round(image.width * ${to}) - x, image.height).data;
  };
  const one = await pixels("${a}"), other = await pixels("${b}");
  let count = 0;
  for (let i = 0; i < one.length; i += 4)
    count += Math.max(...[0, 1, 2].map(c => Math.abs(one[i + c] - other[i + c]))) > 12;
  return count / (one.length / 4);
})()`);
const key = async (name, code, text) => {
  for (const type of ["keyDown", "keyUp"])
    await call("Input.dispatchKeyEvent", { type, key: name, code: text ? "Digit" + name : name, windowsVirtualKeyCode: code, text: type === "keyDown" ? text : undefined });
};

await check(await evaluate("document.querySelectorAll('tbody tr').length") > 0, "the table of scores is empty");
await check(await evaluate("[...document.images].every(i => i.complete && i.naturalWidth > 0)"), "a picture does not decode");
if (screenshot) writeFileSync(screenshot, Buffer.from((await call("Page.captureScreenshot", { format: "png", captureBeyondViewport: true })).data, "base64"));
// A picture and an error map, which differ nearly everywhere. The line and the labels move by themselves: what is
// checked is the picture under them.
const choose = (side, index) => evaluate(
  `{ const s = document.getElementById("choose-${side}"); s.value = ${index}; s.dispatchEvent(new Event("input")); }`);
const names = await evaluate("document.getElementById('choose-left').options.length");
await check(names >= 4, "there are not enough pictures to choose from");
await choose("right", names - 1);
await evaluate("for (const id of ['bar', 'tag-left', 'tag-right']) document.getElementById(id).style.visibility = 'hidden'");
const middle = await stage();

await evaluate("document.getElementById('wipe').focus()");
await key("End", 35);
await check(await evaluate("document.getElementById('wipe').value") === "1000", "the End key does not move the slider to its end");
const left = await stage();
await key("Home", 36);
const right = await stage();
const shares = [await differing(left, right), await differing(middle, left, 0, 0.48), await differing(middle, right, 0.52, 1),
  await differing(middle, left, 0.52, 1)];
await check(shares[0] > 0.2 && shares[1] < 0.02 && shares[2] < 0.02 && shares[3] > 0.1,
  "the picture does not follow the slider: " + shares.map(s => s.toFixed(3)).join(" "));
for (let i = 0; i < 5; ++i) await key("ArrowRight", 39);
await check(Number(await evaluate("document.getElementById('wipe').value")) >= 5, "the arrow keys do not move the slider");

const pointer = (type, x, buttons) => call("Input.dispatchMouseEvent", { type, x, y: box.y + box.height / 2, button: "left", buttons, clickCount: 1 });
await pointer("mousePressed", box.x + box.width * 0.1, 1);
await pointer("mouseMoved", box.x + box.width * 0.75, 1);
await pointer("mouseReleased", box.x + box.width * 0.75, 0);
const dragged = Number(await evaluate("document.getElementById('wipe').value"));
await check(Math.abs(dragged - 750) < 20, `dragging to three quarters leaves the slider at ${dragged} of 1000`);

// Any two pictures: an error map on the left, and by its number key another picture on the right.
await choose("left", names - 1);
await evaluate("document.activeElement.blur()");
await key("2", 50, "2");
await check(await evaluate("document.getElementById('choose-right').value") === "1", "the number keys do not choose");
await evaluate("document.getElementById('wipe').focus()");
await key("End", 35);
await check(await differing(await stage(), right) < 0.02,
  "the right picture cannot be shown on the left");

// Two clicks, as the table may have been in the first one's order already.
const sorted = async () => {
  await evaluate("document.querySelector('th button[data-key=rmse]').click()");
  return evaluate("document.querySelector('tbody').innerText");
};
await check(await sorted() !== await sorted(), "a click on a heading does not sort");
const foreign = page.requests.filter(url => !url.startsWith("file:") && !url.startsWith("data:"));
await check(foreign.length === 0, "the page asks for " + foreign[0]);
await check(page.problems.length === 0, page.problems[0]);
await finish();
