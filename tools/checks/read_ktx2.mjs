// node read_ktx2.mjs FILE X Y: what an independent reader finds in a KTX2 file of 16-bit floats: format, size, levels,
// the embedded convention's kind and encoding, and the red, green and blue of one texel, one item a line.
import { readFileSync } from 'node:fs';
import { KHR_DF_TRANSFER_LINEAR, read } from 'ktx-parse';

const [path, x, y] = process.argv.slice(2);
const file = read(readFileSync(path));
const half = (bits) => {
    const exponent = (bits >> 10) & 31, mantissa = bits & 1023, sign = bits >> 15 ? -1 : 1;
    if (exponent === 0) return sign * mantissa * 2 ** -24;
    return sign * (1 + mantissa / 1024) * 2 ** (exponent - 15);
};
const level = file.levels[0].levelData;
const data = new DataView(level.buffer, level.byteOffset, level.byteLength);
const texel = 8 * (Number(y) * file.pixelWidth + Number(x));
const text = file.keyValue.dermis;  // bytes with a zero at the end, as the format has it
const convention = JSON.parse(typeof text === 'string' ? text : new TextDecoder().decode(text).replace(/\0+$/, ''));
console.log(file.vkFormat, file.pixelWidth, file.pixelHeight, file.levels.length);
console.log(file.dataFormatDescriptor[0].transferFunction === KHR_DF_TRANSFER_LINEAR ? 'linear' : 'not linear');
console.log(convention.kind, convention.encoding);
console.log(...[0, 2, 4].map((offset) => half(data.getUint16(texel + offset, true))));
