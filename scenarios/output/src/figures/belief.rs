//! Maps of where the source may be, at chosen times, with track, plume, obstacles and plan (after Wang & Pang, Figs. 7,
//! 8).

use super::map_layers as layers;
use super::map_legend::short;
use super::solids;
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::label_box::width_of;
use crate::charts::palette::{self, INK};
use crate::charts::panel::{Panel, range_of};
use crate::results::belief_track::{BeliefSnapshot, RobotBelief, off};
use crate::results::{RobotTrack, RunReport, TrackRow};
use robots::handoff::{Belief, BeliefGrid};
use world::math;

/// Largest panel, px.
const LARGEST: [f64; 2] = [560.0, 430.0];
const LEFT: f64 = 66.0;
const TOP: f64 = 70.0;
const GAP: [f64; 2] = [70.0, 92.0];
/// Height of the key, px.
const KEY: f64 = 58.0;
/// Range of probabilities shown, in decades below the largest, and the number of shades for it.
const DECADES: f64 = 4.0;
const SHADES: usize = 12;
/// Planned path.
const PLAN: &str = "#0072b2";

/// The maps of one robot as SVG.
pub fn belief(run: &RunReport<'_>, robot: &RobotBelief) -> String {
    let shown = chosen(robot);
    let (x, y) = bounds(run);
    let scale = (LARGEST[0] / (x[1] - x[0])).min(LARGEST[1] / (y[1] - y[0]));
    let (width, height) = ((x[1] - x[0]) * scale, (y[1] - y[0]) * scale);
    let columns = shown.len().clamp(1, 2);
    let rows = shown.len().div_ceil(2).max(1);
    let mut c =
        Canvas::new(LEFT + columns as f64 * (width.max(250.0) + GAP[0]), TOP + rows as f64 * (height + GAP[1]) + KEY);
    let title = format!("{} · {}: where the source may be", run.summary.headline(), robot.id);
    c.bold([LEFT, 24.0], 13.0, Anchor::Start, &title);
    // A remark on the map if it is certain of a wrong place.
    if let Some(remark) = remark(run, &robot.id) {
        let words = format!("Beware: {remark}.");
        c.text([LEFT, 40.0], 11.0, Anchor::Start, &words);
    }
    let track = run.track.robots.iter().find(|t| t.info.id == robot.id);
    for (k, (words, snapshot)) in shown.iter().enumerate() {
        let panel = Panel {
            left: LEFT + (k % 2) as f64 * (width.max(250.0) + GAP[0]),
            top: TOP + (k / 2) as f64 * (height + GAP[1]),
            width,
            height,
            x,
            y,
        };
        one(&mut c, run, &panel, snapshot, track);
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
    let corners = run.area.corners().map(|p| [p.x, p.y]);
    c.polygon(panel.all(&corners), &Style::line(INK, 1.2).dashed("7 4"));
    for below in [true, false] {
        solids::draw(c, panel, run.obstacles, run.terrain, below);
    }
    if let Some(t) = track {
        let rows: Vec<_> = t.rows.iter().filter(|r| r.t_s <= s.belief.t_s).collect();
        let smelt = |r: &&&TrackRow| r.reading.is_some_and(|v| Some(v) > t.info.threshold);
        let places = rows.iter().filter(smelt).map(|r| [r.p[0], r.p[1]]);
        layers::detections(c, panel, places);
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
    layers::sources(c, panel, run);
    let best = s.belief.grid.centre(s.belief.best);
    best_cell(c, panel.position([best.x, best.y]));
    c.unclip();
    panel.frame(c, 1.0);
    axes(c, panel);
}

/// Ticks and names of the axes of a small map.
pub(super) fn axes(c: &mut Canvas, panel: &Panel) {
    panel.x_ticks(c, true, 10.0);
    panel.y_ticks(c, 50.0, 10.0);
    let under = [panel.left + panel.width / 2.0, panel.bottom() + 31.0];
    c.text(under, 10.5, Anchor::Middle, "East (m)");
    c.upright([panel.left - 44.0, panel.top + panel.height / 2.0], 10.5, "North (m)");
}

/// Where the vehicle truly is.
pub(super) fn vehicle(c: &mut Canvas, p: [f64; 2]) {
    c.circle(p, 4.0, &Style::fill(PLAN).edged("#ffffff", 1.2));
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

/// A layer of cells in shades of a value's share of the largest; neighbours of one shade form one shape.
pub(super) fn shades(c: &mut Canvas, panel: &Panel, grid: &BeliefGrid, plan: &[f64]) {
    let [nx, ny, _] = grid.n;
    let most = plan.iter().fold(0.0, |m: f64, v| m.max(*v));
    let shade = |p: f64| {
        let share = 1.0 + math::ln((p / most).max(1e-30)) / (DECADES * std::f64::consts::LN_10);
        (share * SHADES as f64).ceil().clamp(0.0, SHADES as f64) as usize
    };
    let corner = |i: usize, j: usize| {
        let p = grid.world([i as f64 * grid.cell_m[0], j as f64 * grid.cell_m[1], 0.0]);
        panel.position([p.x, p.y])
    };
    let mut rings: Vec<Vec<Vec<[f64; 2]>>> = vec![Vec::new(); SHADES + 1];
    for j in 0..ny {
        let mut i = 0;
        while i < nx {
            let s = shade(plan[j * nx + i]);
            let from = i;
            while i < nx && shade(plan[j * nx + i]) == s {
                i += 1;
            }
            if s > 0 {
                rings[s].push(vec![corner(from, j), corner(i, j), corner(i, j + 1), corner(from, j + 1)]);
            }
        }
    }
    for (s, rings) in rings.iter().enumerate() {
        let colour = palette::likelihood(s as f64 / SHADES as f64);
        // The edge has the same colour, so that no light seams appear between the shapes.
        c.lines(rings, true, &Style::fill(&colour).edged(&colour, 0.4));
    }
}

/// Draws the scale of shades after `words`, from position `from` on.
pub(super) fn scale(c: &mut Canvas, [x, y]: [f64; 2], words: &str, from: f64) {
    const CELL: f64 = 14.0;
    c.text([x, y], 10.0, Anchor::Start, words);
    for s in 1..=SHADES {
        let colour = palette::likelihood(s as f64 / SHADES as f64);
        let at = from + (s - 1) as f64 * CELL;
        c.rect(at, y - 9.0, CELL, 11.0, &Style::fill(&colour));
    }
    let end = from + SHADES as f64 * CELL;
    c.text([from, y + 14.0], 9.0, Anchor::Middle, "0.0001");
    c.text([0.5 * (from + end), y + 14.0], 9.0, Anchor::Middle, "0.01");
    c.text([end, y + 14.0], 9.0, Anchor::Middle, "1");
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
        (layers::true_source, "true source"),
        (best_cell, "most probable cell"),
        (vehicle, "vehicle"),
        (|c, p| sample(c, p, &Style::line(INK, 1.3)), "its true track"),
        (layers::detection, "detection"),
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

/// East and north ranges that contain the area.
pub(super) fn bounds(run: &RunReport<'_>) -> ([f64; 2], [f64; 2]) {
    let corners = run.area.corners();
    let along = |k: usize| range_of(corners.iter().map(|p| p[k]), 0.02).unwrap_or([-1.0, 1.0]);
    (along(0), along(1))
}
