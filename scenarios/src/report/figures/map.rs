//! The map: area, bed, plume, track by behaviour, what was found where (after Pang 2009, Fig. 7).

use super::canvas::{Anchor, Canvas, Style};
use super::contours::Grid;
use super::map_layers as layers;
use super::map_legend::legend;
use super::palette::{GREY, INK};
use super::panel::{Panel, nice_step, range_of};
use super::plume_load::PlumeLoad;
use crate::report::{RobotTrack, RunReport, SourceTruth};
use nalgebra::Vector2;

/// Largest and least size of the map's panel, px.
const LARGEST: [f64; 2] = [660.0, 840.0];
const LEAST: [f64; 2] = [420.0, 200.0];
/// Margin round what the map must show, share of its size.
const MARGIN: f64 = 0.04;
/// Width of the column of keys and least height of the sheet, px.
const COLUMN: f64 = 270.0;
const LEAST_SHEET: f64 = 640.0;
/// Nodes of the bed's grid along each side.
const BED_NODES: usize = 90;

/// The map as SVG.
pub(in super::super) fn map(run: &RunReport<'_>) -> String {
    let (x, y) = bounds(run);
    let panel = place(x, y);
    let sheet = (panel.bottom() + 60.0).max(LEAST_SHEET);
    let mut c = Canvas::new(panel.right() + COLUMN, sheet);
    let plume = run.plume.and_then(|p| PlumeLoad::of(p, &panel));
    let bed = Bed::of(run, &panel);
    draw(&mut c, run, &panel, &bed, plume.as_ref(), false);
    panel.frame(&mut c, 1.2);
    panel.x_ticks(&mut c, true, 11.0);
    panel.y_ticks(&mut c, 45.0, 11.0);
    let middle = panel.left + panel.width / 2.0;
    c.text(
        [middle, panel.bottom() + 40.0],
        12.0,
        Anchor::Middle,
        "East (m)",
    );
    c.upright([22.0, panel.top + panel.height / 2.0], 12.0, "North (m)");
    let title = format!("{} · seed {}", run.summary.scenario, run.summary.seed);
    c.bold([panel.left, 24.0], 13.0, Anchor::Start, &title);
    layers::scale_bar(&mut c, &panel, "m");
    layers::north(&mut c, &panel);
    let left = panel.right() + 22.0;
    let mut below = legend(&mut c, run, [left, panel.top], &bed, plume.as_ref());
    if let Some(inset) = inset(run, [left, below + 26.0], sheet) {
        draw(&mut c, run, &inset, &Bed::of(run, &inset), None, true);
        inset.frame(&mut c, 1.0);
        c.text(
            [left, inset.top - 7.0],
            10.0,
            Anchor::Start,
            "Near the source (box on the map)",
        );
        layers::scale_bar(&mut c, &inset, "m");
        let (a, b) = (
            panel.at([inset.x[0], inset.y[1]]),
            panel.at([inset.x[1], inset.y[0]]),
        );
        let box_style = Style::line(GREY, 1.0);
        panel.clip(&mut c);
        c.rect(a[0], a[1], b[0] - a[0], b[1] - a[1], &box_style);
        c.unclip();
        below = inset.bottom();
    }
    // The column may end above the room that was kept for it.
    c.height = (panel.bottom() + 60.0).max(below + 20.0);
    c.svg("map")
}

/// Depths over a panel.
pub(super) struct Bed {
    pub(super) grid: Grid,
    /// Depths at which the shade changes, and those drawn as lines.
    pub(super) levels: Vec<f64>,
    pub(super) range: [f64; 2],
    pub(super) step: f64,
}

impl Bed {
    fn of(run: &RunReport<'_>, panel: &Panel) -> Self {
        let n = [BED_NODES, BED_NODES];
        let depth = |x, y| (-run.terrain.bed_z(x, y)).max(0.0);
        let grid = Grid::of(panel.x, panel.y, n, depth);
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
        Self {
            grid,
            levels,
            range,
            step,
        }
    }

    /// Share of the shade's ramp for the band beginning at a depth.
    pub(super) fn shade(&self, depth: f64) -> f64 {
        (depth + 0.5 * self.step - self.range[0]) / (self.range[1] - self.range[0]).max(1e-9)
    }
}

