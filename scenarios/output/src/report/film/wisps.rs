//! The plume of the animation: filaments of some moments, packed into eight bytes each.

use super::plan::Plan;
use crate::charts::panel::range_of;
use crate::results::{PlumeFilm, Wisp};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};
use world::math;

/// Most filaments shown of a moment, and of a run.
const SHOWN: usize = 260;
const ALL: usize = 12_000;
/// Concentrations below this share of the largest are left out of the scale, as a power of e.
const DECADES: f64 = 9.2;

/// A filament and its place on the plan.
type PlacedWisp = ([f64; 2], Wisp);

/// The plume, with filaments that lie far outside the plan left out. Bytes of a filament: two of each place on the
/// plan, as a share of the plan's ranges widened by a tenth; one of its height; one of its size and one of its
/// concentration, both on a scale of logarithms; one that is zero.
pub(super) fn encode(film: &PlumeFilm, plan: &Plan) -> Value {
    let wide = |r: [f64; 2]| [r[0] - 0.1 * (r[1] - r[0]), r[1] + 0.1 * (r[1] - r[0])];
    let (u, v) = (wide(plan.u), wide(plan.v));
    let inside = |w: &Wisp| {
        let p = plan.position([w.p[0], w.p[1]]);
        (u[0] <= p[0] && p[0] <= u[1] && v[0] <= p[1] && p[1] <= v[1]).then_some((p, *w))
    };
    let shown = SHOWN.min(ALL / film.moments.len().max(1));
    let moments: Vec<(f64, Vec<PlacedWisp>)> = (film.moments.iter())
        .map(|(t_s, all)| {
            let near: Vec<_> = all.iter().filter_map(inside).collect();
            let every = near.len().div_ceil(shown).max(1);
            (*t_s, near.into_iter().step_by(every).collect())
        })
        .collect();
    let all = || moments.iter().flat_map(|m| &m.1).map(|(_, w)| w);
    let logs = |of: fn(&Wisp) -> f64| range_of(all().map(|w| math::ln(of(w))), 0.0);
    let heights = range_of(all().map(|w| w.p[2]), 0.0);
    let (Some(z), Some(size), Some(dense)) = (heights, logs(|w| w.size_m), logs(|w| w.dense_kg_m3)) else {
        return Value::Null;
    };
    let dense = [dense[0].max(dense[1] - DECADES), dense[1]];
    let share = |x: f64, r: [f64; 2], top: f64| {
        // In range, so that the conversion keeps the value.
        ((x - r[0]) / (r[1] - r[0]) * top).clamp(0.0, top).round() as u16
    };
    let packed = |wisps: &[PlacedWisp]| {
        let mut bytes = Vec::with_capacity(8 * wisps.len());
        for (p, w) in wisps {
            bytes.extend(share(p[0], u, 65_535.0).to_le_bytes());
            bytes.extend(share(p[1], v, 65_535.0).to_le_bytes());
            let byte = |x: f64, r| share(x, r, 255.0) as u8;
            bytes.push(byte(w.p[2], z));
            bytes.push(byte(math::ln(w.size_m), size));
            bytes.push(byte(math::ln(w.dense_kg_m3), dense));
            bytes.push(0);
        }
        STANDARD.encode(bytes)
    };
    json!({
        "u": u, "v": v, "z": z, "size": size, "dense": dense,
        "t": moments.iter().map(|m| (m.0 * 100.0).round() as i64).collect::<Vec<_>>(),
        "wisps": moments.iter().map(|m| packed(&m.1)).collect::<Vec<_>>(),
    })
}
