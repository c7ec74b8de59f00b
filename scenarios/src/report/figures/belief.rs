//! Maps of where the source may be, at chosen times, with track, plume, obstacles and plan (after Wang & Pang, Figs. 7 and 8).

use super::canvas::{Anchor, Canvas, Style};
use super::map_layers as layers;
use super::palette::{self, DETECTION, INK};
use super::panel::{Panel, range_of};
use crate::report::belief_track::{BeliefSnapshot, RobotBelief};
use crate::report::{RobotTrack, RunReport, TrackRow};
use robots::handoff::{Belief, BeliefGrid};
use world::math;

/// Largest panel, px.
const LARGEST: [f64; 2] = [560.0, 430.0];
const LEFT: f64 = 66.0;
const TOP: f64 = 62.0;
const GAP: [f64; 2] = [70.0, 78.0];
/// Probabilities shown: from the largest down to this many decades below it, in so many shades.
const DECADES: f64 = 4.0;
const SHADES: usize = 12;
/// Detections nearer to the last one drawn are left out, px.
const DOTS_APART_PX: f64 = 8.0;
/// Planned path.
const PLAN: &str = "#0072b2";

/// The maps of one robot as SVG.
pub(in super::super) fn belief(run: &RunReport<'_>, robot: &RobotBelief) -> String {
    let shown = chosen(robot);
    let (x, y) = bounds(run);
    let scale = (LARGEST[0] / (x[1] - x[0])).min(LARGEST[1] / (y[1] - y[0]));
    let (width, height) = ((x[1] - x[0]) * scale, (y[1] - y[0]) * scale);
    let columns = shown.len().clamp(1, 2);
    let rows = shown.len().div_ceil(2).max(1);
    let mut c = Canvas::new(
        LEFT + columns as f64 * (width.max(250.0) + GAP[0]),
        TOP + rows as f64 * (height + GAP[1]) + 30.0,
    );
    let title = format!(
        "{} · seed {} · {}: where the source may be",
        run.summary.scenario, run.summary.seed, robot.id
    );
    c.bold([LEFT, 24.0], 13.0, Anchor::Start, &title);
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
        let numbers = format!(
            "largest {:.3}, entropy {:.2} nat, 95 % in {:.0} {unit}",
            b.p[b.best], b.entropy_nat, b.credible_95
        );
        c.text(
            [panel.left, panel.bottom() + 36.0],
            10.0,
            Anchor::Start,
            &numbers,
        );
    }
    let bottom = c.height - 34.0;
    key(&mut c, [LEFT, bottom], robot.last.belief.grid.n[2] > 1);
    c.svg(&format!("belief{}", robot.id))
}

/// Before the first detection, after it, a third and two thirds of the way until the most probable cell came to its
/// last place, there, and at the end.
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
    let mut shown: Vec<_> = all
        .into_iter()
        .filter_map(|(words, s)| Some((words, s?)))
        .collect();
    shown.dedup_by_key(|(_, s)| s.belief.updates);
    shown
}

