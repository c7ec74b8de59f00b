// Draws the vertical section and the series of a run.

// Range of heights in the section, in m: the water and all that moved in it.
function heights(scene) {
  let low = Math.min(...scene.cut.bed.map((b) => b[0] / 1000));
  for (const track of scene.tracks) {
    if (track.z) for (const z of track.z) low = Math.min(low, z);
    for (const tip of track.tips) low = Math.min(low, tip.z);
  }
  low = Math.min(low, -1e-3);
  return [low * 1.06, -low * 0.06];
}

function drawSection(c, scene, frame, t, look, want) {
  const { cut, plan } = scene;
  const per = plan.per_m;
  const at = (u, v, z) => [frame.px(inCut(cut, u, v)[0]), frame.py(z * per)];
  clipped(c, frame, () => {
    const { box } = frame;
    const surface = frame.py(0);
    c.fillStyle = look.water;
    c.fillRect(box.l, surface, box.w, box.h);
    // Light where only a part of the width is bed, dark where all of it is.
    const bed = (side, colour) => {
      const n = cut.bed.length - 1;
      const top = cut.bed.map((b, k) => [
        frame.px(cut.s[0] + ((cut.s[1] - cut.s[0]) * k) / n), frame.py((b[side] / 1000) * per)]);
      c.fillStyle = colour;
      outline(c, [...top, [box.l + box.w, box.t + box.h], [box.l, box.t + box.h]]);
      c.fill();
    };
    bed(1, look.bed2);
    if (want.plume) {
      drawPlume(c, scene, t, frame.sx, look, want.calm, (w) => at(w.u, w.v, w.z));
    }
    c.strokeStyle = look.layer;
    c.lineWidth = 1;
    c.setLineDash([6, 3]);
    for (const z of scene.layers) {
      c.beginPath();
      c.moveTo(box.l, frame.py(z * per));
      c.lineTo(box.l + box.w, frame.py(z * per));
      c.stroke();
    }
    c.setLineDash([]);
    bed(0, look.bed);
    for (const solid of scene.solids) {
      const s = solid.corners.map(([u, v]) => inCut(cut, u, v)[0]);
      const [l, r] = [frame.px(Math.min(...s)), frame.px(Math.max(...s))];
      const [low, high] = solid.z.map((z) => frame.py(z * per));
      c.globalAlpha = 0.28;
      c.fillStyle = look.solid;
      c.fillRect(l, high, r - l, low - high);
      c.globalAlpha = 1;
      c.strokeStyle = look.solid;
      c.strokeRect(l, high, r - l, low - high);
    }
    c.fillStyle = look.ink;
    c.fillRect(box.l, surface, box.w, 1);
    for (const track of scene.tracks) drawSectionTrack(c, scene, track, frame, t, look, at);
    for (const s of scene.sources) star(c, ...at(s.u, s.v, s.z), 7, "#fff", "#222");
  });
  drawAxes(c, frame, look, [cut.name, per > 1 ? "Up (cm)" : "Up (m)"], [frame.box.w / 75, frame.box.h / 34]);
}

function drawSectionTrack(c, scene, track, frame, t, look, at) {
  const here = placeAt(track, t);
  if (!track.z) {
    for (const tip of track.tips) {
      ring(c, ...at(here.u + tip.u, here.v + tip.v, tip.z), 4, "#fff", look.ink, 1.6);
    }
    return;
  }
  const place = (one, k) =>
    k === undefined ? at(one.u, one.v, one.z) : at(one.u[k], one.v[k], one.z[k]);
  drawTrack(c, scene, track, t, place, look);
  const [x, y] = place(here);
  const above = track.above && track.above[here.k];
  if (above !== null && above >= 0) {
    c.strokeStyle = look.dim;
    c.setLineDash([2, 3]);
    c.beginPath();
    c.moveTo(x, y);
    c.lineTo(x, frame.py((here.z - above) * scene.plan.per_m));
    c.stroke();
    c.setLineDash([]);
  }
  ring(c, x, y, 5, look.behaviour(scene.behaviours[track.behaviour[here.k]]), look.ink, 2);
}

