// Draws plan, section and series of a run at one moment.

const FONT = "system-ui, sans-serif";

// Round steps of a scale: 1, 2 or 5 times a power of ten.
function niceStep(span, parts) {
  const rough = Math.max(span, 1e-9) / parts;
  const power = 10 ** Math.floor(Math.log10(rough));
  return [1, 2, 5, 10].map((k) => k * power).find((step) => step >= rough * 0.999);
}

// A frame with axes: `x` and `y` are ranges of what is shown, `box` is in CSS pixels.
function makeFrame(box, x, y) {
  const sx = box.w / (x[1] - x[0]);
  const sy = box.h / (y[1] - y[0]);
  return {
    box, x, y, sx, sy,
    px: (value) => box.l + (value - x[0]) * sx,
    py: (value) => box.t + (y[1] - value) * sy,
    ux: (pixel) => x[0] + (pixel - box.l) / sx,
    uy: (pixel) => y[1] - (pixel - box.t) / sy,
  };
}

// Ranges widened so that both axes have one scale.
function squared(box, u, v) {
  const scale = Math.min(box.w / (u[1] - u[0]), box.h / (v[1] - v[0]));
  const wide = (r, size) => {
    const more = (size / scale - (r[1] - r[0])) / 2;
    return [r[0] - more, r[1] + more];
  };
  return makeFrame(box, wide(u, box.w), wide(v, box.h));
}

function clipped(c, frame, draw) {
  c.save();
  c.beginPath();
  c.rect(frame.box.l, frame.box.t, frame.box.w, frame.box.h);
  c.clip();
  draw();
  c.restore();
}

function drawAxes(c, frame, look, names, parts) {
  const { box } = frame;
  c.strokeStyle = look.dim;
  c.lineWidth = 1;
  c.strokeRect(box.l, box.t, box.w, box.h);
  c.fillStyle = look.dim;
  c.font = `11px ${FONT}`;
  const ticks = (range, count, put) => {
    const step = niceStep(range[1] - range[0], count);
    for (let k = Math.ceil(range[0] / step); k * step <= range[1]; k++) put(k * step, digits(k * step, step));
  };
  c.textBaseline = "top";
  ticks(frame.x, parts[0], (value, text) => {
    const x = frame.px(value);
    const half = c.measureText(text).width / 2;
    c.fillRect(x, box.t + box.h, 1, 4);
    c.fillText(text, Math.min(x - half, box.l + box.w + 8 - 2 * half), box.t + box.h + 6);
  });
  c.textAlign = "right";
  c.textBaseline = "middle";
  ticks(frame.y, parts[1], (value, text) => {
    c.fillRect(box.l - 4, frame.py(value), 4, 1);
    c.fillText(text, box.l - 6, frame.py(value));
  });
  c.textAlign = "left";
  c.textBaseline = "bottom";
  c.fillStyle = look.ink;
  c.fillText(names[1], box.l, box.t - 4);
  c.textAlign = "right";
  c.fillText(names[0], box.l + box.w, box.t + box.h + 34);
  c.textAlign = "left";
}

function outline(c, points) {
  c.beginPath();
  points.forEach(([x, y], k) => (k ? c.lineTo(x, y) : c.moveTo(x, y)));
  c.closePath();
}

const mixed = (a, b, share) => a.map((x, k) => Math.round(x + (b[k] - x) * share));

// Green from thin to dense; in the dark from dark to bright.
function plumeColour(share, dark) {
  const [thin, middle, dense] = dark
    ? [[72, 146, 98], [96, 184, 116], [200, 245, 180]]
    : [[132, 190, 104], [72, 158, 84], [0, 68, 27]];
  return share < 0.5 ? mixed(thin, middle, 2 * share) : mixed(middle, dense, 2 * share - 1);
}

// The plume between the two moments round `t`: one fades into the next. `put` gives a filament's place, or null.
function drawPlume(c, scene, t, scale, look, calm, put) {
  const { plume } = scene;
  if (!plume) return;
  const k = Math.max(0, indexAt(plume.t, t));
  const next = Math.min(k + 1, plume.t.length - 1);
  const span = plume.t[next] - plume.t[k];
  let share = span > 0 ? Math.min(1, Math.max(0, (t - plume.t[k]) / span)) : 0;
  if (calm) share = 0;
  for (const [moment, weight] of [[k, 1 - share], [next, share]]) {
    if (weight < 0.02 || (moment === next && next === k && share > 0)) continue;
    for (const wisp of plume.moments[moment]) {
      const at = put(wisp);
      if (!at) continue;
      const [r, g, b] = plumeColour(wisp.dense, look.dark);
      c.fillStyle = `rgba(${r},${g},${b},${(0.3 + 0.45 * wisp.dense) * weight})`;
      c.beginPath();
      c.arc(at[0], at[1], Math.min(24, Math.max(3.6, 1.8 * wisp.size * scale)), 0, 7);
      c.fill();
    }
  }
}