fn one(
    c: &mut Canvas,
    run: &RunReport<'_>,
    panel: &Panel,
    s: &BeliefSnapshot,
    track: Option<&RobotTrack>,
) {
    panel.clip(c);
    cells(c, panel, &s.belief);
    if let Some(plume) = &s.plume {
        // A dot is a stroke of no length with a round end: all of them one shape.
        let dots: Vec<_> = (plume.points.iter())
            .map(|[x, y, ..]| panel.at([f64::from(*x), f64::from(*y)]))
            .map(|p| vec![p, [p[0] + 0.05, p[1]]])
            .collect();
        c.lines(&dots, false, &Style::line("#333333", 1.3).faint(0.45));
    }
    let corners = run.area.corners().map(|p| [p.x, p.y]);
    c.polygon(panel.all(&corners), &Style::line(INK, 1.2).dashed("7 4"));
    for o in run.obstacles {
        let style = Style::fill("#8c6d4f").edged(INK, 1.0);
        c.polygon(panel.all(&o.corners), &style);
    }
    if let Some(t) = track {
        let rows: Vec<_> = t.rows.iter().filter(|r| r.t_s <= s.belief.t_s).collect();
        let line = rows.iter().map(|r| panel.at([r.p[0], r.p[1]])).collect();
        c.polyline(line, &Style::line("#ffffff", 3.0).faint(0.7));
        let line = rows.iter().map(|r| panel.at([r.p[0], r.p[1]])).collect();
        c.polyline(line, &Style::line(INK, 1.3));
        let smelt = |r: &&&TrackRow| r.reading.is_some_and(|v| Some(v) > t.info.threshold);
        let mut last: Option<[f64; 2]> = None;
        for r in rows.iter().filter(smelt) {
            let p = panel.at([r.p[0], r.p[1]]);
            if last.is_none_or(|q| (p[0] - q[0]).abs() + (p[1] - q[1]).abs() >= DOTS_APART_PX) {
                layers::detection(c, p);
                last = Some(p);
            }
        }
        if let Some(r) = rows.last() {
            c.circle(
                panel.at([r.p[0], r.p[1]]),
                4.0,
                &Style::fill(PLAN).edged("#ffffff", 1.2),
            );
        }
    }
    let plan: Vec<_> = s.planned.iter().map(|p| panel.at([p.x, p.y])).collect();
    c.polyline(plan, &Style::line(PLAN, 1.6).dashed("5 3"));
    layers::sources(c, panel, run);
    let best = s.belief.grid.centre(s.belief.best);
    best_cell(c, panel.at([best.x, best.y]));
    c.unclip();
    panel.frame(c, 1.0);
    panel.x_ticks(c, true, 10.0);
    panel.y_ticks(c, 50.0, 10.0);
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

/// The cells in shades of their probability, summed over the depth.
fn cells(c: &mut Canvas, panel: &Panel, b: &Belief) {
    let layer = b.grid.n[0] * b.grid.n[1];
    let mut plan = vec![0.0; layer];
    for (i, p) in b.p.iter().enumerate() {
        plan[i % layer] += p;
    }
    shades(c, panel, &b.grid, &plan);
}

/// A layer of cells in shades of a value's share of the largest; neighbours of one shade as one shape.
pub(super) fn shades(c: &mut Canvas, panel: &Panel, grid: &BeliefGrid, plan: &[f64]) {
    let [nx, ny, _] = grid.n;
    let most = plan.iter().fold(0.0, |m: f64, v| m.max(*v));
    let shade = |p: f64| {
        let share = 1.0 + math::ln((p / most).max(1e-30)) / (DECADES * std::f64::consts::LN_10);
        (share * SHADES as f64).ceil().clamp(0.0, SHADES as f64) as usize
    };
    let corner = |i: usize, j: usize| {
        let p = grid.world([i as f64 * grid.cell_m[0], j as f64 * grid.cell_m[1], 0.0]);
        panel.at([p.x, p.y])
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
                rings[s].push(vec![
                    corner(from, j),
                    corner(i, j),
                    corner(i, j + 1),
                    corner(from, j + 1),
                ]);
            }
        }
    }
    for (s, rings) in rings.iter().enumerate() {
        let colour = palette::likelihood(s as f64 / SHADES as f64);
        // Edged in its own colour, so that no light seams stand between the shapes.
        c.lines(rings, true, &Style::fill(&colour).edged(&colour, 0.4));
    }
}

/// The scale of shades after `words`, `from` on.
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

/// Shades, and what the signs mean.
fn key(c: &mut Canvas, [x, y]: [f64; 2], space: bool) {
    let words = if space {
        "Probability (summed over the depth), share of the largest:"
    } else {
        "Probability, share of the largest:"
    };
    scale(c, [x, y], words, x + if space { 330.0 } else { 195.0 });
    let y = y + 28.0;
    layers::true_source(c, [x + 6.0, y - 4.0]);
    c.text([x + 17.0, y], 10.0, Anchor::Start, "source");
    best_cell(c, [x + 80.0, y - 4.0]);
    c.text([x + 91.0, y], 10.0, Anchor::Start, "most probable");
    c.circle(
        [x + 186.0, y - 4.0],
        2.8,
        &Style::fill("#ffffff").edged(DETECTION, 0.8),
    );
    c.text([x + 194.0, y], 10.0, Anchor::Start, "detection");
    c.line(
        [x + 262.0, y - 4.0],
        [x + 288.0, y - 4.0],
        &Style::line(PLAN, 1.6).dashed("5 3"),
    );
    c.text([x + 293.0, y], 10.0, Anchor::Start, "planned path");
}

/// East and north ranges that hold the area.
pub(super) fn bounds(run: &RunReport<'_>) -> ([f64; 2], [f64; 2]) {
    let corners = run.area.corners();
    let along = |k: usize| range_of(corners.iter().map(|p| p[k]), 0.02).unwrap_or([-1.0, 1.0]);
    (along(0), along(1))
}
