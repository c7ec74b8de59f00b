//! The map: area, bed, plume, track by behaviour, and what was found where (after Pang 2009, Fig. 7).

pub(super) mod legend;
mod section;
pub(super) mod small_maps;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod tests_vehicles;

use super::marks::{self, Bed};
use super::plume_load::PlumeLoad;
use super::{solids, vehicles};
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::palette::{GREY, INK};
use crate::charts::panel::{Panel, range_of};
use crate::results::{RobotTrack, RunReport, SourceTruth};
use legend::keys;
use nalgebra::Vector2;

/// Largest size of the map's panel with keys beside it and with keys below it, px.
const LARGEST_TALL: [f64; 2] = [660.0, 840.0];
const LARGEST_WIDE: [f64; 2] = [900.0, 720.0];
const LEAST: [f64; 2] = [420.0, 120.0];
/// Maps wider than this (width over height) have their keys below.
const WIDE: f64 = 1.25;
/// Margin round the content of the map, as a share of its size.
const MARGIN: f64 = 0.04;
/// Width of a column of keys, px.
const COLUMN: f64 = 235.0;
/// Height that keys beside a map may always use, px.
const LEAST_SHEET: f64 = 640.0;
/// Smallest and preferred enlargement of the inset: its scale divided by the map's.
const ENLARGED: [f64; 2] = [1.5, 2.5];
/// Largest and least inset, px.
const INSET: [f64; 2] = [225.0, 120.0];

/// The map as SVG.
pub fn map(run: &RunReport<'_>) -> String {
    sheet(run).svg("map")
}

/// The whole sheet: the map, a vertical section below it where that shows more, and keys beside or below them.
pub(super) fn sheet(run: &RunReport<'_>) -> Canvas {
    let (x, y) = bounds(run);
    let wide = x[1] - x[0] > WIDE * (y[1] - y[0]);
    let panel = place(x, y, wide);
    let mut c = Canvas::new(panel.right() + if wide { 34.0 } else { COLUMN + 35.0 }, 0.0);
    let plume = run.plume.and_then(|p| PlumeLoad::from_plume(p, &panel));
    let bed = Bed::from_run(run, &panel);
    marks::reserve(&mut c, &panel);
    draw(&mut c, run, &panel, &bed, plume.as_ref(), false);
    panel.frame(&mut c, 1.2);
    panel.x_ticks(&mut c, true, 11.0);
    panel.y_ticks(&mut c, 45.0, 11.0);
    panel.names(&mut c, 12.0, ["East (m)", "North (m)"], [36.0, panel.left - 22.0]);
    let title = run.summary.headline();
    c.bold([panel.left, 24.0], 13.0, Anchor::Start, &title);
    marks::scale_bar(&mut c, &panel, "m");
    marks::north(&mut c, &panel);
    let mut bottom = panel.bottom() + 50.0;
    if let Some(below) = section::draw(&mut c, run, &panel, bottom + 34.0) {
        bottom = below;
    }
    // Keys and inset: in a column beside the map, or in a row below it.
    let blocks = keys(run, &bed, plume.as_ref());
    let (mut at, mut end) =
        if wide { ([panel.left, bottom + 22.0], bottom) } else { ([panel.right() + 22.0, panel.top], panel.top) };
    for block in &blocks {
        let below = block(&mut c, at);
        end = end.max(below);
        if wide {
            at[0] += COLUMN;
        } else {
            at[1] = below;
        }
    }
    let room = if wide {
        INSET[0].min(panel.right() - at[0])
    } else {
        at[1] += 26.0;
        INSET[0].min(bottom.max(LEAST_SHEET) - at[1] - 24.0)
    };
    at[1] += if wide { 14.0 } else { 0.0 };
    if let Some(inset) = inset(run, &panel, at, room) {
        closer(&mut c, run, &panel, &inset);
        end = end.max(inset.bottom());
    }
    c.height = bottom.max(end + 20.0);
    c
}