// The part of a track up to `t` in the colours of its behaviours.
function drawTrack(c, scene, track, t, at, look) {
  const last = Math.max(0, indexAt(track.t, t));
  c.lineWidth = 1.7;
  c.lineJoin = "round";
  for (let k = 0; k < last; ) {
    const does = track.behaviour[k];
    c.strokeStyle = look.behaviour(scene.behaviours[does]);
    c.beginPath();
    c.moveTo(...at(track, k));
    for (; k < last && track.behaviour[k] === does; k++) c.lineTo(...at(track, k + 1));
    c.stroke();
  }
  const here = placeAt(track, t);
  if (last < track.t.length) {
    c.strokeStyle = look.behaviour(scene.behaviours[track.behaviour[last]]);
    c.beginPath();
    c.moveTo(...at(track, last));
    c.lineTo(...at(here));
    c.stroke();
  }
}

function ring(c, x, y, radius, fill, edge, width = 1.3) {
  c.beginPath();
  c.arc(x, y, radius, 0, 7);
  if (fill) {
    c.fillStyle = fill;
    c.fill();
  }
  c.strokeStyle = edge;
  c.lineWidth = width;
  c.stroke();
}

function star(c, x, y, radius, fill, edge) {
  outline(c, Array.from({ length: 10 }, (_, k) => {
    const r = k % 2 ? radius * 0.45 : radius;
    const angle = (k * Math.PI) / 5 - Math.PI / 2;
    return [x + r * Math.cos(angle), y + r * Math.sin(angle)];
  }));
  c.fillStyle = fill;
  c.fill();
  c.strokeStyle = edge;
  c.lineWidth = 1.3;
  c.stroke();
}

function cross(c, x, y, size, colour) {
  c.strokeStyle = colour;
  c.lineWidth = 1.8;
  c.beginPath();
  c.moveTo(x - size, y - size);
  c.lineTo(x + size, y + size);
  c.moveTo(x - size, y + size);
  c.lineTo(x + size, y - size);
  c.stroke();
}

// Text with a rim of paper, inside the frame.
function tag(c, frame, text, x, y, look) {
  c.font = `600 11px ${FONT}`;
  const width = c.measureText(text).width;
  const { box } = frame;
  const left = Math.max(box.l + 3, Math.min(x, box.l + box.w - width - 3));
  const base = Math.max(box.t + 13, Math.min(y, box.t + box.h - 4));
  c.textBaseline = "alphabetic";
  c.lineWidth = 3;
  c.lineJoin = "round";
  c.strokeStyle = look.paper;
  c.strokeText(text, left, base);
  c.fillStyle = look.ink;
  c.fillText(text, left, base);
}

// What stays the same on the plan: bed, area, obstacles.
function drawPlanBase(c, scene, frame, look) {
  const { bed } = scene;
  const shade = (share) => {
    const [shallow, deep] = look.dark ? [[38, 54, 66], [18, 30, 42]] : [[246, 249, 251], [185, 207, 223]];
    return mixed(shallow, deep, share);
  };
  c.fillStyle = `rgb(${shade(0.3)})`;
  c.fillRect(frame.box.l, frame.box.t, frame.box.w, frame.box.h);
  if (bed && bed.depths) {
    const small = document.createElement("canvas");
    small.width = small.height = bed.n;
    const image = new ImageData(bed.n, bed.n);
    bed.depths.forEach((d, k) => image.data.set([...shade(d / 255), 255], 4 * k));
    small.getContext("2d").putImageData(image, 0, 0);
    const { u, v } = scene.plan;
    const [l, top] = [frame.px(u[0]), frame.py(v[1])];
    const [r, bottom] = [frame.px(u[1]), frame.py(v[0])];
    const { box } = frame;
    // Beyond its grid the bed goes on as at the edge.
    for (const [sx, sw, x0, x1] of [[0, 1, box.l, l + 1], [bed.n - 1, 1, r - 1, box.l + box.w], [0, bed.n, l, r]]) {
      c.drawImage(small, sx, 0, sw, bed.n, x0, top, x1 - x0, bottom - top);
    }
    for (const [sy, y0, y1] of [[0, box.t, top + 1], [bed.n - 1, bottom - 1, box.t + box.h]]) {
      c.drawImage(small, 0, sy, bed.n, 1, box.l, y0, box.w, y1 - y0);
    }
  }
  c.strokeStyle = look.ink;
  c.lineWidth = 1.2;
  c.setLineDash([6, 4]);
  outline(c, scene.area.map(([u, v]) => [frame.px(u), frame.py(v)]));
  c.stroke();
  c.setLineDash([]);
}

