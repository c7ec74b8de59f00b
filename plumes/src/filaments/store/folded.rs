//! A height mirrored at bed and surface.

/// Reflects a height into the water between `bed` (negative) and the surface at 0, as often as necessary; `up` is the
/// reciprocal of the depth.
#[inline(always)]
pub(crate) fn folded(z: f32, bed: f32, up: f32) -> f32 {
    let depth = -bed;
    let h = (z - bed).abs();
    // Kicks of a million depths do not occur; the limit keeps the conversion cheap and defined.
    let turns = clamped(0.5 * h * up, 1e6);
    // SAFETY: between 0 and a million.
    let h = h - 2.0 * depth * unsafe { turns.to_int_unchecked::<i32>() } as f32;
    let h = if h > depth { 2.0 * depth - h } else { h };
    let z = bed + clamped(h, depth);
    if z < 0.0 { z } else { 0.0 }
}

/// Limits a value to 0 to `hi`; NaN becomes 0. Written so that it compiles to two instructions.
#[inline(always)]
pub(crate) fn clamped(v: f32, hi: f32) -> f32 {
    let v = if v > 0.0 { v } else { 0.0 };
    if v < hi { v } else { hi }
}