fn draw(
    c: &mut Canvas,
    run: &RunReport<'_>,
    panel: &Panel,
    bed: &Bed,
    plume: Option<&PlumeLoad>,
    close: bool,
) {
    panel.clip(c);
    layers::bed(c, panel, bed);
    let own = if close {
        run.plume.and_then(|p| PlumeLoad::of(p, panel))
    } else {
        None
    };
    if let Some(plume) = plume.or(own.as_ref()) {
        layers::plume(c, panel, plume);
    }
    layers::bed_lines(c, panel, bed);
    let corners = run.area.corners().map(|p| [p.x, p.y]);
    c.polygon(panel.all(&corners), &Style::line(INK, 1.6).dashed("7 4"));
    for o in run.obstacles {
        let style = Style::fill("#8c6d4f").edged(INK, 1.0);
        c.polygon(panel.all(&o.corners), &style);
    }
    for t in &run.track.robots {
        layers::believed(c, panel, t);
        layers::detections(c, panel, t);
        layers::track(c, panel, t, close);
        layers::regions(c, panel, t, !close);
        layers::marks(c, panel, t, run.track.robots.len() > 1 && !close);
    }
    layers::sources(c, panel, run);
    c.unclip();
}

/// East and north ranges that hold the area and all that happened.
fn bounds(run: &RunReport<'_>) -> ([f64; 2], [f64; 2]) {
    let corners = run.area.corners();
    let mut points: Vec<[f64; 2]> = corners.iter().map(|p| [p.x, p.y]).collect();
    points.extend(run.sources.iter().map(|s| [s.position.x, s.position.y]));
    for t in &run.track.robots {
        points.extend(t.rows.iter().map(|r| [r.p[0], r.p[1]]));
        points.extend(t.declared());
    }
    let along = |k: usize| range_of(points.iter().map(|p| p[k]), MARGIN).unwrap_or([-1.0, 1.0]);
    (along(0), along(1))
}

/// A panel with one scale both ways, within its limits of size.
fn place(mut x: [f64; 2], mut y: [f64; 2]) -> Panel {
    let (dx, dy) = (x[1] - x[0], y[1] - y[0]);
    let scale = (LARGEST[0] / dx).min(LARGEST[1] / dy);
    let (width, height) = ((dx * scale).max(LEAST[0]), (dy * scale).max(LEAST[1]));
    for (range, size) in [(&mut x, width), (&mut y, height)] {
        let more = 0.5 * (size / scale - (range[1] - range[0]));
        *range = [range[0] - more, range[1] + more];
    }
    Panel {
        left: 74.0,
        top: 40.0,
        width,
        height,
        x,
        y,
    }
}

/// A closer look at the declared source, if one was declared and the column has room.
fn inset(run: &RunReport<'_>, [left, top]: [f64; 2], sheet: f64) -> Option<Panel> {
    let size = (COLUMN - 45.0).min(sheet - top - 24.0);
    if size < 120.0 {
        return None;
    }
    // The one that is nearest to a true source; what is declared on a subregion's edge has its source elsewhere.
    let away = |d: &SourceAt| {
        let of = |s: &SourceTruth| (s.position.xy() - Vector2::new(d[0], d[1])).norm();
        run.sources.iter().map(of).fold(f64::INFINITY, f64::min)
    };
    let all = run
        .track
        .robots
        .iter()
        .flat_map(RobotTrack::declared_inside);
    let declared = all.min_by(|a, b| away(a).total_cmp(&away(b)))?;
    let near = |p: &SourceAt| {
        let d = [p[0] - declared[0], p[1] - declared[1]];
        d[0] * d[0] + d[1] * d[1]
    };
    let source = run
        .sources
        .iter()
        .map(|s| [s.position.x, s.position.y])
        .min_by(|a, b| near(a).total_cmp(&near(b)))
        .unwrap_or(declared);
    let apart = near(&source).sqrt();
    // Half the width shown: room for the last bowties, never more than a quarter of the area.
    let half = (1.2 * apart)
        .max(60.0)
        .min(0.25 * run.area.length_m)
        .max(0.75 * apart);
    let m = [
        0.5 * (declared[0] + source[0]),
        0.5 * (declared[1] + source[1]),
    ];
    Some(Panel {
        left,
        top,
        width: size,
        height: size,
        x: [m[0] - half, m[0] + half],
        y: [m[1] - half, m[1] + half],
    })
}

type SourceAt = [f64; 2];
