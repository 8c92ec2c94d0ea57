// The table of diffuse light over N.L and curvature, and the settings that it needs.

import { Constants } from "@babylonjs/core/Engines/constants.js";
import { Texture } from "@babylonjs/core/Materials/Textures/texture.js";
import "@babylonjs/core/Materials/Textures/Loaders/ddsTextureLoader.js";

const kWidth = @table_width@, kHeight = @table_height@;

// Numbers, not colours; rows are curvatures, which a smaller mip level would mix.
const kSettings = {
  gammaSpace: false,
  wrapU: Constants.TEXTURE_CLAMP_ADDRESSMODE,
  wrapV: Constants.TEXTURE_CLAMP_ADDRESSMODE,
  anisotropicFilteringLevel: 1,
  noMipmap: true,
  samplingMode: Constants.TEXTURE_BILINEAR_SAMPLINGMODE,
  textureType: Constants.TEXTURETYPE_HALF_FLOAT,
};

// A promise of the texture. Rejected with a sentence where the file is missing or is not the table.
export function loadSkinTable(scene, url = new URL("./skin_table.dds", import.meta.url).href) {
  return new Promise((done, fail) => {
    const table = new Texture(url, scene, {
      noMipmap: kSettings.noMipmap,
      samplingMode: kSettings.samplingMode,
      invertY: false,
      onLoad: () => {
        const fault = faultOfTable(table);
        if (fault) fail(new Error(`${url} is not the skin's table: ${fault}`));
        else done(table);
      },
      onError: message => fail(new Error(`The skin's table cannot be loaded from ${url}: ${message}`)),
    });
    const { gammaSpace, wrapU, wrapV, anisotropicFilteringLevel } = kSettings;
    Object.assign(table, { gammaSpace, wrapU, wrapV, anisotropicFilteringLevel });
  });
}

// What is wrong with a texture as the skin's table, in words; empty: nothing.
export function faultOfTable(table) {
  if (!table) return "there is none";
  const { width, height } = table.getSize();
  if (width !== kWidth || height !== kHeight) return `it has ${width} x ${height} texels, not ${kWidth} x ${kHeight}`;
  const wrong = Object.keys(kSettings).find(name => table[name] !== kSettings[name]);
  return wrong ? `its ${wrong} is changed` : "";
}
