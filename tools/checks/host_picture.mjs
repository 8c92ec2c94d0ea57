// Pictures of pages that use the packages of `dermis export --engine three|babylon`, in headless Chromium: one browser for all.
//
//     node host_picture.mjs CHROMIUM FOLDER SIDE PAGE OUTPUT.png [PAGE OUTPUT.png ...]
//
// FOLDER has packages with node_modules beside their modules; a PAGE is a path in it with a query. Prints an array in JSON with
// what each page says: { said: [messages and the console's], picture: whether there is one }. Exit status: 0, 1 where the browser does
// not answer, 3 where it has not the WebGPU that a page asks for.

import { writeFileSync } from "node:fs";
import { openBrowser, serve, until } from "./browser.mjs";

const [chromium, folder, side, ...jobs] = process.argv.slice(2);
// Without these a canvas of WebGPU loses its device when it is shown.
const kFlags = ["--enable-features=Vulkan", "--use-vulkan=swiftshader"];

const kMaxCharacters = 600;  // of a message: engines print whole shaders

async function draw(page, origin, path, output) {
  const result = { said: [], picture: false };
  page.requests.length = page.problems.length = 0;
  try {
    await page.load(`${origin}/${path}`);
    const message = "document.getElementById('message').textContent";
    await until(page, `document.body.dataset.state === "drawn" || ${message} !== ""`, "a picture", 30);
    await page.evaluate("new Promise(done => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done)), 200))");
    writeFileSync(output, Buffer.from((await page.call("Page.captureScreenshot", { format: "png" })).data, "base64"));
    result.picture = true;
    result.said.push(await page.evaluate(message));
  } catch (error) {
    result.said.push(error.message);
  }
  const foreign = page.requests.filter(url => !url.startsWith(origin) && !/^(data|blob):/.test(url));
  result.said.push(...page.problems, ...foreign.map(url => `the page asks for ${url}`));
  result.said = result.said.filter(said => said).map(said => said.slice(0, kMaxCharacters));
  return result;
}

const server = await serve(folder);
const page = await openBrowser(chromium, { width: Number(side), height: Number(side), flags: kFlags });
const asksForWebGpu = jobs.some(job => job.includes("webgpu"));
await page.load(`${server.origin}/${jobs[0]}`);  // navigator.gpu is there in pages of a server only
const hasWebGpu = await page.evaluate("Promise.resolve(navigator.gpu?.requestAdapter()).then(Boolean)");
if (asksForWebGpu && !hasWebGpu) {
  process.exitCode = 3;
} else {
  const results = [];
  for (let i = 0; i < jobs.length; i += 2) results.push(await draw(page, server.origin, jobs[i], jobs[i + 1]));
  console.log(JSON.stringify(results));
}
await page.close();
server.close();
