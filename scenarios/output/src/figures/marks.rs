//! The map's layers, from the bed up.

use super::vehicles::{AFTER, over_from};
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::contours::Grid;
use crate::charts::label_box::LabelBox;
use crate::charts::palette::{self, BELIEVED, DECLARED, DETECTION, INK, TRUE_SOURCE};
use crate::charts::panel::{Panel, decade, nice_step, number, power_of_ten, range_of};
use crate::figures::plume_load::PlumeLoad;
use crate::figures::thinned::{stretches, thinned};
use crate::results::{RobotTrack, RunReport, TrackRow};
use nalgebra::Vector2;
use robots::handoff::region_name;

/// Opacity of the plume over the bed.
const PLUME_OPACITY: f64 = 0.6;

/// Nodes of the bed's grid along each side.
const BED_NODES: usize = 90;

/// Depths over a panel.
pub(super) struct Bed {
    pub(super) grid: Grid,
    /// Depths at which the shade changes, and depths drawn as lines.
    pub(super) levels: Vec<f64>,
    pub(super) range: [f64; 2],
    pub(super) step: f64,
}

impl Bed {
    pub(super) fn from_run(run: &RunReport<'_>, panel: &Panel) -> Self {
        let n = [BED_NODES, BED_NODES];
        let depth = |x, y| (-run.terrain.bed_z(x, y)).max(0.0);
        let grid = Grid::evaluate(panel.x, panel.y, n, depth);
        let range = range_of(grid.values.iter().copied(), 0.0).unwrap_or([0.0, 1.0]);
        let step = nice_step(range[1] - range[0], 5.0);
        let level = range[1] - range[0] < 0.02 * range[1].max(1e-3);
        let levels = if level {
            Vec::new()
        } else {
            let first = (range[0] / step).floor() as i64 + 1;
            let last = ((range[1] - 1e-9) / step).floor() as i64;
            (first..=last).map(|k| k as f64 * step).collect()
        };
        Self { grid, levels, range, step }
    }

    /// Position in the ramp of shades for the band that begins at a depth.
    pub(super) fn shade(&self, depth: f64) -> f64 {
        (depth + 0.5 * self.step - self.range[0]) / (self.range[1] - self.range[0]).max(1e-9)
    }
}

/// Depth as shade.
pub(super) fn bed(c: &mut Canvas, panel: &Panel, bed: &Bed) {
    let base = (bed.range[0] / bed.step).floor() * bed.step;
    let level = if bed.levels.is_empty() { 0.3 } else { bed.shade(base) };
    let style = palette::depth(level);
    c.rect(panel.left, panel.top, panel.width, panel.height, &Style::fill(&style));
    for &v in &bed.levels {
        let rings = panel.lines(&bed.grid.rings(v));
        c.lines(&rings, true, &Style::fill(&palette::depth(bed.shade(v))));
    }
}

/// Lines of equal depth with their depths.
pub(super) fn bed_lines(c: &mut Canvas, panel: &Panel, bed: &Bed) {
    for &v in &bed.levels {
        let lines = panel.lines(&bed.grid.lines(v));
        c.lines(&lines, false, &Style::line("#7893a8", 0.7));
    }
}

/// Labels with the depths of these lines, where nothing else is drawn.
pub(super) fn bed_labels(c: &mut Canvas, panel: &Panel, bed: &Bed) {
    const PLACES: usize = 12;
    for &v in &bed.levels {
        let lines = panel.lines(&bed.grid.lines(v));
        if let Some(longest) = lines.iter().max_by_key(|l| l.len()) {
            let places: Vec<_> = (1..PLACES)
                .map(|k| longest[k * longest.len() / PLACES])
                .map(|[x, y]| ([x, y + 3.0], Anchor::Middle))
                .collect();
            let text = format!("{} m", number(v, bed.step));
            panel.label_at(c, &places, 9.0, &text, true);
        }
    }
}

