//! The map's layers, from the bed up.

use super::canvas::{Anchor, Canvas, Style};
use super::map::Bed;
use super::palette::{self, BELIEVED, DECLARED, DETECTION, INK, TRUE_SOURCE};
use super::panel::{Panel, decade, nice_step, number, power_of_ten};
use super::plume_load::PlumeLoad;
use crate::report::{RobotTrack, RunReport};
use nalgebra::Vector2;

/// Opacity of the plume over the bed.
const PLUME_OPACITY: f64 = 0.6;
/// Points of a track nearer than this to the last one drawn are left out, px.
const APART_PX: f64 = 0.5;

/// Depth as shade.
pub(super) fn bed(c: &mut Canvas, panel: &Panel, bed: &Bed) {
    let base = (bed.range[0] / bed.step).floor() * bed.step;
    let level = if bed.levels.is_empty() {
        0.3
    } else {
        bed.shade(base)
    };
    let style = palette::depth(level);
    c.rect(
        panel.left,
        panel.top,
        panel.width,
        panel.height,
        &Style::fill(&style),
    );
    for &v in &bed.levels {
        let rings = on(panel, bed.grid.rings(v));
        c.lines(&rings, true, &Style::fill(&palette::depth(bed.shade(v))));
    }
}

/// Lines of equal depth with their depths.
pub(super) fn bed_lines(c: &mut Canvas, panel: &Panel, bed: &Bed) {
    for &v in &bed.levels {
        let lines = on(panel, bed.grid.lines(v));
        c.lines(&lines, false, &Style::line("#7893a8", 0.7));
        if let Some(longest) = lines.iter().max_by_key(|l| l.len()) {
            let [x, y] = longest[longest.len() / 12];
            let text = format!("{} m", number(v, bed.step));
            c.rimmed([x, y + 3.0], 9.0, Anchor::Middle, &text);
        }
    }
}

/// Chemical above the bed.
pub(super) fn plume(c: &mut Canvas, panel: &Panel, load: &PlumeLoad) {
    let n = load.levels.len();
    for (k, &v) in load.levels.iter().enumerate() {
        let rings = on(panel, load.grid.rings(v));
        let colour = palette::plume(k as f64 / (n - 1) as f64);
        c.lines(&rings, true, &Style::fill(&colour).faint(PLUME_OPACITY));
    }
}

fn on(panel: &Panel, lines: Vec<Vec<[f64; 2]>>) -> Vec<Vec<[f64; 2]>> {
    lines.iter().map(|l| panel.all(l)).collect()
}

/// Where the robot believed it was.
pub(super) fn believed(c: &mut Canvas, panel: &Panel, t: &RobotTrack) {
    let points = thinned(t.rows.iter().map(|r| panel.at(r.believed)));
    c.polyline(points, &Style::line(BELIEVED, 0.6).dashed("2 2"));
}

/// Where it truly was, coloured by what it did.
pub(super) fn track(c: &mut Canvas, panel: &Panel, t: &RobotTrack, close: bool) {
    let width = if close { 1.8 } else { 1.5 };
    let mut k = 0;
    while k < t.rows.len() {
        let b = t.rows[k].behaviour;
        let run = t.rows[k..].iter().take_while(|r| r.behaviour == b).count();
        // One point into the next stretch, so that the line has no gaps.
        let end = (k + run + 1).min(t.rows.len());
        let points = thinned(t.rows[k..end].iter().map(|r| panel.at([r.p[0], r.p[1]])));
        c.polyline(points, &Style::line(palette::behaviour(b), width));
        k += run;
    }
}

/// Points at least [`APART_PX`] apart, with the last.
pub(super) fn thinned(points: impl Iterator<Item = [f64; 2]>) -> Vec<[f64; 2]> {
    let mut kept: Vec<[f64; 2]> = Vec::new();
    let mut left_out = None;
    for p in points {
        let far = kept.last().is_none_or(|q| {
            let d = [p[0] - q[0], p[1] - q[1]];
            d[0] * d[0] + d[1] * d[1] >= APART_PX * APART_PX
        });
        if far {
            kept.push(p);
            left_out = None;
        } else {
            left_out = Some(p);
        }
    }
    kept.extend(left_out);
    kept
}

/// Detections: under the track, so that they do not hide what the robot did there.
pub(super) fn detections(c: &mut Canvas, panel: &Panel, t: &RobotTrack) {
    const DOTS_APART_PX: f64 = 3.0;
    let mut last: Option<[f64; 2]> = None;
    for d in &t.detections {
        let p = panel.at(*d);
        let apart = |q: [f64; 2]| (p[0] - q[0]).abs() + (p[1] - q[1]).abs();
        if last.is_none_or(|q| apart(q) >= DOTS_APART_PX) {
            detection(c, p);
            last = Some(p);
        }
    }
}

/// Start, lost points, declared source.
pub(super) fn marks(c: &mut Canvas, panel: &Panel, t: &RobotTrack, named: bool) {
    for l in &t.lost_points {
        lost_point(c, panel.at(*l));
    }
    if let Some(r) = t.rows.first() {
        let p = panel.at([r.p[0], r.p[1]]);
        start(c, p);
        if named {
            c.rimmed([p[0] + 8.0, p[1] + 4.0], 10.0, Anchor::Start, &t.info.id);
        }
    }
    let several = t.declarations.len() > 1;
    for (d, at) in t.declarations.iter().zip(t.declared()) {
        if let Some(e) = d.evidence {
            let [x, y] = e.middle_m;
            let ends = [panel.at([x, y]), panel.at([x + e.reach_m, y])];
            zone(c, ends[0], ends[1][0] - ends[0][0]);
        }
        let p = panel.at(at);
        declared(c, p);
        if several {
            let number = (d.number + 1).to_string();
            c.rimmed([p[0] - 9.0, p[1] - 7.0], 10.0, Anchor::End, &number);
        }
    }
}