// The strips of a run: readings, and depth over the bed of robots.
function stripsOf(scene) {
  const strips = [];
  for (const track of scene.tracks) {
    const whose = scene.tracks.length > 1 ? `${track.id}: ` : "";
    const values = track.series.flatMap((s) => s.values).filter((v) => v !== null);
    if (values.length) {
      const limits = track.series.flatMap((s) => s.limits || []).filter((v) => v !== null);
      if (track.threshold !== null) limits.push(track.threshold * 1.5);
      // A share begins at zero; volts have no natural zero.
      const volts = track.unit === "V";
      const high = [...values, ...limits].reduce((a, b) => Math.max(a, b), volts ? -1e9 : 1e-9);
      const low = values.reduce((a, b) => Math.min(a, b), volts ? high - 0.01 : 0);
      const what = track.series.length > 1 ? "Probes" : track.series[0].name;
      const range = [low, high + 0.05 * (high - low)];
      strips.push({ track, kind: "reading", name: `${whose}${what} (${track.unit})`, range });
    }
    if (track.z && scene.tracks.length < 3) {
      const bed = (k) => (track.above && track.above[k]) || 0;
      const low = track.z.reduce((lowest, z, k) => Math.min(lowest, z - bed(k)), -0.5);
      strips.push({ track, kind: "depth", name: `${whose}Up (m), and the bed below`, range: [low * 1.05, 0] });
    }
  }
  return strips;
}

const PROBES = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];

function drawStrip(c, scene, strip, frame, t, pointed, look) {
  const { track } = strip;
  const line = (value, until) => {
    c.beginPath();
    let on = false;
    for (let k = 0; k <= until; k++) {
      const y = value(k);
      if (y === null) on = false;
      else {
        const p = [frame.px(track.t[k]), frame.py(y)];
        if (on) c.lineTo(...p);
        else c.moveTo(...p);
        on = true;
      }
    }
    c.stroke();
  };
  const all = track.t.length - 1;
  clipped(c, frame, () => {
    c.fillStyle = look.paper;
    c.fillRect(frame.box.l, frame.box.t, frame.box.w, frame.box.h);
    behaviourBar(c, scene, track, frame, look);
    c.lineWidth = 1.2;
    if (strip.kind === "depth") {
      if (track.above) {
        c.strokeStyle = look.bed;
        c.lineWidth = 2;
        line((k) => (track.above[k] === null ? null : track.z[k] - track.above[k]), all);
      }
      c.lineWidth = 1.4;
      c.strokeStyle = look.ink;
      line((k) => track.z[k], all);
    } else {
      track.series.forEach((s, i) => {
        c.strokeStyle = track.series.length > 1 ? PROBES[i % PROBES.length] : look.ink;
        line((k) => s.values[k], all);
        c.globalAlpha = 0.6;
        c.setLineDash([4, 3]);
        if (s.limits) line((k) => s.limits[k], all);
        c.setLineDash([]);
        c.globalAlpha = 1;
      });
      if (track.threshold !== null) {
        c.strokeStyle = look.detection;
        c.setLineDash([4, 3]);
        line(() => track.threshold, all);
        c.setLineDash([]);
      }
    }
    // What is yet to come is veiled.
    const now = frame.px(t);
    c.globalAlpha = 0.62;
    c.fillStyle = look.paper;
    c.fillRect(now, frame.box.t, frame.box.l + frame.box.w - now, frame.box.h);
    c.globalAlpha = 1;
    c.fillStyle = look.mark;
    c.fillRect(now - 1, frame.box.t, 2, frame.box.h);
    if (pointed !== null) c.fillRect(frame.px(pointed), frame.box.t, 1, frame.box.h);
  });
  drawAxes(c, frame, look, [strip.last ? "Time (s)" : "", strip.name], [frame.box.w / 75, 3]);
}

// Behaviours over time, along the lower edge.
function behaviourBar(c, scene, track, frame, look) {
  const bottom = frame.box.t + frame.box.h;
  for (let k = 0; k < track.t.length - 1; ) {
    const does = track.behaviour[k];
    const from = frame.px(track.t[k]);
    while (k < track.t.length - 1 && track.behaviour[k] === does) k++;
    c.fillStyle = look.behaviour(scene.behaviours[does]);
    c.fillRect(from, bottom - 4, Math.max(0.5, frame.px(track.t[k]) - from), 4);
  }
}
