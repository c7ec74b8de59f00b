//! A sheet with one panel for each trial.

use super::trial::{Curve, Trial};
use output::charts::canvas::{Anchor, Canvas, Style};
use output::charts::panel::{Panel, range_of};

/// Panels in a row.
const COLUMNS: usize = 3;
/// Sides of a panel and what lies between two, px.
const SIDES: [f64; 2] = [250.0, 190.0];
const STRIDE: [f64; 2] = [345.0, 330.0];
const INK: &str = "#1f5fa8";
const RUDDER: &str = "#b3541e";

/// The trials of a vehicle, as SVG text.
pub fn figure(vehicle: &str, trials: &[Trial]) -> String {
    let rows = trials.len().div_ceil(COLUMNS);
    let columns = trials.len().min(COLUMNS);
    let mut c = Canvas::new(STRIDE[0] * columns as f64 + 20.0, STRIDE[1] * rows as f64 + 40.0);
    c.bold([20.0, 28.0], 16.0, Anchor::Start, vehicle);
    for (k, trial) in trials.iter().enumerate() {
        let left = 75.0 + STRIDE[0] * (k % COLUMNS) as f64;
        let top = 75.0 + STRIDE[1] * (k / COLUMNS) as f64;
        panel(&mut c, [left, top], trial);
    }
    c.svg("trials")
}

fn panel(c: &mut Canvas, [left, top]: [f64; 2], trial: &Trial) {
    let Curve { labels, points, plan, rudder } = &trial.curve;
    let both = || points.iter().chain(rudder);
    let range = |k: usize| range_of(both().map(|p| p[k]), 0.08).unwrap_or([-1.0, 1.0]);
    let (mut x, mut y) = (range(0), range(1));
    if *plan {
        // Equal scales: the wider of both decides.
        let per_px = ((x[1] - x[0]) / SIDES[0]).max((y[1] - y[0]) / SIDES[1]);
        for (range, side) in [(&mut x, SIDES[0]), (&mut y, SIDES[1])] {
            let middle = (range[0] + range[1]) / 2.0;
            *range = [middle - per_px * side / 2.0, middle + per_px * side / 2.0];
        }
    }
    let panel = Panel { left, top, width: SIDES[0], height: SIDES[1], x, y };
    panel.grid(c, 40.0);
    panel.axes(c, 40.0, 11.0);
    c.bold([left, top - 10.0], 13.0, Anchor::Start, labels[0]);
    panel.names(c, 11.0, [labels[1], labels[2]], [34.0, 48.0]);
    panel.clip(c);
    c.polyline(panel.all(rudder), &Style::line(RUDDER, 1.2));
    c.polyline(panel.all(points), &Style::line(INK, 1.6));
    c.unclip();
    if !rudder.is_empty() {
        for (name, colour, x) in [("heading", INK, 150.0), ("rudder", RUDDER, 70.0)] {
            let at = [left + SIDES[0] - x, top - 10.0];
            let y = at[1] - 4.0;
            c.line([at[0], y], [at[0] + 18.0, y], &Style::line(colour, 1.6));
            c.text([at[0] + 22.0, at[1]], 10.5, Anchor::Start, name);
        }
    }
    for (k, found) in trial.found.iter().take(4).enumerate() {
        let value = found.value.map_or("-".to_string(), |v| format!("{v:.2} {}", found.unit));
        let y = panel.bottom() + 50.0 + 14.0 * k as f64;
        c.text([left, y], 10.5, Anchor::Start, &format!("{}: {value}", found.what));
    }
}
