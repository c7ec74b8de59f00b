//! Maps of where the source may be, at chosen times, with track, plume, obstacles and plan (after Wang & Pang, Figs. 7,
//! 8).

use super::map::legend::short;
use super::map::small_maps::{LEFT, axes, place, scale, shades, sheet, vehicle};
use super::marks;
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::label_box::width_of;
use crate::charts::palette::INK;
use crate::charts::panel::Panel;
use crate::results::belief_track::{BeliefSnapshot, RobotBelief, off};
use crate::results::{RobotTrack, RunReport, TrackRow};
use robots::handoff::Belief;

const TOP: f64 = 70.0;
/// Height of the key, px.
const KEY: f64 = 58.0;
/// Planned path.
const PLAN: &str = "#0072b2";

/// The maps of one robot as SVG.
pub fn belief(run: &RunReport<'_>, robot: &RobotBelief) -> String {
    let shown = chosen(robot);
    let title = format!("{} · {}: where the source may be", run.summary.headline(), robot.id);
    let (mut c, panels) = sheet(run, &title, shown.len(), TOP, KEY);
    // A remark on the map if it is certain of a wrong place.
    if let Some(remark) = remark(run, &robot.id) {
        let words = format!("Beware: {remark}.");
        c.text([LEFT, 40.0], 11.0, Anchor::Start, &words);
    }
    let track = run.track.robots.iter().find(|t| t.info.id == robot.id);
    for (panel, (words, snapshot)) in panels.iter().zip(&shown) {
        one(&mut c, run, panel, snapshot, track);
        let b = &snapshot.belief;
        let caption = format!("t = {:.0} s · {words}", b.t_s);
        c.bold([panel.left, panel.top - 8.0], 11.0, Anchor::Start, &caption);
        let unit = if b.grid.n[2] == 1 { "m²" } else { "m³" };
        let off = off(&b.grid.centre(b.best), run.sources).map_or_else(String::new, |m| format!(", {m:.0} m off"));
        let p = b.p[b.best];
        let largest = if p < 5e-4 { short(p) } else { format!("{p:.3}") };
        let numbers =
            format!("largest {largest}{off}; entropy {:.2} nat; 95 % in {:.0} {unit}", b.entropy_nat, b.credible_95);
        c.text([panel.left, panel.bottom() + 48.0], 10.0, Anchor::Start, &numbers);
    }
    let bottom = c.height - 60.0;
    key(&mut c, [LEFT, bottom], robot.last.belief.grid.n[2] > 1);
    c.svg(&format!("belief{}", robot.id))
}

/// Times shown: before the first detection, after it, at one and two thirds of the time until the most probable cell
/// reached its last place, at that time, and at the end.
fn chosen(robot: &RobotBelief) -> Vec<(&'static str, &BeliefSnapshot)> {
    let from = robot.first.as_ref().map(|s| s.belief.t_s);
    let between = |share: f64| {
        let (from, to) = (from?, robot.settled_s()?);
        let t_s = from + share * (to - from);
        let later = |s: &&BeliefSnapshot| s.belief.t_s >= t_s && s.belief.t_s > from;
        robot.between.iter().find(later)
    };
    let all = [
        ("before the first detection", robot.before.as_ref()),
        ("first detection", robot.first.as_ref()),
        ("on the way", between(0.33)),
        ("on the way", between(0.67)),
        ("most probable cell settled", between(1.0)),
        ("end", Some(&robot.last)),
    ];
    let mut shown: Vec<_> = all.into_iter().filter_map(|(words, s)| Some((words, s?))).collect();
    shown.dedup_by_key(|(_, s)| s.belief.updates);
    shown
}

