// Runs a page's `result` promise in headless Chromium and writes the bytes that it gives, base64, to a file.
//
//     node evaluate_page.mjs CHROMIUM PAGE.html OUTPUT

import { writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { openBrowser } from "./browser.mjs";

const [chromium, path, output] = process.argv.slice(2);
const page = await openBrowser(chromium, { width: 800, height: 600 });
try {
  await page.load("file://" + resolve(path));
  const { data, missing } = await page.evaluate("run()");
  if (data) writeFileSync(output, Buffer.from(data, "base64"));
  else {
    console.error(missing ?? "no result");
    process.exitCode = 3;  // this browser has not what the page needs
  }
} catch (error) {
  console.error(error.message);
  process.exitCode = 1;
}
await page.close();
