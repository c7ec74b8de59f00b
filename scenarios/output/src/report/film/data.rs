//! All data of an animation.

use super::plan::{Cut, Plan};
use super::tracks::{self, Behaviours};
use super::wisps;
use crate::charts::panel::range_of;
use crate::results::RunReport;
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use serde_json::{Value, json};

/// Nodes of the bed's grid along each side.
const BED: usize = 40;

/// `None` for a run without machine and without plume.
pub(super) fn film_data(run: &RunReport<'_>) -> Option<Value> {
    let plan = Plan::from_run(run)?;
    let robots = || run.track.robots.iter().filter(|t| !t.rows.is_empty());
    // A gantry beside robots is drawn on their plan.
    let gantries = || run.gantries.iter().filter(|g| !g.rows.is_empty());
    let n = tracks::moments(robots().count() + gantries().count());
    let mut known = Behaviours::default();
    let mut all: Vec<Value> = robots().map(|t| tracks::robot(t, &plan, n, &mut known)).collect();
    all.extend(gantries().map(|g| tracks::gantry(g, &plan, n, &mut known)));
    let plume = wisps::encode(run.plume_film, &plan);
    if all.is_empty() && (plume.is_null() || run.plume_film.moments.len() < 2) {
        return None;
    }
    let cut = Cut::along_flow(run, &plan);
    let place = |p: [f64; 2]| plan.position(p).map(|x| (x / plan.quantum()).round());
    let solids = run.obstacles.iter().map(|o| {
        let corners: Vec<_> = o.corners.iter().map(|c| place(*c)).collect();
        json!({"name": o.id, "corners": corners, "z": o.z, "permeable": o.permeable})
    });
    let sources = run.sources.iter().map(|s| {
        let [u, v] = place([s.position.x, s.position.y]);
        json!({"name": s.id, "u": u, "v": v, "z": s.position.z})
    });
    let area: Vec<_> = (run.area.corners().iter()).map(|p| place([p.x, p.y])).collect();
    Some(json!({
        "version": 1,
        "plan": {"u": plan.u, "v": plan.v, "names": plan.names, "per_m": plan.per_m, "quantum": plan.quantum()},
        "cut": {"from": cut.from, "along": cut.along, "s": cut.s, "name": cut.name,
            "bed": cut.bed.iter().map(|z| z.map(|z| (z * 1000.0).round() as i64)).collect::<Vec<_>>()},
        "area": area, "bed": bed(run, &plan), "solids": solids.collect::<Vec<_>>(),
        "sources": sources.collect::<Vec<_>>(), "layers": run.interfaces,
        "plume": plume, "tracks": all, "behaviours": known.json(),
    }))
}

/// Depths over the plan as shares of their range, a byte each, rows from the upper end of the second axis.
fn bed(run: &RunReport<'_>, plan: &Plan) -> Value {
    let part = |r: [f64; 2], k: usize| r[0] + (r[1] - r[0]) * (k as f64 + 0.5) / BED as f64;
    let nodes = (0..BED * BED).map(|i| {
        let p = plan.world([part(plan.u, i % BED), part(plan.v, BED - 1 - i / BED)]);
        (-run.terrain.bed_z(p.x, p.y)).max(0.0)
    });
    let depths: Vec<f64> = nodes.collect();
    let Some([low, high]) = range_of(depths.iter().copied(), 0.0) else {
        return Value::Null;
    };
    // Level to a hundredth of its depth: one shade.
    let level = high - low < 0.02 * high.max(1e-3);
    let byte = |d: &f64| ((d - low) / (high - low) * 255.0).clamp(0.0, 255.0).round() as u8;
    let bytes: Vec<u8> = depths.iter().map(byte).collect();
    json!({
        "n": BED, "m": [low, high],
        "depths": if level { Value::Null } else { STANDARD.encode(bytes).into() },
    })
}