fn one(c: &mut Canvas, run: &RunReport<'_>, panel: &Panel, s: &BeliefSnapshot, track: Option<&RobotTrack>) {
    panel.clip(c);
    cells(c, panel, &s.belief);
    if let Some(plume) = &s.plume {
        // A dot is a stroke of length zero with a round end, so that all dots form one shape.
        let dots: Vec<_> = (plume.points.iter())
            .map(|[x, y, ..]| panel.position([*x, *y]))
            .map(|p| vec![p, [p[0] + 0.05, p[1]]])
            .collect();
        c.lines(&dots, false, &Style::line("#333333", 1.3).faint(0.45));
    }
    place(c, panel, run);
    if let Some(t) = track {
        let rows: Vec<_> = t.rows.iter().filter(|r| r.t_s <= s.belief.t_s).collect();
        let smelt = |r: &&&TrackRow| r.reading.is_some_and(|v| Some(v) > t.info.threshold);
        let places = rows.iter().filter(smelt).map(|r| [r.p[0], r.p[1]]);
        marks::detections(c, panel, places);
        let line = rows.iter().map(|r| panel.position([r.p[0], r.p[1]])).collect();
        c.polyline(line, &Style::line("#ffffff", 3.0).faint(0.7));
        let line = rows.iter().map(|r| panel.position([r.p[0], r.p[1]])).collect();
        c.polyline(line, &Style::line(INK, 1.3));
        if let Some(r) = rows.last() {
            vehicle(c, panel.position([r.p[0], r.p[1]]));
        }
    }
    let plan: Vec<_> = s.planned.iter().map(|p| panel.position([p.x, p.y])).collect();
    c.polyline(plan, &Style::line(PLAN, 1.6).dashed("5 3"));
    marks::sources(c, panel, run);
    let best = s.belief.grid.centre(s.belief.best);
    best_cell(c, panel.position([best.x, best.y]));
    axes(c, panel);
}

/// The remark in the summary on a robot's map.
pub(super) fn remark<'a>(run: &'a RunReport<'_>, id: &str) -> Option<&'a str> {
    let of = run.summary.robots.iter().find(|r| r.id == id)?;
    of.map.as_ref()?.remark.as_deref()
}

/// A cross at the most probable cell.
fn best_cell(c: &mut Canvas, [x, y]: [f64; 2]) {
    const R: f64 = 6.0;
    for (colour, width) in [("#ffffff", 4.0), (INK, 1.8)] {
        let style = Style::line(colour, width);
        c.line([x - R, y - R], [x + R, y + R], &style);
        c.line([x - R, y + R], [x + R, y - R], &style);
    }
}

/// The cells in shades of their probability, summed over depth.
fn cells(c: &mut Canvas, panel: &Panel, b: &Belief) {
    let layer = b.grid.n[0] * b.grid.n[1];
    let mut plan = vec![0.0; layer];
    for (i, p) in b.p.iter().enumerate() {
        plan[i % layer] += p;
    }
    shades(c, panel, &b.grid, &plan);
}

/// Key of the shades and signs.
fn key(c: &mut Canvas, [x, y]: [f64; 2], space: bool) {
    let words = if space {
        "Probability (summed over the depth), share of the largest:"
    } else {
        "Probability, share of the largest:"
    };
    scale(c, [x, y], words, x + if space { 330.0 } else { 195.0 });
    type Draw = fn(&mut Canvas, [f64; 2]);
    let signs: [(Draw, &str); 7] = [
        (marks::true_source, "true source"),
        (best_cell, "most probable cell"),
        (vehicle, "vehicle"),
        (|c, p| sample(c, p, &Style::line(INK, 1.3)), "its true track"),
        (marks::detection, "detection"),
        (|c, p| sample(c, p, &Style::line(PLAN, 1.6).dashed("5 3")), "planned path"),
        (
            |c, [x, y]| {
                for d in [[-6.0, 2.0], [-1.0, -3.0], [5.0, 1.0]] {
                    c.circle([x + d[0], y + d[1]], 0.8, &Style::fill("#666666"));
                }
            },
            "plume",
        ),
    ];
    let (mut at, y) = (x + 10.0, y + 30.0);
    for (k, (draw, words)) in signs.into_iter().enumerate() {
        // Two lines, so that the key of a single panel has room.
        let y = y + if k < 3 { 0.0 } else { 17.0 };
        if k == 3 {
            at = x + 10.0;
        }
        draw(c, [at, y - 4.0]);
        c.text([at + 17.0, y], 10.0, Anchor::Start, words);
        at += 17.0 + width_of(words, 10.0) + 24.0;
    }
}

fn sample(c: &mut Canvas, [x, y]: [f64; 2], style: &Style<'_>) {
    c.line([x - 12.0, y], [x + 12.0, y], style);
}
