// The controls, and what the pointer does to the picture.

import { createRenderer } from "./renderer.js";
import { addSkinControls } from "./SkinHeadControls.js";
import { add, direction, length, scale, subtract, yawPitch } from "./matrix.js";

const element = id => document.getElementById(id);
const canvas = element("picture"), message = element("message"), wipe = element("wipe"), divider = element("divider");
const degrees = 180 / Math.PI;
const clamp = (x, low, high) => Math.min(Math.max(x, low), high);

function showError(error) {
  message.hidden = false;
  message.className = "error";
  message.textContent = error.message;
  document.body.dataset.state = "error";
}

message.textContent = "Loading …";
if (new URLSearchParams(location.search).get("controls") === "0") document.body.className = "bare";

function start(renderer) {
  const { scene } = renderer;
  const [cameraYaw, cameraPitch] = yawPitch(subtract(scene.camera.eye_mm, scene.camera.target_mm));
  const key = scene.lights.find(light => light.key) ?? { to_light: [0, 0, 1] };
  const [lightYaw, lightPitch] = yawPitch(key.to_light);
  const distance = length(subtract(scene.camera.eye_mm, scene.camera.target_mm));
  const begin = { cameraYaw, cameraPitch, distance, lightYaw, lightPitch };
  const view = { ...begin }, chosen = { tone: 0, curvature: false };

  let waiting = false;
  const redraw = () => {
    if (waiting) return;
    waiting = true;
    requestAnimationFrame(() => {
      waiting = false;
      const target = scene.camera.target_mm;
      const eye = add(target, scale(direction(view.cameraYaw, view.cameraPitch), view.distance));
      renderer.draw({ tone: chosen.tone, showCurvature: chosen.curvature, wipe: wipe.value / 100, eye, target,
        yaw: view.lightYaw, pitch: view.lightPitch });
      document.body.dataset.state = "drawn";
    });
  };
  const showView = () => {
    element("yaw").value = Math.round(view.lightYaw * degrees);
    element("pitch").value = Math.round(view.lightPitch * degrees);
    redraw();
  };
  const showWipe = () => {
    divider.style.left = `${wipe.value}%`;
    redraw();
  };

  addTones(scene.tones, number => {
    chosen.tone = number;
    redraw();
  });
  wipe.addEventListener("input", showWipe);
  element("yaw").addEventListener("input", event => { view.lightYaw = event.target.value / degrees; redraw(); });
  element("pitch").addEventListener("input", event => { view.lightPitch = event.target.value / degrees; redraw(); });
  element("show").addEventListener("change", event => {
    chosen.curvature = event.target.value === "1";
    element("scale").hidden = !chosen.curvature;
    divider.hidden = chosen.curvature;
    redraw();
  });
  element("reset").addEventListener("click", () => { Object.assign(view, begin); showView(); });
  followPointers(view, begin, showView);
  followKeys(view, showView);
  dragDivider(showWipe);
  new ResizeObserver(redraw).observe(canvas);
  canvas.addEventListener("webglcontextlost", () => showError(new Error("The browser took the graphics away: load the page again.")));

  document.title = `${scene.name}, skin by Dermis`;
  element("credit").textContent = scene.credit;
  if (renderer.motion) {
    element("clips").hidden = false;
    addSkinControls(renderer.motion, redraw, element("clips"));
  }
  if (document.body.className === "bare") wipe.value = 0;
  message.hidden = true;
  showView();
  showWipe();
}

function addTones(tones, choose) {
  const row = element("tones").querySelector(".row");
  tones.forEach((tone, number) => {
    const label = document.createElement("label"), input = document.createElement("input"), swatch = document.createElement("span");
    Object.assign(input, { type: "radio", name: "tone", value: number, checked: number === 0 });
    swatch.textContent = tone.name;
    swatch.style.background = `color(srgb-linear ${tone.mean_albedo_linear.join(" ")})`;
    const show = () => { element("tone-text").textContent = `Scattering of ${tone.description}`; };
    input.addEventListener("change", () => { show(); choose(number); });
    label.append(input, swatch);
    row.append(label);
    if (number === 0) show();
  });
}

// One pointer turns the head or the light; the wheel or two pointers come nearer.
function followPointers(view, begin, changed) {
  const points = new Map();
  const spread = () => {
    const [a, b] = [...points.values()];
    return Math.hypot(a.x - b.x, a.y - b.y);
  };
  const zoom = factor => { view.distance = clamp(view.distance * factor, 0.25 * begin.distance, 2.5 * begin.distance); };
  canvas.addEventListener("pointerdown", event => {
    canvas.setPointerCapture(event.pointerId);
    points.set(event.pointerId, { x: event.clientX, y: event.clientY });
  });
  canvas.addEventListener("pointermove", event => {
    const last = points.get(event.pointerId);
    if (!last) return;
    const before = points.size > 1 ? spread() : 0, dx = event.clientX - last.x, dy = event.clientY - last.y;
    points.set(event.pointerId, { x: event.clientX, y: event.clientY });
    const turnsLight = document.querySelector("[name=drag]:checked").value === "light" || event.buttons === 2;
    if (points.size > 1) zoom(before / Math.max(spread(), 1));
    else if (turnsLight) {
      view.lightYaw = Math.atan2(Math.sin(view.lightYaw + dx * 0.01), Math.cos(view.lightYaw + dx * 0.01));
      view.lightPitch = clamp(view.lightPitch - dy * 0.01, -60 / degrees, 85 / degrees);
    } else {
      view.cameraYaw -= dx * 0.008;
      view.cameraPitch = clamp(view.cameraPitch + dy * 0.008, -1.4, 1.4);
    }
    changed();
  });
  for (const type of ["pointerup", "pointercancel"]) canvas.addEventListener(type, event => points.delete(event.pointerId));
  canvas.addEventListener("contextmenu", event => event.preventDefault());
  canvas.addEventListener("wheel", event => {
    event.preventDefault();
    zoom(Math.exp(clamp(event.deltaY, -100, 100) * 0.001));
    changed();
  }, { passive: false });
}

function followKeys(view, changed) {
  const steps = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
  canvas.addEventListener("keydown", event => {
    const step = steps[event.key];
    if (!step) return;
    event.preventDefault();
    view.cameraYaw += step[0];
    view.cameraPitch = clamp(view.cameraPitch + step[1], -1.4, 1.4);
    changed();
  });
}

function dragDivider(changed) {
  divider.addEventListener("pointerdown", event => divider.setPointerCapture(event.pointerId));
  divider.addEventListener("pointermove", event => {
    if (!divider.hasPointerCapture(event.pointerId)) return;
    const box = canvas.getBoundingClientRect();
    wipe.value = clamp((event.clientX - box.left) / box.width, 0, 1) * 100;
    changed();
  });
}

createRenderer(canvas).then(start).catch(showError);
