//! The tracks of the animation: what robots and gantries did, thinned and as whole numbers.

use super::plan::Plan;
use crate::charts::palette;
use crate::results::{GantryTrack, RobotTrack};
use robots::handoff::region_name;
use serde_json::{Value, json};

/// Most moments of all tracks together, and least of each.
const MOMENTS: usize = 2400;
const LEAST: usize = 300;
const MOST: usize = 1500;

/// Behaviours in the order in which they occur, each with its name for people and its colour.
#[derive(Default)]
pub(super) struct Behaviours(Vec<[String; 2]>);

impl Behaviours {
    fn number(&mut self, (colour, name): (&str, &str)) -> usize {
        let known = self.0.iter().position(|b| b[0] == name);
        known.unwrap_or_else(|| {
            self.0.push([name.to_owned(), colour.to_owned()]);
            self.0.len() - 1
        })
    }

    pub(super) fn json(self) -> Value {
        json!(self.0)
    }
}

/// Number of moments for each of `n` tracks.
pub(super) fn moments(n: usize) -> usize {
    (MOMENTS / n.max(1)).clamp(LEAST, MOST)
}

/// Rows in groups, so that there are at most `n`; a group stands for its last row and its highest reading.
fn groups<T>(rows: &[T], n: usize) -> impl Iterator<Item = (&T, &[T])> {
    let every = rows.len().div_ceil(n).max(1);
    rows.chunks(every).filter_map(|g| Some((g.last()?, g)))
}

fn whole(x: f64, quantum: f64) -> Option<i64> {
    // `None` for what is not a number; JSON has none.
    (x / quantum).is_finite().then(|| (x / quantum).round() as i64)
}

fn highest(values: impl Iterator<Item = f64>) -> Option<f64> {
    values.filter(|v| v.is_finite()).reduce(f64::max)
}

/// Differences between neighbours; the first from zero.
fn steps(values: &[i64]) -> Vec<i64> {
    let before = std::iter::once(&0).chain(values);
    values.iter().zip(before).map(|(v, b)| v - b).collect()
}

/// Behaviours as (number, how many moments) in turn.
fn runs(numbers: &[usize]) -> Vec<usize> {
    let mut out: Vec<usize> = Vec::new();
    for (k, &b) in numbers.iter().enumerate() {
        if k > 0 && numbers[k - 1] == b {
            *out.last_mut().expect("two for each run") += 1;
        } else {
            out.extend([b, 1]);
        }
    }
    out
}

/// A robot: places in quanta of the plan, heights in cm, times in 1/100 s, readings in 1/10 000 of full scale.
pub(super) fn robot(t: &RobotTrack, plan: &Plan, n: usize, known: &mut Behaviours) -> Value {
    let q = plan.quantum();
    let (mut at, mut u, mut v, mut z) = (vec![], vec![], vec![], vec![]);
    let (mut bu, mut bv, mut reads, mut above, mut does) = (vec![], vec![], vec![], vec![], vec![]);
    for (r, group) in groups(&t.rows, n) {
        let (p, b) = (plan.position([r.p[0], r.p[1]]), plan.position(r.believed));
        let numbers = [(r.t_s, 0.01), (p[0], q), (p[1], q), (r.p[2], 0.01)];
        let [Some(t), Some(x), Some(y), Some(h)] = numbers.map(|(x, q)| whole(x, q)) else {
            continue;
        };
        at.push(t);
        u.push(x);
        v.push(y);
        z.push(h);
        bu.push(whole(b[0], q).unwrap_or(x));
        bv.push(whole(b[1], q).unwrap_or(y));
        let read = highest(group.iter().filter_map(|r| r.reading));
        reads.push(read.and_then(|x| whole(x, 1e-4)));
        above.push(whole(r.altitude_m, 0.01));
        does.push(known.number(palette::behaviour_look(r.behaviour)));
    }
    let lost = t.lost_over_time.iter().filter_map(|l| {
        let p = plan.position(l.p);
        let numbers = [(p[0], q), (p[1], q), (l.from_s, 0.01)].map(|(x, q)| whole(x, q));
        let [u, v, from] = [numbers[0]?, numbers[1]?, numbers[2]?];
        Some((u, v, from, l.until_s.and_then(|t| whole(t, 0.01))))
    });
    let declared = t.declarations.iter().filter_map(|d| {
        let p = plan.position([d.position.x, d.position.y]);
        let ring = d.evidence.and_then(|e| {
            let m = plan.position(e.middle_m);
            let [u, v, r] = [m[0], m[1], e.reach_m * plan.per_m].map(|x| whole(x, q));
            Some([u?, v?, r?])
        });
        Some(json!({
            "u": whole(p[0], q)?, "v": whole(p[1], q)?, "t": whole(d.t_s, 0.01)?, "edge": d.at_edge(),
            "words": if d.at_edge() { "plume leads on".to_owned() } else { format!("declared by {}", d.rule) },
            "ring": ring,
        }))
    });
    let regions = t.regions.iter().zip(0..).map(|(r, k)| {
        json!({
            "name": region_name(k), "words": r.state.label(),
            "corners": r.area.corners().map(|p| plan.position([p.x, p.y]).map(|x| whole(x, q))),
            "from": r.from_s.and_then(|t| whole(t, 0.01)), "until": r.until_s.and_then(|t| whole(t, 0.01)),
        })
    });
    json!({
        "id": t.info.id, "t": steps(&at), "u": steps(&u), "v": steps(&v), "z": steps(&z),
        "bu": steps(&bu), "bv": steps(&bv), "above": above, "does": runs(&does),
        "series": if reads.iter().all(Option::is_none) { vec![] } else {
            vec![json!({"name": "Reading", "values": reads})]
        },
        // To what people read: µg/L with a sensor of known scale, otherwise a share.
        "unit": t.info.full_scale_ug_l.map_or("of full scale", |_| "µg/L"),
        "quantum": 1e-4 * t.info.full_scale_ug_l.filter(|f| f.is_finite()).unwrap_or(1.0),
        "threshold": t.info.threshold.and_then(|s| whole(s, 1e-4)),
        "lost": lost.collect::<Vec<_>>(), "declared": declared.collect::<Vec<_>>(),
        "regions": regions.collect::<Vec<_>>(),
    })
}

