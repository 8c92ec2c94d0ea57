// The table of diffuse light over N.L and curvature, and the settings that it needs.

import { ClampToEdgeWrapping, HalfFloatType, LinearFilter, NoColorSpace } from "three/webgpu";
import { EXRLoader } from "three/addons/loaders/EXRLoader.js";

export const maxCurvaturePerMm = @max_curvature_per_mm@;  // of its last row
const kWidth = @table_width@, kHeight = @table_height@;

// Numbers, not colours; rows are curvatures, which a smaller mip level would mix.
const kSettings = {
  colorSpace: NoColorSpace,
  type: HalfFloatType,
  wrapS: ClampToEdgeWrapping,
  wrapT: ClampToEdgeWrapping,
  minFilter: LinearFilter,
  magFilter: LinearFilter,
  generateMipmaps: false,
  anisotropy: 1,
};

// A promise of the texture. Rejected with a sentence where the file is missing or is not the table.
export async function loadSkinTable(url = new URL("./skin_table.exr", import.meta.url).href) {
  const table = await new EXRLoader().setDataType(HalfFloatType).loadAsync(url)
    .catch(error => { throw new Error(`The skin's table cannot be loaded from ${url}: ${error.message}`); });
  Object.assign(table, kSettings);
  const fault = faultOfTable(table);
  if (fault) throw new Error(`${url} is not the skin's table: ${fault}`);
  return table;
}

// What is wrong with a texture as the skin's table, in words; empty: nothing.
export function faultOfTable(table) {
  if (!table) return "there is none";
  const { width, height } = table.image ?? {};
  if (width !== kWidth || height !== kHeight) return `it has ${width} x ${height} texels, not ${kWidth} x ${kHeight}`;
  const wrong = Object.keys(kSettings).find(name => table[name] !== kSettings[name]);
  return wrong ? `its ${wrong} is changed` : "";
}