/// Line of a subregion's edge.
pub(super) fn region_line() -> Style<'static> {
    Style::line(INK, 1.0).dashed("3 3")
}

/// Outlines of subregions, with the number in the order of search and how the search ended.
pub(super) fn regions(c: &mut Canvas, panel: &Panel, t: &RobotTrack, named: bool) {
    for (k, region) in t.regions.iter().enumerate() {
        let corners = region.area.corners().map(|p| panel.at([p.x, p.y]));
        for (i, a) in corners.iter().enumerate() {
            // From left to right, so that the dashes of an edge that two regions share fall on each other.
            let mut ends = [*a, corners[(i + 1) % corners.len()]];
            ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
            c.line(ends[0], ends[1], &region_line());
        }
        // Towards the middle of the right edge, where tracks are rarer than in the middle.
        let at = Vector2::new(0.0, 0.32 * region.area.width_m);
        let p = region.area.world(at);
        if named {
            let words = region.state.name().replace('_', " ");
            let text = format!("{} {words}", k + 1);
            c.rimmed(panel.at([p.x, p.y]), 9.5, Anchor::Middle, &text);
        }
    }
}

pub(super) fn detection(c: &mut Canvas, p: [f64; 2]) {
    c.circle(p, 2.8, &Style::fill("#ffffff").edged(DETECTION, 0.8));
}

pub(super) fn lost_point(c: &mut Canvas, [x, y]: [f64; 2]) {
    const R: f64 = 4.0;
    let arms = [
        vec![[x - R, y - R], [x + R, y + R]],
        vec![[x - R, y + R], [x + R, y - R]],
    ];
    c.lines(&arms, false, &Style::line("#ffffff", 3.4));
    c.lines(&arms, false, &Style::line(INK, 1.6));
}

pub(super) fn start(c: &mut Canvas, [x, y]: [f64; 2]) {
    c.rect(
        x - 4.5,
        y - 4.5,
        9.0,
        9.0,
        &Style::fill("#ffffff").edged(INK, 1.6),
    );
}

pub(super) fn declared(c: &mut Canvas, [x, y]: [f64; 2]) {
    const R: f64 = 7.0;
    let diamond = vec![[x, y - R], [x + R, y], [x, y + R], [x - R, y]];
    c.polygon(diamond, &Style::fill(DECLARED).edged(INK, 1.4));
}

/// Of the points that a declaration rests on.
pub(super) fn zone(c: &mut Canvas, p: [f64; 2], r: f64) {
    c.circle(p, r, &Style::line("#ffffff", 3.2));
    c.circle(p, r, &Style::line(INK, 1.4));
}

pub(super) fn true_source(c: &mut Canvas, p: [f64; 2]) {
    c.circle(p, 6.5, &Style::line("#ffffff", 4.0));
    c.circle(p, 6.5, &Style::line(INK, 1.8));
    c.circle(p, 2.0, &Style::fill(INK).edged(TRUE_SOURCE, 0.8));
}

/// True sources with the flow there; declared ones are drawn with their robot.
pub(super) fn sources(c: &mut Canvas, panel: &Panel, run: &RunReport<'_>) {
    for s in run.sources {
        let p = panel.at([s.position.x, s.position.y]);
        true_source(c, p);
        if run.sources.len() > 1 {
            c.rimmed([p[0] + 10.0, p[1] - 6.0], 10.0, Anchor::Start, &s.id);
        }
    }
}

/// A bar of round length, bottom left.
pub(super) fn scale_bar(c: &mut Canvas, panel: &Panel, unit: &str) {
    let wanted = (panel.x[1] - panel.x[0]) / 4.0;
    let base = power_of_ten(decade(wanted));
    let length = [5.0, 2.0, 1.0]
        .map(|t| t * base)
        .into_iter()
        .find(|l| *l <= wanted * 1.001)
        .unwrap_or(base);
    let px = length * panel.px_per_unit();
    let (x, y) = (panel.left + 14.0, panel.bottom() - 14.0);
    let back = Style {
        fill_opacity: Some(0.8),
        ..Style::fill("#ffffff")
    };
    c.rect(x - 7.0, y - 19.0, px + 14.0, 26.0, &back);
    let ends = vec![[x, y - 4.0], [x, y], [x + px, y], [x + px, y - 4.0]];
    c.polyline(ends, &Style::line(INK, 1.5));
    let text = format!("{} {unit}", number(length, nice_step(length, 1.0)));
    c.text([x + px / 2.0, y - 6.0], 10.0, Anchor::Middle, &text);
}

/// North arrow, top right.
pub(super) fn north(c: &mut Canvas, panel: &Panel) {
    let (x, y) = (panel.right() - 20.0, panel.top + 54.0);
    let back = Style {
        fill_opacity: Some(0.8),
        ..Style::fill("#ffffff")
    };
    c.rect(x - 13.0, panel.top + 7.0, 26.0, 53.0, &back);
    c.bold([x, panel.top + 20.0], 11.0, Anchor::Middle, "N");
    c.arrow([x, y], [x, panel.top + 24.0], INK, 2.0);
}
