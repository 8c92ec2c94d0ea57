// Clips of a head on a page: their list, play and pause, and the time in the clip.

const kBarStyle = "position: fixed; left: 1em; bottom: 1em; display: flex; gap: .6em; align-items: center; color: #fff; font: 14px sans-serif";

function element(parent, name, properties) {
  const made = Object.assign(document.createElement(name), properties);
  parent.append(made);
  return made;
}

// motion: of loadSkinHead(). draw() shows the head once more. The controls are added to `place`; without one they are a bar at the bottom
// of the page. ?clip=NAME&time=SECONDS opens a page there, at rest; a head without clips gets no controls.
export function addSkinControls(motion, draw, place = null) {
  if (!motion.clips.length) return;
  const query = new URLSearchParams(location.search), bar = place ?? element(document.body, "div", { style: kBarStyle });
  const list = element(bar, "select", { title: "clip" }), button = element(bar, "button", { type: "button", textContent: "Play" });
  const slider = element(bar, "input", { type: "range", min: 0, step: 0.001, title: "time", style: "width: 16em" });
  const seconds = element(bar, "output", {});
  element(list, "option", { value: "", textContent: "no clip" });
  for (const { name } of motion.clips) element(list, "option", { value: name, textContent: name });
  let playing = false, before_ms = 0;

  const length_s = () => motion.clips.find(({ name }) => name === list.value)?.length_s ?? 0;
  const show = time_s => {
    slider.max = length_s();
    slider.value = time_s;
    slider.disabled = button.disabled = !list.value;
    seconds.textContent = list.value ? `${Number(slider.value).toFixed(2)} s` : "";
    motion.pose(list.value || null, Number(slider.value));
    draw();
  };
  const frame = now_ms => {
    if (!playing) return;
    const next_s = Number(slider.value) + (now_ms - before_ms) / 1000;
    before_ms = now_ms;
    show(length_s() > 0 ? next_s % length_s() : 0);
    requestAnimationFrame(frame);
  };
  const play = wanted => {
    playing = wanted && Boolean(list.value);
    button.textContent = playing ? "Pause" : "Play";
    if (!playing) return;
    before_ms = performance.now();
    requestAnimationFrame(frame);
  };
  button.addEventListener("click", () => play(!playing));
  slider.addEventListener("input", () => { play(false); show(slider.value); });
  list.addEventListener("change", () => { show(0); play(true); });
  list.value = query.get("clip") ?? "";
  show(Number(query.get("time") ?? 0));
}
