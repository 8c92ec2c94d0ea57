// node read_mtlx.mjs FILE: what MaterialX itself (compiled to WebAssembly) finds in a document with an OpenPBR surface, as JSON:
// { valid, problem, inputs: { NAME: { value, unit, colorSpace } }, generates }. `valid` is against MaterialX's definition of the
// node; `generates`: a fragment shader of the material is generated.
import { readFileSync } from 'node:fs';
import { createRequire } from 'node:module';

globalThis.require = createRequire(import.meta.url);  // the module is an ES module that calls it
const bin = new URL('./node_modules/@needle-tools/materialx/bin/', import.meta.url).pathname;
globalThis.__dirname = bin;
const { default: MaterialX } = await import(bin + 'JsMaterialXGenShader.js');
const data = readFileSync(bin + 'JsMaterialXGenShader.data.txt');
const mx = await MaterialX({
    locateFile: (name) => bin + name,
    wasmBinary: readFileSync(bin + 'JsMaterialXGenShader.wasm'),
    getPreloadedPackage: () => data.buffer.slice(data.byteOffset, data.byteOffset + data.length),
});

const found = { valid: false, problem: '', inputs: {}, generates: false };
try {
    const generator = mx.EsslShaderGenerator.create(), context = new mx.GenContext(generator);
    const document = mx.createDocument();
    await mx.readFromXmlString(document, readFileSync(process.argv[2], 'utf8'), '');
    document.importLibrary(mx.loadStandardLibraries(context));
    found.valid = document.validate();
    const surface = document.getNodes().find((node) => node.getCategory() === 'open_pbr_surface');
    for (const input of surface.getInputs())
        found.inputs[input.getName()] =
            { value: input.getValueString(), unit: input.getUnit(), colorSpace: input.getActiveColorSpace() };
    const material = document.getMaterialNodes()[0];
    found.generates = generator.generate('skin', material, context).getSourceCode('pixel').includes('subsurface_radius');
} catch (error) {
    found.problem = typeof error === 'number' ? String(mx.getExceptionMessage(error)) : String(error);
}
console.log(JSON.stringify(found));
