//! Small maps of the area beside and below each other, with cells in shades of a value.

use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::palette::{self, INK};
use crate::charts::panel::{Panel, range_of};
use crate::figures::shaded_cells;
use crate::figures::shaded_cells::ShadedCells;
use crate::figures::solids;
use crate::results::RunReport;
use robots::handoff::BeliefGrid;
use world::math;

/// Largest panel, px.
const LARGEST: [f64; 2] = [560.0, 430.0];
/// Room to the left of the panels, px.
pub(in crate::figures) const LEFT: f64 = 66.0;
const GAP: [f64; 2] = [70.0, 92.0];
/// Range of values shown, in decades below the largest, and the number of shades for it.
const DECADES: f64 = 4.0;
const SHADES: usize = 12;
/// Colour of the vehicle.
const VEHICLE: &str = "#0072b2";

/// A sheet with a title and so many panels, two in a row, from `top` on, and so much room below them, px.
pub(in crate::figures) fn sheet(
    run: &RunReport<'_>,
    title: &str,
    n: usize,
    top: f64,
    below: f64,
) -> (Canvas, Vec<Panel>) {
    let (x, y) = bounds(run);
    let scale = (LARGEST[0] / (x[1] - x[0])).min(LARGEST[1] / (y[1] - y[0]));
    let (width, height) = ((x[1] - x[0]) * scale, (y[1] - y[0]) * scale);
    let step = [width.max(250.0) + GAP[0], height + GAP[1]];
    let (columns, rows) = (n.clamp(1, 2), n.div_ceil(2).max(1));
    let mut c = Canvas::new(LEFT + columns as f64 * step[0], top + rows as f64 * step[1] + below);
    c.bold([LEFT, 24.0], 13.0, Anchor::Start, title);
    let panel = |k: usize| {
        let (left, top) = (LEFT + (k % 2) as f64 * step[0], top + (k / 2) as f64 * step[1]);
        Panel { left, top, width, height, x, y }
    };
    (c, (0..n).map(panel).collect())
}

/// The area and the solids in it.
pub(in crate::figures) fn place(c: &mut Canvas, panel: &Panel, run: &RunReport<'_>) {
    let corners = run.area.corners().map(|p| [p.x, p.y]);
    c.polygon(panel.all(&corners), &Style::line(INK, 1.2).dashed("7 4"));
    for below in [true, false] {
        solids::draw(c, panel, run.obstacles, run.terrain, below);
    }
}

/// Ends a map: its edge, and its axes.
pub(in crate::figures) fn axes(c: &mut Canvas, panel: &Panel) {
    c.unclip();
    panel.axes(c, 50.0, 10.0);
    panel.names(c, 10.5, ["East (m)", "North (m)"], [31.0, 44.0]);
}

/// Where the vehicle truly is.
pub(in crate::figures) fn vehicle(c: &mut Canvas, p: [f64; 2]) {
    c.circle(p, 4.0, &Style::fill(VEHICLE).edged("#ffffff", 1.2));
}

/// A layer of cells in shades of a value's share of the largest.
pub(in crate::figures) fn shades(c: &mut Canvas, panel: &Panel, grid: &BeliefGrid, plan: &[f64]) {
    let most = plan.iter().fold(0.0, |m: f64, v| m.max(*v));
    let shade = |p: &f64| {
        let share = 1.0 + math::ln((p / most).max(1e-30)) / (DECADES * std::f64::consts::LN_10);
        Some((share * SHADES as f64).ceil().clamp(0.0, SHADES as f64) as usize).filter(|s| *s > 0)
    };
    let corner = |i: usize, j: usize| {
        let p = grid.world([i as f64 * grid.cell_m[0], j as f64 * grid.cell_m[1], 0.0]);
        panel.position([p.x, p.y])
    };
    let mut cells = ShadedCells::new(SHADES + 1);
    for (j, row) in plan.chunks(grid.n[0]).enumerate() {
        let row: Vec<_> = row.iter().map(shade).collect();
        cells.line(&row, |from, to| [corner(from, j), corner(to, j), corner(to, j + 1), corner(from, j + 1)]);
    }
    cells.draw(c, palette::likelihood, 0.4);
}

/// Draws the scale of shades after `words`, from position `from` on.
pub(in crate::figures) fn scale(c: &mut Canvas, [x, y]: [f64; 2], words: &str, from: f64) {
    c.text([x, y], 10.0, Anchor::Start, words);
    let colours = (1..=SHADES).map(|s| palette::likelihood(s as f64 / SHADES as f64));
    let end = shaded_cells::scale(c, [from, y], colours);
    for (at, number) in [(from, "0.0001"), (0.5 * (from + end), "0.01"), (end, "1")] {
        c.text([at, y + 14.0], 9.0, Anchor::Middle, number);
    }
}

/// East and north ranges that contain the area.
fn bounds(run: &RunReport<'_>) -> ([f64; 2], [f64; 2]) {
    let corners = run.area.corners();
    let along = |k: usize| range_of(corners.iter().map(|p| p[k]), 0.02).unwrap_or([-1.0, 1.0]);
    (along(0), along(1))
}
