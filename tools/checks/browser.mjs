// Headless Chromium over the DevTools protocol through the browser's pipe (--remote-debugging-pipe), and a server of one
// folder: what the checks of pages share. Needs no package.

import { spawn } from "node:child_process";
import { createServer } from "node:http";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";

const kTypes = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json", ".jpg": "image/jpeg" };

// Serves `folder` on a free port of this machine.
export function serve(folder) {
  const server = createServer((request, answer) => {
    const path = normalize(decodeURIComponent(new URL(request.url, "http://localhost").pathname)).replace(/\/$/, "/index.html");
    try {
      const bytes = readFileSync(join(folder, path));
      answer.writeHead(200, { "Content-Type": kTypes[extname(path)] ?? "application/octet-stream" });
      answer.end(bytes);
    } catch {
      answer.writeHead(404);
      answer.end();
    }
  });
  return new Promise(done => server.listen(0, "127.0.0.1", () =>
    done({ origin: `http://127.0.0.1:${server.address().port}`, close: () => { server.close(); server.closeAllConnections(); } })));
}

// { call(method, params), load(url), evaluate(expression), requests, problems, close() }; it ends two minutes after the last load.
// `flags` are further ones of Chromium's.
export async function openBrowser(chromium, { width, height, phone = false, flags = [] }) {
  const profile = mkdtempSync(join(tmpdir(), "dermis-page-"));
  const browser = spawn(chromium, ["--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--no-first-run",
    "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--enable-unsafe-webgpu", "--use-webgpu-adapter=swiftshader",
    `--user-data-dir=${profile}`, "--remote-debugging-pipe", ...flags], { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  const gone = new Promise(done => browser.on("exit", done));
  const late = setTimeout(() => {
    console.error("the browser did not answer within two minutes");
    browser.kill();
    process.exit(1);
  }, 120000);
  let next = 1, rest = "";
  let loaded;
  const waiting = new Map(), requests = [], problems = [];
  // Messages are JSON, each ended by a zero byte.
  browser.stdio[4].on("data", chunk => {
    const parts = (rest + chunk).split("\0");
    rest = parts.pop();
    for (const part of parts) {
      const { id, result, error, method, params } = JSON.parse(part);
      if (method === "Network.requestWillBeSent") requests.push(params.request.url);
      if (method === "Runtime.exceptionThrown") problems.push(params.exceptionDetails.exception?.description ?? "an exception");
      if (method === "Runtime.consoleAPICalled" && ["error", "warning"].includes(params.type))
        problems.push(params.args.map(arg => arg.value ?? arg.description).join(" "));
      if (method === "Log.entryAdded" && params.entry.level === "error") problems.push(`${params.entry.text} ${params.entry.url ?? ""}`);
      if (method === "Page.loadEventFired") loaded?.();
      const answer = waiting.get(id);
      waiting.delete(id);
      answer?.(error ? Promise.reject(new Error(error.message)) : result);
    }
  });
  const send = (method, params = {}, sessionId) => new Promise(done => {
    waiting.set(next, done);
    browser.stdio[3].write(JSON.stringify({ id: next++, method, params, sessionId }) + "\0");
  });
  const { targetId } = await send("Target.createTarget", { url: "about:blank" });
  const { sessionId } = await send("Target.attachToTarget", { targetId, flatten: true });
  const call = (method, params) => send(method, params, sessionId);
  for (const part of ["Page", "Runtime", "Network", "Log"]) await call(part + ".enable");
  await call("Emulation.setDeviceMetricsOverride", { width, height, deviceScaleFactor: 1, mobile: phone });
  const evaluate = async expression => {
    const { result, exceptionDetails } = await call("Runtime.evaluate", { expression, returnByValue: true, awaitPromise: true });
    if (exceptionDetails) throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    return result.value;
  };
  const load = async url => {
    late.refresh();
    const fired = new Promise(done => { loaded = done; });
    await call("Page.navigate", { url });
    await fired;
  };
  const close = async () => {
    send("Browser.close");  // it ends its own processes, which still write into the profile
    await gone;
    clearTimeout(late);
    rmSync(profile, { recursive: true, force: true, maxRetries: 20, retryDelay: 200 });
  };
  return { call, load, evaluate, requests, problems, close };
}

// Waits until `expression` is true in the page.
export async function until(page, expression, what, seconds = 60) {
  for (let i = 0; i < seconds * 10; ++i) {
    if (await page.evaluate(expression)) return;
    await new Promise(done => setTimeout(done, 100));
  }
  throw new Error(`${what}: not within ${seconds} s`);
}
