// Runs a page's `result` promise in headless Chromium and writes the bytes that it gives, base64, to a file.
//
//     node evaluate_page.mjs CHROMIUM PAGE.html OUTPUT
//
// Speaks the DevTools protocol over the browser's pipe (--remote-debugging-pipe), so that it needs no package.

import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";

const [chromium, page, output] = process.argv.slice(2);
const profile = mkdtempSync(join(tmpdir(), "dermis-page-"));
const browser = spawn(chromium, ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run",
  "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader",
  `--user-data-dir=${profile}`, "--remote-debugging-pipe"], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
const gone = new Promise(done => browser.on("exit", done));
const finish = async (message, code = 1) => {
  browser.kill();
  await gone;
  rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
  if (message) console.error(message);
  process.exit(message ? code : 0);
};
setTimeout(() => finish("the browser did not answer within two minutes"), 120000);

// Messages are JSON, each ended by a zero byte.
let next = 1, rest = "";
const waiting = new Map();
let loaded;
const load = new Promise(done => { loaded = done; });
browser.stdio[4].on("data", chunk => {
  const parts = (rest + chunk).split("\0");
  rest = parts.pop();
  for (const part of parts) {
    const message = JSON.parse(part);
    if (message.method === "Page.loadEventFired") loaded();
    const answer = waiting.get(message.id);
    if (!answer) continue;
    waiting.delete(message.id);
    message.error ? finish(message.error.message) : answer(message.result);
  }
});
const send = (method, params = {}, sessionId) => new Promise(done => {
  waiting.set(next, done);
  browser.stdio[3].write(JSON.stringify({ id: next++, method, params, sessionId }) + "\0");
});

const { targetId } = await send("Target.createTarget", { url: "about:blank" });
const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
const call = (method, params) => send(method, params, sessionId);
await call("Page.enable");
await call("Page.navigate", { url: "file://" + resolve(page) });
await load;
const { result, exceptionDetails } = await call("Runtime.evaluate", { expression: "run()", returnByValue: true, awaitPromise: true });
// 3: this browser has not what the page needs.
if (exceptionDetails) await finish(exceptionDetails.exception?.description ?? exceptionDetails.text, 1);
if (!result.value.data) await finish(result.value.missing ?? "no result", 3);
writeFileSync(output, Buffer.from(result.value.data, "base64"));
await finish();