/// A gantry, as a robot without height; readings of each probe in mV.
pub(super) fn gantry(g: &GantryTrack, plan: &Plan, n: usize, known: &mut Behaviours) -> Value {
    let q = plan.quantum();
    let (mut at, mut u, mut v, mut does) = (vec![], vec![], vec![], vec![]);
    let probes = g.info.probes.len();
    let mut volts: Vec<Vec<Option<i64>>> = vec![Vec::new(); probes];
    let mut limits: Vec<Vec<Option<i64>>> = vec![Vec::new(); probes];
    for (r, group) in groups(&g.rows, n) {
        let p = plan.position(r.head);
        let [Some(t), Some(x), Some(y)] = [(r.t_s, 0.01), (p[0], q), (p[1], q)].map(|(x, q)| whole(x, q)) else {
            continue;
        };
        at.push(t);
        u.push(x);
        v.push(y);
        for (k, (volts, limits)) in volts.iter_mut().zip(&mut limits).enumerate() {
            let read = group.iter().filter_map(|r| r.volts.and_then(|v| v.get(k).copied()));
            volts.push(highest(read).and_then(|x| whole(x, 1e-3)));
            // Zero before the searcher knows its background.
            let limit = r.threshold_v.get(k).filter(|v| **v != 0.0);
            limits.push(limit.and_then(|v| whole(*v, 1e-3)));
        }
        does.push(known.number(palette::gantry_look(r.behaviour)));
    }
    let head = g.rows.last().map_or([0.0; 2], |r| plan.position(r.head));
    let tips = g.tips.iter().filter_map(|p| {
        let t = plan.position([p[0], p[1]]);
        Some([whole(t[0] - head[0], q)?, whole(t[1] - head[1], q)?, whole(p[2], 1e-4)?])
    });
    let declared = g.declared.zip(g.stopped).and_then(|(p, (t_s, _))| {
        let p = plan.position(p);
        Some(json!({"u": whole(p[0], q)?, "v": whole(p[1], q)?, "t": whole(t_s, 0.01)?, "edge": false,
            "words": "declared", "ring": null}))
    });
    let series = g.info.probes.iter().zip(volts.iter().zip(&limits));
    json!({
        "id": g.info.id, "t": steps(&at), "u": steps(&u), "v": steps(&v), "does": runs(&does),
        "series": series.map(|(name, (volts, limits))| json!({"name": name, "values": volts, "limits": limits}))
            .collect::<Vec<_>>(),
        "unit": "V", "quantum": 1e-3, "threshold": null, "tips": tips.collect::<Vec<_>>(),
        "declared": declared.into_iter().collect::<Vec<_>>(), "lost": [], "regions": [],
        "gave_up": g.stopped.filter(|s| !s.1).and_then(|s| whole(s.0, 0.01)),
    })
}
