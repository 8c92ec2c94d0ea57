// The head of a package as linear floats for tools/checks/host_floats.mjs, drawn by Godot's web build (../godot): ?side=48&points=3, and as
// three_head.js &lambert, &gain, &mistake, &looks, &rest. godot_head.gd runs in the engine; the package is a project of its own, packed here.

import { HalfFloatType } from "three";
import { EXRLoader } from "three/addons/loaders/EXRLoader.js";
import { showFloats } from "./floats.js";

const query = new URLSearchParams(location.search), side = Number(query.get("side")), points = Number(query.get("points"));

const kProject = `config_version=5
[application]
run/main_scene="res://test.tscn"
[rendering]
renderer/rendering_method="gl_compatibility"
`;
const kScene = `[gd_scene load_steps=2 format=3]
[ext_resource type="Script" path="res://test/head.gd" id="1"]
[node name="Test" type="Node"]
script = ExtResource("1")
`;

// Godot's pack, version 2: core/io/file_access_pack.cpp reads it. No checksums.
function packed(files) {
  const encoder = new TextEncoder(), entries = files.map(({ path, bytes }) => {
    const name = encoder.encode(`res://${path}`);
    return { bytes, name, padded: 4 * Math.ceil(name.length / 4) };
  });
  const head = 4 * (5 + 1 + 2 + 16 + 1) + entries.reduce((sum, { padded }) => sum + 4 + padded + 8 + 8 + 16 + 4, 0);
  const pack = new Uint8Array(head + entries.reduce((sum, { bytes }) => sum + bytes.length, 0)), view = new DataView(pack.buffer);
  let at = 0, data = head;
  const u32 = value => { view.setUint32(at, value, true); at += 4; };
  const u64 = value => { view.setBigUint64(at, BigInt(value), true); at += 8; };
  for (const value of [0x43504447, 2, 4, 0, 0, 0]) u32(value);
  u64(0);
  at += 64;
  u32(entries.length);
  for (const { bytes, name, padded } of entries) {
    u32(padded);
    pack.set(name, at);
    at += padded;
    u64(data);
    u64(bytes.length);
    at += 20;
    pack.set(bytes, data);
    data += bytes.length;
  }
  return pack.buffer;
}

// The engine's reader of EXR needs threads, which its web build has not: a table is decoded here, to halves of RGBA with the first row on top.
function halves(path, bytes) {
  const { data, width, height } = new EXRLoader().setDataType(HalfFloatType).parse(bytes.buffer), turned = new Uint16Array(data.length);
  for (let y = 0; y < height; ++y) turned.set(data.subarray(4 * width * (height - 1 - y), 4 * width * (height - y)), 4 * width * y);
  return { path: `${path}.${width}.halves`, bytes: new Uint8Array(turned.buffer) };
}
const read = async path => {
  const bytes = new Uint8Array(await (await fetch(`../${path}`)).arrayBuffer());
  return path.endsWith(".exr") ? halves(path, bytes) : { path, bytes };
};
const written = (path, text) => ({ path, bytes: new TextEncoder().encode(text) });

const squares = [], sum = new Float32Array(4 * (side * points) ** 2), linear = s => s <= 0.04045 ? s / 12.92 : ((s + 0.055) / 1.055) ** 2.4;
window.addPicture = (text, scale) => {
  const values = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  values.forEach((value, i) => { sum[i] += linear(value / 255) / scale; });
};
window.endSquare = () => {
  squares.push(sum.slice());
  sum.fill(0);
};
window.showSquares = () => showFloats(squares, { side, points, fromBottom: false });

try {
  const names = await (await fetch("files.json")).json();
  const files = await Promise.all(names.map(read));
  const pack = packed([...files, await read("test/head.gd"), written("project.godot", kProject), written("test.tscn", kScene),
    written(".godot/global_script_class_cache.cfg", "list=[]\n")]);
  const engine = new Engine({
    canvas: document.getElementById("canvas"), executable: "../godot/index", canvasResizePolicy: 0,
    onPrint: text => console.log(text),
    onPrintError: text => console.error(text),
  });
  await engine.init("../godot/index");
  engine.preloadFile(pack, "head.pck");
  const choice = [...query].map(([name, value]) => `${name}=${value}`);
  await engine.start({ args: ["--main-pack", "head.pck", "--", ...choice] });
} catch (error) {
  document.getElementById("message").textContent = error.message;
}
