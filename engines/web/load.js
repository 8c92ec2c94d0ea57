// The page's files. An error says which file is missing, in words.

async function get(path) {
  let answer;
  try {
    answer = await fetch(path);
  } catch {
    throw new Error(`${path} cannot be loaded: is the web server still running?`);
  }
  if (!answer.ok) throw new Error(`${path} is missing (the server says ${answer.status}): copy the whole folder.`);
  return answer;
}

export const text = async path => (await get(path)).text();
export const json = async path => (await get(path)).json();
export const bytes = async path => (await get(path)).arrayBuffer();

// Texels as they are stored: no colour management.
export async function image(path) {
  const blob = await (await get(path)).blob();
  try {
    return await createImageBitmap(blob, { colorSpaceConversion: "none", premultiplyAlpha: "none" });
  } catch {
    throw new Error(`${path} is damaged: export the page anew.`);
  }
}
