// Brings an animation to life: buttons, keys, pointer, and what is said of a moment.

const SPEEDS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
// A whole run lasts about this long unless the reader chooses otherwise, s.
const LASTS_S = 30;

const IN_THE_DARK = { "#000000": "#ffffff", "#0072b2": "#4da3dc" };

function lookOf(section) {
  const style = getComputedStyle(section);
  const of = (name) => style.getPropertyValue(`--${name}`).trim();
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  return {
    dark,
    ink: of("ink"), dim: of("dim"), paper: of("paper"), water: of("water"), bed: of("bed"), bed2: of("bed2"),
    mark: of("mark"),
    solid: dark ? "#b08d68" : "#8c6d4f",
    layer: dark ? "#7fb0dc" : "#1f4e79",
    detection: dark ? "#ff8fae" : "#7a0c2e",
    lost: dark ? "#ff9d5c" : "#a13d00",
    // Black and dark blue lines would vanish in the dark.
    behaviour: ([, colour]) => (dark && IN_THE_DARK[colour]) || colour,
  };
}

function element(name, attributes, ...children) {
  const made = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

function build(section, scene) {
  const id = `film${[...document.querySelectorAll(".film")].indexOf(section)}`;
  const [du, dv] = ["u", "v"].map((k) => scene.plan[k][1] - scene.plan[k][0]);
  section.classList.toggle("tall", dv > 0.6 * du);
  const canvas = (kind, words) => element("canvas", { class: kind, role: "img", "aria-label": words });
  const plan = canvas("plan", "Plan of the mission at the time shown");
  const cut = canvas("section", "Vertical section of the mission at the time shown");
  const series = canvas("series", "Readings and depth over time; drag to change the time");
  const side = element("div", { class: "side" }, cut, series);
  series.hidden = !scene.tracks.length;
  const stage = element("div", {
    class: "stage", tabindex: "0", role: "group", "aria-describedby": `${id}-hint`,
    "aria-label": "Animation. Space plays and pauses, arrows move in time.",
  }, element("div", { class: "views" }, plan, side));
  const play = element("button", { type: "button" }, "Play");
  const range = element("input", {
    type: "range", min: String(scene.begins), max: String(scene.ends), "aria-label": "Time of the mission",
    step: String((scene.ends - scene.begins) / 500), value: String(scene.ends),
  });
  const speed = element("select", { "aria-label": "Speed, times real time" },
    ...SPEEDS.map((s) => element("option", { value: String(s) }, `${s} \u00d7`)));
  const time = element("output", {});
  const tick = (words, on) => {
    const box = element("input", { type: "checkbox" });
    box.checked = on;
    return [box, element("label", { class: "more" }, box, words)];
  };
  const [plume, plumeLabel] = tick("plume", true);
  const [believed, believedLabel] = tick("where it believed to be", true);
  const controls = element("div", { class: "controls" }, play, range, time,
    element("label", {}, speed, "real time"));
  if (scene.plume) controls.append(plumeLabel);
  if (scene.tracks.some((t) => t.bu)) controls.append(believedLabel);
  const says = element("div", { class: "says" });
  const hint = element("p", { class: "hint", id: `${id}-hint` },
    "Space: play or pause. Arrows: back and forth (with Shift farther). Home, End. " +
    "Point at the track or a strip for its readings; click to go there.");
  section.append(stage, controls, says, keyOf(scene), hint);
  section.hidden = false;
  return { plan, cut, series, side, stage, play, range, speed, time, plume, believed, says, hint };
}

// The key of colours and marks.
function keyOf(scene) {
  const key = element("div", { class: "key" });
  scene.behaviours.forEach(([name, colour]) =>
    key.append(element("span", {}, element("i", { style: `background:${colour}` }), name)));
  const mark = (words, style) => key.append(element("span", {}, element("i", { class: "dot", style }), words));
  if (scene.sources.length) mark("true source (star)", "background:#fff;border:1px solid #222");
  const declared = scene.tracks.some((t) => t.declared.some((d) => !d.edge));
  if (declared) mark("declared", "background:#f0e442;border:1px solid #222");
  if (scene.tracks.some((t) => t.series.length)) mark("over the threshold", "background:#7a0c2e");
  if (scene.tracks.some((t) => t.lost.length)) key.append(element("span", {}, "\u00d7 where the plume was lost"));
  const sloped = scene.cut.bed.some((b) => b[1] - b[0] > 0.02 * Math.abs(b[0]));
  if (sloped) mark("bed in a part of the width", "background:#dccfbd");
  if (scene.plume) mark("plume, the denser the darker (light on a dark page)", "background:#5aae61");
  return key;
}

function words(scene, track, t) {
  const { names, per_m: per } = scene.plan;
  const here = placeAt(track, t);
  const unit = per > 1 ? "cm" : "m";
  const said = [`${digits(t, 0.1)} s`];
  const axis = names.map((n) => n.replace(/ \(.*/, "").toLowerCase());
  said.push(`${digits(here.u, 0.1)} ${unit} ${axis[0]}, ${digits(here.v, 0.1)} ${unit} ${axis[1]}`);
  if (here.z !== null) said.push(`depth ${digits(-here.z, 0.1)} m`);
  const above = track.above && track.above[here.k];
  if (above !== null && above !== undefined) said.push(`${digits(above, 0.1)} m above the bed`);
  for (const s of track.series) {
    const value = s.values[here.k];
    const name = track.series.length > 1 ? s.name : "reading";
    if (value !== null) said.push(`${name} ${digits(value, track.unit === "V" ? 0.001 : 0.01)} ${track.unit}`);
  }
  said.push(scene.behaviours[track.behaviour[here.k]][0]);
  const region = track.regions.find((r) => r.from <= t && t < r.until);
  if (region) said.push(`subregion ${region.name}`);
  const done = track.declared.filter((d) => d.t <= t).map((d) => `${d.words} at ${digits(d.t, 1)} s`);
  if (track.gave_up !== null && track.gave_up !== undefined && track.gave_up * 0.01 <= t) done.push("gave up");
  return said.concat(done).join(" \u00b7 ");
}

function start(section) {
  const scene = unpack(JSON.parse(section.querySelector('script[type="application/json"]').textContent));
  const ui = build(section, scene);
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const length = scene.ends - scene.begins;
  const strips = stripsOf(scene);
  if (strips.length) strips[strips.length - 1].last = true;
  let look = lookOf(section);
  let t = scene.ends;
  let playing = false;
  let shown = null; // The moment under the pointer: a track and a time.
  let frames = {};
  let due = false;
  let before = 0;
  const wanted = SPEEDS.filter((s) => s <= length / LASTS_S);
  ui.speed.value = String(wanted.length ? wanted[wanted.length - 1] : 1);

  function size(canvas, height) {
    const width = canvas.clientWidth;
    const dense = Math.min(3, devicePixelRatio || 1);
    canvas.style.height = `${height}px`;
    canvas.width = Math.round(width * dense);
    canvas.height = Math.round(height * dense);
    const c = canvas.getContext("2d");
    c.setTransform(dense, 0, 0, dense, 0, 0);
    c.clearRect(0, 0, width, height);
    return [c, width];
  }

  function draw() {
    due = false;
    const want = { plume: ui.plume.checked, believed: ui.believed.checked, calm: calm.matches };
    const { plan } = scene;
    const box = (l, top, w, h) => ({ l, t: top, w: Math.max(20, w), h: Math.max(20, h) });
    let width = ui.plan.clientWidth;
    const shape = (plan.v[1] - plan.v[0]) / (plan.u[1] - plan.u[0]);
    const most = Math.max(320, Math.min(620, innerHeight * 0.8));
    const inner = Math.max(120, Math.min(most, (width - 64) * shape));
    let c;
    [c, width] = size(ui.plan, inner + 60);
    frames.plan = squared(box(52, 20, width - 64, inner), plan.u, plan.v);
    drawPlan(c, scene, frames.plan, t, look, want);
    if (shown) {
      const here = placeAt(shown.track, shown.t);
      ring(c, frames.plan.px(here.u), frames.plan.py(here.v), 7.5, null, look.mark, 2.4);
    }
    const tall = section.classList.contains("tall") && innerWidth > 700;
    const high = tall ? Math.max(130, inner * 0.36) : 150;
    [c, width] = size(ui.cut, high + 60);
    const z = heights(scene).map((m) => m * plan.per_m);
    frames.cut = makeFrame(box(52, 20, width - 64, high), scene.cut.s, z);
    drawSection(c, scene, frames.cut, t, look, want);
    const strip = Math.max(62, tall ? (inner - high - 60) / Math.max(1, strips.length) - 46 : 78);
    [c, width] = size(ui.series, strips.length * (strip + 42) + 18);
    frames.strips = strips.map((one, k) => {
      const at = box(52, 20 + k * (strip + 42), width - 64, strip);
      const frame = makeFrame(at, [scene.begins, scene.ends], one.range);
      drawStrip(c, scene, one, frame, t, shown && shown.track === one.track ? shown.t : null, look);
      return frame;
    });
    ui.time.textContent = `${clock(t)} of ${clock(scene.ends)}`;
    ui.range.value = String(t);
    ui.range.setAttribute("aria-valuetext", `${Math.round(t)} s`);
    ui.play.textContent = playing ? "Pause" : "Play";
    const moment = shown ? [[shown.track, shown.t]] : scene.tracks.map((track) => [track, t]);
    ui.says.replaceChildren(...moment.map(([track, at]) => {
      const who = `${track.id}${shown ? " (pointed at)" : ""}: `;
      const name = element("b", {}, scene.tracks.length > 1 || shown ? who : "");
      return element("div", {}, name, words(scene, track, at));
    }));
    Object.assign(section.dataset, { t: t.toFixed(3), playing: String(playing), ready: "true" });
  }

  function ask() {
    if (!due) {
      due = true;
      requestAnimationFrame(draw);
    }
  }

  function go(to) {
    t = Math.min(scene.ends, Math.max(scene.begins, to));
    ask();
  }

  function step(now) {
    if (!playing) return;
    const passed = (now - before) / 1000;
    // Without motion the picture changes twice a second.
    if (!calm.matches || passed >= 0.5) {
      before = now;
      go(t + Math.min(passed, 1) * Number(ui.speed.value));
      if (t >= scene.ends) playing = false;
    }
    requestAnimationFrame(step);
  }

  function toggle() {
    playing = !playing;
    if (playing) {
      if (t >= scene.ends) t = scene.begins;
      before = performance.now();
      requestAnimationFrame(step);
    }
    ask();
  }

  function pause() {
    playing = false;
  }

  ui.play.addEventListener("click", toggle);
  ui.range.addEventListener("input", () => {
    pause();
    go(Number(ui.range.value));
  });
  ui.plume.addEventListener("change", ask);
  ui.believed.addEventListener("change", ask);
  section.addEventListener("keydown", (event) => {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const on = event.target;
    if (on === ui.speed || on === ui.plume || on === ui.believed) return;
    if (on === ui.play && (event.key === " " || event.key === "Enter")) return;
    const far = length / (event.shiftKey ? 10 : 100);
    const moves = { ArrowRight: far, ArrowUp: far, ArrowLeft: -far, ArrowDown: -far, Home: -length, End: length };
    if (event.key === " ") toggle();
    else if (event.key in moves) {
      pause();
      shown = null;
      go(t + moves[event.key]);
    } else return;
    event.preventDefault();
  });

  // The moment of a track that is nearest to a point of the plan, as far as the track is drawn.
  function nearest(event) {
    const frame = frames.plan;
    const [x, y] = [event.offsetX, event.offsetY];
    let best = { away: 30 * 30 };
    for (const track of scene.tracks) {
      const last = indexAt(track.t, t);
      for (let k = 0; k <= last; k++) {
        const away = (frame.px(track.u[k]) - x) ** 2 + (frame.py(track.v[k]) - y) ** 2;
        if (away <= best.away) best = { away, track, t: track.t[k] };
      }
    }
    return best.track ? best : null;
  }

  function alongStrip(event) {
    const k = frames.strips.findIndex(({ box }) => event.offsetY < box.t + box.h + 24);
    const n = k < 0 ? strips.length - 1 : k;
    if (n < 0) return null;
    const at = frames.strips[n].ux(event.offsetX);
    return { track: strips[n].track, t: Math.min(scene.ends, Math.max(scene.begins, at)), strip: true };
  }

  ui.plan.addEventListener("pointermove", (event) => {
    shown = nearest(event);
    ask();
  });
  ui.plan.addEventListener("click", (event) => {
    const found = nearest(event);
    if (found) {
      pause();
      go(found.t);
    }
  });
  let held = false;
  ui.series.addEventListener("pointerdown", (event) => {
    const found = alongStrip(event);
    if (!found) return;
    held = true;
    ui.series.setPointerCapture(event.pointerId);
    pause();
    shown = null;
    go(found.t);
  });
  ui.series.addEventListener("pointermove", (event) => {
    shown = alongStrip(event);
    if (held && shown) {
      const to = shown.t;
      shown = null;
      go(to);
    }
    ask();
  });
  for (const name of ["pointerup", "pointercancel"]) ui.series.addEventListener(name, () => (held = false));
  for (const canvas of [ui.plan, ui.series]) {
    canvas.addEventListener("pointerleave", () => {
      shown = null;
      ask();
    });
  }
  new ResizeObserver(ask).observe(section);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
    look = lookOf(section);
    ask();
  });
  draw();
}

for (const section of document.querySelectorAll("section.film")) {
  try {
    start(section);
  } catch (error) {
    // The pictures below tell the same; a broken animation must not stand in their way.
    section.hidden = true;
    section.dataset.failed = String(error);
  }
}
