// node validate_gltf.mjs FILE: what the Khronos validator finds in a GLB, as JSON: { errors, warnings, notes }, a text each.
import { readFileSync } from 'node:fs';
import validator from 'gltf-validator';

const { issues } = await validator.validateBytes(new Uint8Array(readFileSync(process.argv[2])));
const of = (severity) => issues.messages.filter((found) => found.severity === severity)
    .map(({ code, message, pointer }) => `${code} ${pointer ?? ''}: ${message}`);
console.log(JSON.stringify({ errors: of(0), warnings: of(1), notes: of(2) }));