/// Draws the inset, and its frame on the map.
fn closer(c: &mut Canvas, run: &RunReport<'_>, panel: &Panel, inset: &Panel) {
    draw(c, run, inset, &Bed::from_run(run, inset), None, true);
    inset.frame(c, 1.0);
    let times = inset.px_per_unit() / panel.px_per_unit();
    let words = format!("Near the source (box on the map), {times:.1} ×");
    c.text([inset.left, inset.top - 7.0], 10.0, Anchor::Start, &words);
    marks::scale_bar(c, inset, "m");
    let (a, b) = (panel.position([inset.x[0], inset.y[1]]), panel.position([inset.x[1], inset.y[0]]));
    panel.clip(c);
    c.rect(a[0], a[1], b[0] - a[0], b[1] - a[1], &Style::line(GREY, 1.0));
    c.unclip();
}

fn draw(c: &mut Canvas, run: &RunReport<'_>, panel: &Panel, bed: &Bed, plume: Option<&PlumeLoad>, close: bool) {
    panel.clip(c);
    marks::bed(c, panel, bed);
    let own = if close { run.plume.and_then(|p| PlumeLoad::from_plume(p, panel)) } else { None };
    solids::draw(c, panel, run.obstacles, run.terrain, true);
    if let Some(plume) = plume.or(own.as_ref()) {
        marks::plume(c, panel, plume);
    }
    marks::bed_lines(c, panel, bed);
    let corners = run.area.corners().map(|p| [p.x, p.y]);
    c.polygon(panel.all(&corners), &Style::line(INK, 1.6).dashed("7 4"));
    solids::draw(c, panel, run.obstacles, run.terrain, false);
    let robots = &run.track.robots;
    let several = robots.len() > 1;
    for (k, t) in robots.iter().enumerate().filter(|_| several) {
        vehicles::band(c, panel, t, k);
    }
    for t in robots {
        marks::regions(c, panel, t);
        marks::believed(c, panel, t, several);
        marks::detections(c, panel, t.detections.iter().copied());
        marks::track(c, panel, t, close, several);
        marks::marks(c, panel, t);
    }
    marks::sources(c, panel, run);
    // Names last, where nothing else is drawn; the inset needs none.
    if !close {
        marks::source_names(c, panel, run);
        for t in robots {
            marks::names(c, panel, t, several);
        }
        marks::bed_labels(c, panel, bed);
    }
    c.unclip();
}

/// East and north ranges that contain the area and everything that happened.
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

/// A panel with the same scale in both directions, within its limits of size.
fn place(mut x: [f64; 2], mut y: [f64; 2], wide: bool) -> Panel {
    let (dx, dy) = (x[1] - x[0], y[1] - y[0]);
    let largest = if wide { LARGEST_WIDE } else { LARGEST_TALL };
    let scale = (largest[0] / dx).min(largest[1] / dy);
    let (width, height) = ((dx * scale).max(LEAST[0]), (dy * scale).max(LEAST[1]));
    for (range, size) in [(&mut x, width), (&mut y, height)] {
        let more = 0.5 * (size / scale - (range[1] - range[0]));
        *range = [range[0] - more, range[1] + more];
    }
    Panel { left: 74.0, top: 40.0, width, height, x, y }
}

/// An enlarged view of the declared source, if one was declared, if there is room, and if the view is really enlarged.
pub(super) fn inset(run: &RunReport<'_>, map: &Panel, [left, top]: [f64; 2], size: f64) -> Option<Panel> {
    if size < INSET[1] {
        return None;
    }
    // The declaration nearest to a true source; for one on a subregion's edge, the source is elsewhere.
    let away = |d: &SourceAt| {
        let of = |s: &SourceTruth| (s.position.xy() - Vector2::new(d[0], d[1])).norm();
        run.sources.iter().map(of).fold(f64::INFINITY, f64::min)
    };
    let all = run.track.robots.iter().flat_map(RobotTrack::declared_inside);
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
    // Half of the width shown: room for the last bowties, at most a quarter of the area.
    let half = (1.2 * apart)
        .max(60.0)
        .min(0.25 * run.area.length_m)
        .min(size / (2.0 * ENLARGED[1] * map.px_per_unit()))
        .max(0.75 * apart);
    if size / (2.0 * half) < ENLARGED[0] * map.px_per_unit() {
        return None;
    }
    let m = [0.5 * (declared[0] + source[0]), 0.5 * (declared[1] + source[1])];
    Some(Panel { left, top, width: size, height: size, x: [m[0] - half, m[0] + half], y: [m[1] - half, m[1] + half] })
}

type SourceAt = [f64; 2];
