// The picture of an engine's example, as `dermis export --engine three|babylon` writes it, in headless Chromium.
//
//     node host_picture.mjs CHROMIUM FOLDER PAGE OUTPUT.png SIDE
//
// FOLDER has the package with node_modules beside it; PAGE is example/index.html with its query. Prints what the console says,
// a line each. Exit status: 0 a picture, 1 none, 3 the browser has not what the page asks for.

import { writeFileSync } from "node:fs";
import { openBrowser, serve, until } from "./browser.mjs";

const [chromium, folder, path, output, side] = process.argv.slice(2);
// Without these a canvas of WebGPU loses its device when it is shown.
const kFlags = ["--enable-features=Vulkan", "--use-vulkan=swiftshader"];

const kMaxCharacters = 600;  // of a message: engines print whole shaders

const server = await serve(folder);
const page = await openBrowser(chromium, { width: Number(side), height: Number(side), flags: kFlags });
try {
  await page.load(`${server.origin}/${path}`);
  if (path.includes("webgpu") && !(await page.evaluate("navigator.gpu?.requestAdapter().then(Boolean)"))) {
    console.log("this browser has no WebGPU");
    process.exitCode = 3;
  } else {
    const message = "document.getElementById('message').textContent";
    await until(page, `document.body.dataset.state === "drawn" || ${message} !== ""`, "a picture");
    await page.evaluate("new Promise(done => setTimeout(() => requestAnimationFrame(() => requestAnimationFrame(done)), 500))");
    writeFileSync(output, Buffer.from((await page.call("Page.captureScreenshot", { format: "png" })).data, "base64"));
    const foreign = page.requests.filter(url => !url.startsWith(server.origin) && !/^(data|blob):/.test(url));
    for (const said of [await page.evaluate(message), ...page.problems, ...foreign.map(url => `the page asks for ${url}`)])
      if (said) console.log(said.slice(0, kMaxCharacters));
  }
} catch (error) {
  for (const said of [error.message, ...page.problems]) console.log(said.slice(0, kMaxCharacters));
  process.exitCode = 1;
}
await page.close();
server.close();