/// Chemical above the bed.
pub(super) fn plume(c: &mut Canvas, panel: &Panel, load: &PlumeLoad) {
    let n = load.levels.len();
    for (k, &v) in load.levels.iter().enumerate() {
        let rings = panel.lines(&load.grid.rings(v));
        let colour = palette::plume(k as f64 / (n - 1) as f64);
        c.lines(&rings, true, &Style::fill(&colour).faint(PLUME_OPACITY));
    }
}

/// The believed track. Among several vehicles, it is faint after the end of its mission.
pub(super) fn believed(c: &mut Canvas, panel: &Panel, t: &RobotTrack, several: bool) {
    let over = if several { over_from(t) } else { t.rows.len() };
    let style = || Style::line(BELIEVED, 0.6).dashed("2 2");
    let points = |rows: &[TrackRow]| thinned(rows.iter().map(|r| panel.position(r.believed)));
    c.polyline(points(&t.rows[..over]), &style());
    if over < t.rows.len() {
        c.polyline(points(&t.rows[over..]), &style().faint(AFTER));
    }
}

/// The true track, coloured by behaviour. Among several vehicles, it is faint after the end of its mission.
pub(super) fn track(c: &mut Canvas, panel: &Panel, t: &RobotTrack, close: bool, several: bool) {
    let width = match (several, close) {
        // A band in the vehicle's colour is to be seen on both sides.
        (true, _) => 1.1,
        (false, true) => 2.2,
        (false, false) => 1.9,
    };
    let over = if several { over_from(t) } else { t.rows.len() };
    for (begin, rows) in stretches(&t.rows, |r| r.behaviour) {
        let points = thinned(rows.iter().map(|r| panel.position([r.p[0], r.p[1]])));
        let style = Style::line(palette::behaviour(rows[0].behaviour), width);
        c.polyline(points, &if begin < over { style } else { style.faint(AFTER) });
    }
}

/// Detections: open rings under the track, apart from each other, so that they do not hide the track.
pub(super) fn detections(c: &mut Canvas, panel: &Panel, places: impl Iterator<Item = [f64; 2]>) {
    const APART_PX: f64 = 8.0;
    let mut last: Option<[f64; 2]> = None;
    for d in places {
        let p = panel.position(d);
        let apart = |q: [f64; 2]| (p[0] - q[0]).abs() + (p[1] - q[1]).abs();
        if last.is_none_or(|q| apart(q) >= APART_PX) {
            detection(c, p);
            last = Some(p);
        }
    }
}

/// Start, lost points, declared sources, and plumes at an edge.
pub(super) fn marks(c: &mut Canvas, panel: &Panel, t: &RobotTrack) {
    for l in &t.lost_points {
        lost_point(c, panel.position(*l));
    }
    if let Some(r) = t.rows.first() {
        let p = panel.position([r.p[0], r.p[1]]);
        start(c, p);
        c.keep_free(LabelBox::round(p, 6.0));
    }
    for (d, at) in t.declarations.iter().zip(t.declared()) {
        let p = panel.position(at);
        c.keep_free(LabelBox::round(p, 8.0));
        if d.at_edge() {
            plume_at_edge(c, p);
            continue;
        }
        if let Some(e) = d.evidence {
            let [x, y] = e.middle_m;
            let ends = [panel.position([x, y]), panel.position([x + e.reach_m, y])];
            zone(c, ends[0], ends[1][0] - ends[0][0]);
        }
        declared(c, p);
    }
}

/// Line of a subregion's edge.
pub(super) fn region_line() -> Style<'static> {
    Style::line(INK, 1.0).dashed("3 3")
}