function drawSolids(c, scene, frame, look) {
  for (const solid of scene.solids) {
    outline(c, solid.corners.map(([u, v]) => [frame.px(u), frame.py(v)]));
    c.globalAlpha = solid.permeable ? 0.25 : 0.72;
    c.fillStyle = look.solid;
    c.fill();
    c.globalAlpha = 1;
    c.strokeStyle = look.solid;
    c.lineWidth = 1;
    c.stroke();
  }
}

function drawPlan(c, scene, frame, t, look, want) {
  const at = (track, k) =>
    k === undefined ? [frame.px(track.u), frame.py(track.v)] : [frame.px(track.u[k]), frame.py(track.v[k])];
  clipped(c, frame, () => {
    drawPlanBase(c, scene, frame, look);
    if (want.plume) {
      drawPlume(c, scene, t, frame.sx, look, want.calm, (w) => [frame.px(w.u), frame.py(w.v)]);
    }
    drawSolids(c, scene, frame, look);
    for (const track of scene.tracks) drawRegions(c, track, frame, t, look);
    for (const track of scene.tracks) drawPlanTrack(c, scene, track, frame, t, look, want, at);
    for (const source of scene.sources) star(c, frame.px(source.u), frame.py(source.v), 8, "#fff", "#222");
    for (const track of scene.tracks) drawMarks(c, scene, track, frame, t, look, at);
  });
  drawAxes(c, frame, look, [...scene.plan.names], [frame.box.w / 75, frame.box.h / 55]);
}

function drawRegions(c, track, frame, t, look) {
  for (const region of track.regions) {
    const now = region.from <= t && t < region.until;
    outline(c, region.corners.map(([u, v]) => [frame.px(u), frame.py(v)]));
    c.strokeStyle = look.ink;
    c.lineWidth = now ? 2.2 : 0.9;
    c.setLineDash(now ? [] : [3, 3]);
    c.stroke();
    c.setLineDash([]);
    const middle = [0, 1].map((i) => region.corners.reduce((sum, p) => sum + p[i], 0) / region.corners.length);
    tag(c, frame, region.name, frame.px(middle[0]), frame.py(middle[1]), look);
  }
}

function drawPlanTrack(c, scene, track, frame, t, look, want, at) {
  const last = Math.max(0, indexAt(track.t, t));
  if (want.believed && track.bu) {
    c.strokeStyle = look.dim;
    c.lineWidth = 1;
    c.setLineDash([4, 3]);
    c.beginPath();
    for (let k = 0; k <= last; k++) c.lineTo(frame.px(track.bu[k]), frame.py(track.bv[k]));
    c.stroke();
    c.setLineDash([]);
  }
  // Detections lie under the track, so that its colours stay visible.
  const limit = (s, k) => (s.limits ? s.limits[k] : track.threshold);
  c.fillStyle = look.detection;
  c.globalAlpha = 0.3;
  for (let k = 0; k <= last; k++) {
    const found = track.series.some((s) => {
      const [value, least] = [s.values[k], limit(s, k)];
      return value !== null && least !== null && value >= least;
    });
    if (found) c.fillRect(frame.px(track.u[k]) - 2.5, frame.py(track.v[k]) - 2.5, 5, 5);
  }
  c.globalAlpha = 1;
  drawTrack(c, scene, track, t, at, look);
  for (const lost of track.lost) {
    if (lost.from <= t && t < lost.until) cross(c, frame.px(lost.u), frame.py(lost.v), 3.5, look.lost);
  }
}

// Declarations, and where the machine is.
function drawMarks(c, scene, track, frame, t, look, at) {
  for (const d of track.declared) {
    if (d.t > t) continue;
    const [x, y] = [frame.px(d.u), frame.py(d.v)];
    if (d.ring) ring(c, frame.px(d.ring[0]), frame.py(d.ring[1]), d.ring[2] * frame.sx, null, look.ink, 1);
    if (d.edge) cross(c, x, y, 6, look.ink);
    else {
      ring(c, x, y, 6.5, "#f0e442", "#222", 1.6);
      ring(c, x, y, 1.2, "#222", "#222", 1);
    }
  }
  const here = placeAt(track, t);
  const [x, y] = at(here);
  for (const tip of track.tips) ring(c, frame.px(here.u + tip.u), frame.py(here.v + tip.v), 2.6, "#fff", "#222");
  ring(c, x, y, 5, look.behaviour(scene.behaviours[track.behaviour[here.k]]), look.ink, 2);
  if (scene.tracks.length > 1) tag(c, frame, track.id, x + 9, y - 6, look);
}
