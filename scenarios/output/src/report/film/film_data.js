// Turns the data of an animation into numbers: times in s, places in units of the plan, heights in m.

const sums = (steps, quantum) => {
  let sum = 0;
  return Float64Array.from(steps, (step) => (sum += step) * quantum);
};

const perhaps = (values, quantum) => values.map((v) => (v === null ? null : v * quantum));

function bytesOf(base64) {
  const text = atob(base64);
  return Uint8Array.from(text, (c) => c.charCodeAt(0));
}

function unpackTrack(raw, data) {
  const q = data.plan.quantum;
  const track = {
    ...raw,
    t: sums(raw.t, 0.01),
    u: sums(raw.u, q),
    v: sums(raw.v, q),
    z: raw.z ? sums(raw.z, 0.01) : null,
    bu: raw.bu ? sums(raw.bu, q) : null,
    bv: raw.bv ? sums(raw.bv, q) : null,
    above: raw.above ? perhaps(raw.above, 0.01) : null,
    threshold: raw.threshold === null ? null : raw.threshold * raw.quantum,
    tips: (raw.tips || []).map(([u, v, z]) => ({ u: u * q, v: v * q, z: z * 1e-4 })),
    lost: raw.lost.map(([u, v, from, until]) => ({
      u: u * q, v: v * q, from: from * 0.01, until: until === null ? Infinity : until * 0.01,
    })),
    declared: raw.declared.map((d) => ({
      ...d, u: d.u * q, v: d.v * q, t: d.t * 0.01, ring: d.ring && d.ring.map((x) => x * q),
    })),
    regions: raw.regions.map((r) => ({
      ...r,
      corners: r.corners.map(([u, v]) => [u * q, v * q]),
      from: r.from === null ? Infinity : r.from * 0.01,
      until: r.until === null ? Infinity : r.until * 0.01,
    })),
  };
  track.series = raw.series.map((s) => ({
    name: s.name,
    values: perhaps(s.values, raw.quantum),
    limits: s.limits ? perhaps(s.limits, raw.quantum) : null,
  }));
  track.behaviour = new Uint8Array(track.t.length);
  let at = 0;
  for (let k = 0; k < raw.does.length; k += 2) {
    track.behaviour.fill(raw.does[k], at, (at += raw.does[k + 1]));
  }
  return track;
}

// Of each filament: place on the plan, height, size (m) and how dense it is, from 0 to 1.
function unpackPlume(raw, perM) {
  if (!raw) return null;
  const between = ([low, high], share) => low + (high - low) * share;
  const moments = raw.wisps.map((text) => {
    const bytes = bytesOf(text);
    const view = new DataView(bytes.buffer);
    const wisps = [];
    for (let k = 0; k + 8 <= bytes.length; k += 8) {
      wisps.push({
        u: between(raw.u, view.getUint16(k, true) / 65535),
        v: between(raw.v, view.getUint16(k + 2, true) / 65535),
        z: between(raw.z, bytes[k + 4] / 255),
        size: Math.exp(between(raw.size, bytes[k + 5] / 255)) * perM,
        dense: bytes[k + 6] / 255,
      });
    }
    // The densest last, on top.
    return wisps.sort((a, b) => a.dense - b.dense);
  });
  return { t: raw.t.map((t) => t * 0.01), moments };
}

function unpack(data) {
  const q = data.plan.quantum;
  const tracks = data.tracks.map((t) => unpackTrack(t, data));
  const plume = unpackPlume(data.plume, data.plan.per_m);
  // Without a machine the plume alone tells the time.
  const timed = tracks.length ? tracks : [plume];
  const begins = Math.min(...timed.map((t) => t.t[0]));
  const ends = Math.max(...timed.map((t) => t.t[t.t.length - 1]));
  const at = ([u, v]) => [u * q, v * q];
  return {
    ...data,
    tracks,
    begins,
    ends: Math.max(ends, begins + 0.01),
    area: data.area.map(at),
    solids: data.solids.map((s) => ({ ...s, corners: s.corners.map(at) })),
    sources: data.sources.map((s) => ({ ...s, u: s.u * q, v: s.v * q })),
    plume,
    bed: data.bed && { ...data.bed, depths: data.bed.depths && bytesOf(data.bed.depths) },
  };
}

// Index of the last moment not after `t`; -1 before the first.
function indexAt(times, t) {
  let low = 0;
  let high = times.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

// Where a track is at `t`, between its moments.
function placeAt(track, t) {
  const k = Math.max(0, indexAt(track.t, t));
  const next = Math.min(k + 1, track.t.length - 1);
  const span = track.t[next] - track.t[k];
  const share = span > 0 ? Math.min(1, Math.max(0, (t - track.t[k]) / span)) : 0;
  const mix = (values) => (values ? values[k] + (values[next] - values[k]) * share : null);
  return { k, u: mix(track.u), v: mix(track.v), z: mix(track.z), bu: mix(track.bu), bv: mix(track.bv) };
}

// Down the section and to its left.
function inCut(cut, u, v) {
  const [du, dv] = [u - cut.from[0], v - cut.from[1]];
  return [du * cut.along[0] + dv * cut.along[1], cut.along[0] * dv - cut.along[1] * du];
}

function digits(value, step) {
  const places = Math.min(6, Math.max(0, Math.ceil(-Math.log10(step) - 1e-9)));
  const text = value.toFixed(places);
  return /^-0(\.0*)?$/.test(text) ? text.slice(1) : text.replace("-", "\u2212");
}

function clock(t) {
  const whole = Math.max(0, Math.round(t));
  const two = (n) => String(n).padStart(2, "0");
  const hours = Math.floor(whole / 3600);
  const rest = `${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
  return hours ? `${hours}:${rest}` : rest;
}