/// Outlines of subregions.
pub(super) fn regions(c: &mut Canvas, panel: &Panel, t: &RobotTrack) {
    for region in t.regions.iter() {
        let corners = region.area.corners().map(|p| panel.position([p.x, p.y]));
        for (i, a) in corners.iter().enumerate() {
            // From left to right, so that the dashes of an edge that two regions share coincide.
            let mut ends = [*a, corners[(i + 1) % corners.len()]];
            ends.sort_by(|a, b| a[0].total_cmp(&b[0]));
            c.line(ends[0], ends[1], &region_line());
        }
    }
}

/// Names, after all marks: a robot's subregions and how their search ended, its start, and its declarations.
pub(super) fn names(c: &mut Canvas, panel: &Panel, t: &RobotTrack, several_robots: bool) {
    for (region, k) in t.regions.iter().zip(0..) {
        // Towards the middle of the right edge, where tracks are rarer than in the middle; then anywhere.
        let shares = [0.0, 0.1, -0.1, 0.2, -0.2, 0.3, -0.3, 0.4, -0.4];
        let places: Vec<_> = [0.32, 0.25, 0.15, 0.0, -0.15, -0.25, -0.32]
            .into_iter()
            .flat_map(|across| shares.map(|along| [along, across]))
            .map(|[l, w]| Vector2::new(l * region.area.length_m, w * region.area.width_m))
            .map(|at| region.area.world(at))
            .map(|p| (panel.position([p.x, p.y]), Anchor::Middle))
            .collect();
        let text = format!("{}: {}", region_name(k), region.state.label());
        panel.label_at(c, &places, 9.5, &text, false);
    }
    if let Some(r) = t.rows.first().filter(|_| several_robots) {
        beside(c, panel, [r.p[0], r.p[1]], &t.info.id);
    }
    let several = t.declared_inside().count() > 1;
    for (at, k) in t.declared_inside().zip(1..).filter(|_| several) {
        beside(c, panel, at, &format!("source {k}"));
    }
}

/// A name beside a mark, on any side with room.
fn beside(c: &mut Canvas, panel: &Panel, at: [f64; 2], name: &str) {
    const SIZE: f64 = 10.0;
    let [x, y] = panel.position(at);
    let places: Vec<_> = [9.0, 14.0, 22.0, 34.0]
        .into_iter()
        .flat_map(|r| {
            [
                ([x + r, y - 0.5 * r], Anchor::Start),
                ([x - r, y - 0.5 * r], Anchor::End),
                ([x + r, y + 0.5 * r + 7.0], Anchor::Start),
                ([x - r, y + 0.5 * r + 7.0], Anchor::End),
                ([x, y - r - 1.0], Anchor::Middle),
                ([x, y + r + 8.0], Anchor::Middle),
            ]
        })
        .collect();
    panel.label_at(c, &places, SIZE, name, false);
}

pub(super) fn detection(c: &mut Canvas, p: [f64; 2]) {
    c.circle(p, 2.8, &Style::line(DETECTION, 0.7));
}

pub(super) fn lost_point(c: &mut Canvas, [x, y]: [f64; 2]) {
    const R: f64 = 4.0;
    let arms = [vec![[x - R, y - R], [x + R, y + R]], vec![[x - R, y + R], [x + R, y - R]]];
    c.lines(&arms, false, &Style::line("#ffffff", 3.4));
    c.lines(&arms, false, &Style::line(INK, 1.6));
}

pub(super) fn start(c: &mut Canvas, [x, y]: [f64; 2]) {
    c.rect(x - 4.5, y - 4.5, 9.0, 9.0, &Style::fill("#ffffff").edged(INK, 1.6));
}

pub(super) fn declared(c: &mut Canvas, [x, y]: [f64; 2]) {
    const R: f64 = 7.0;
    let diamond = vec![[x, y - R], [x + R, y], [x, y + R], [x - R, y]];
    c.polygon(diamond, &Style::fill(DECLARED).edged(INK, 1.4));
}

/// The place where a plume was traced over the up-flow edge of a subregion.
pub(super) fn plume_at_edge(c: &mut Canvas, [x, y]: [f64; 2]) {
    const R: f64 = 6.0;
    let triangle = vec![[x, y - R], [x + R, y + 0.8 * R], [x - R, y + 0.8 * R]];
    c.polygon(triangle, &Style::fill("#ffffff").edged(INK, 1.4));
}

/// A ring round the points on which a declaration rests.
pub(super) fn zone(c: &mut Canvas, p: [f64; 2], r: f64) {
    c.circle(p, r, &Style::line("#ffffff", 3.2));
    c.circle(p, r, &Style::line(INK, 1.4));
}

pub(super) fn true_source(c: &mut Canvas, p: [f64; 2]) {
    c.circle(p, 6.5, &Style::line("#ffffff", 4.0));
    c.circle(p, 6.5, &Style::line(INK, 1.8));
    c.circle(p, 2.0, &Style::fill(INK).edged(TRUE_SOURCE, 0.8));
}

/// True sources. Declared ones are drawn with their robot.
pub(super) fn sources(c: &mut Canvas, panel: &Panel, run: &RunReport<'_>) {
    for s in run.sources {
        let p = panel.position([s.position.x, s.position.y]);
        true_source(c, p);
        c.keep_free(LabelBox::round(p, 9.0));
    }
}

/// Names of the true sources, if there are several.
pub(super) fn source_names(c: &mut Canvas, panel: &Panel, run: &RunReport<'_>) {
    for s in run.sources.iter().filter(|_| run.sources.len() > 1) {
        beside(c, panel, [s.position.x, s.position.y], &s.id);
    }
}

/// Keeps names away from the scale bar and the north arrow, which are drawn last.
pub(super) fn reserve(c: &mut Canvas, panel: &Panel) {
    let (_, px) = scale_length(panel);
    let (x, y) = (panel.left + 14.0, panel.bottom() - 14.0);
    c.keep_free(LabelBox { left: x - 7.0, top: y - 19.0, right: x + px + 7.0, bottom: y + 7.0 });
    let x = panel.right() - 20.0;
    c.keep_free(LabelBox { left: x - 13.0, top: panel.top + 7.0, right: x + 13.0, bottom: panel.top + 60.0 });
}

/// Length of the scale bar, in units of the panel and in px.
fn scale_length(panel: &Panel) -> (f64, f64) {
    let wanted = (panel.x[1] - panel.x[0]) / 4.0;
    let base = power_of_ten(decade(wanted));
    let length = [5.0, 2.0, 1.0].map(|t| t * base).into_iter().find(|l| *l <= wanted * 1.001).unwrap_or(base);
    (length, length * panel.px_per_unit())
}

/// A scale bar of round length, bottom left.
pub(super) fn scale_bar(c: &mut Canvas, panel: &Panel, unit: &str) {
    let (length, px) = scale_length(panel);
    let (x, y) = (panel.left + 14.0, panel.bottom() - 14.0);
    let back = Style { fill_opacity: Some(0.8), ..Style::fill("#ffffff") };
    c.rect(x - 7.0, y - 19.0, px + 14.0, 26.0, &back);
    let ends = vec![[x, y - 4.0], [x, y], [x + px, y], [x + px, y - 4.0]];
    c.polyline(ends, &Style::line(INK, 1.5));
    let text = format!("{} {unit}", number(length, nice_step(length, 1.0)));
    c.text([x + px / 2.0, y - 6.0], 10.0, Anchor::Middle, &text);
}

/// North arrow, top right.
pub(super) fn north(c: &mut Canvas, panel: &Panel) {
    let (x, y) = (panel.right() - 20.0, panel.top + 54.0);
    let back = Style { fill_opacity: Some(0.8), ..Style::fill("#ffffff") };
    c.rect(x - 13.0, panel.top + 7.0, 26.0, 53.0, &back);
    c.bold([x, panel.top + 20.0], 11.0, Anchor::Middle, "N");
    c.arrow([x, y], [x, panel.top + 24.0], INK, 2.0);
}
