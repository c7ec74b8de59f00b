//! The panels of the time series.

use super::thinned::stretches;
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::label_box::{LabelBox, width_of};
use crate::charts::palette::{self, DETECTION, GREY, INK};
use crate::charts::panel::{Panel, range_of};
use crate::results::{RobotTrack, TrackRow};
use robots::handoff::Behaviour;

/// Draws one panel; the function chooses the panel's `y`.
pub(super) type Draw = fn(&mut Canvas, Panel, &RobotTrack);

pub(super) const BLUE: &str = "#0072b2";
pub(super) const ORANGE: &str = "#e69f00";
const BED: &str = "#b9a48b";

pub(super) fn axes(c: &mut Canvas, panel: &Panel, label: &str) {
    panel.grid(c, 32.0);
    panel.y_ticks(c, 32.0, 10.0);
    c.upright([24.0, panel.top + panel.height / 2.0], 11.0, label);
}

/// A vertical line at an event.
pub(super) fn event(c: &mut Canvas, panel: &Panel, t_s: f64, words: &str) {
    if t_s < panel.x[0] || t_s > panel.x[1] {
        return;
    }
    let x = panel.px(t_s);
    c.line([x, panel.top], [x, panel.bottom()], &Style::line(INK, 1.0).dashed("4 3"));
    if words.is_empty() {
        return;
    }
    // To the right or left of the line, and line by line further down, where no key and no other event is.
    let lines = ((panel.height - 12.0) / 13.0).max(1.0) as usize;
    let places: Vec<_> = (0..lines)
        .map(|k| panel.top + 12.0 + 13.0 * k as f64)
        .flat_map(|y| [([x + 4.0, y], Anchor::Start), ([x - 4.0, y], Anchor::End)])
        .collect();
    panel.label_at(c, &places, 10.0, words, false);
}

fn curve(panel: &Panel, rows: &[TrackRow], of: impl Fn(&TrackRow) -> Option<f64>) -> Vec<Vec<[f64; 2]>> {
    curve_of(panel, rows.iter().map(|r| (r.t_s, of(r))))
}

/// Points of a curve through (x, y): the smallest and the largest in each pixel column, so that no peak is lost.
pub(super) fn curve_of(panel: &Panel, values: impl Iterator<Item = (f64, Option<f64>)>) -> Vec<Vec<[f64; 2]>> {
    let mut lines: Vec<Vec<[f64; 2]>> = vec![Vec::new()];
    let mut column: Option<(i64, [f64; 2], [f64; 2])> = None;
    let close = |line: &mut Vec<[f64; 2]>, lo: [f64; 2], hi: [f64; 2]| {
        if lo == hi {
            line.push(lo);
        } else if lo[0] <= hi[0] {
            line.extend([lo, hi]);
        } else {
            line.extend([hi, lo]);
        }
    };
    for (x, y) in values {
        let line = lines.last_mut().expect("there is always a line");
        let Some(v) = y.filter(|v| v.is_finite()) else {
            if let Some((_, lo, hi)) = column.take() {
                close(line, lo, hi);
                lines.push(Vec::new());
            }
            continue;
        };
        let p = panel.position([x, v]);
        let key = p[0].floor() as i64;
        column = Some(match column {
            Some((k, lo, hi)) if k == key => (k, if p[1] < lo[1] { p } else { lo }, if p[1] > hi[1] { p } else { hi }),
            Some((_, lo, hi)) => {
                close(line, lo, hi);
                (key, p, p)
            }
            None => (key, p, p),
        });
    }
    if let Some((_, lo, hi)) = column {
        close(lines.last_mut().expect("there is always a line"), lo, hi);
    }
    lines
}

pub(super) fn draw_curve(c: &mut Canvas, panel: &Panel, lines: &[Vec<[f64; 2]>], style: &Style<'_>) {
    panel.clip(c);
    c.lines(lines, false, style);
    c.unclip();
}

impl Panel {
    /// Names of the curves, along the upper edge from the right.
    pub(super) fn key(&self, c: &mut Canvas, entries: &[(&str, &str)]) {
        let mut x = self.right() - 10.0;
        for (words, colour) in entries.iter().rev() {
            let width = width_of(words, 10.0);
            c.rimmed([x, self.top + 13.0], 10.0, Anchor::End, words);
            let y = self.top + 9.5;
            c.line([x - width - 24.0, y], [x - width - 8.0, y], &Style::line(colour, 2.4));
            c.keep_free(LabelBox { left: x - width - 27.0, top: self.top, right: x, bottom: self.top + 17.0 });
            x -= width + 40.0;
        }
    }
}

/// Depth of the vehicle, and the bed under it.
pub(super) fn depth(c: &mut Canvas, mut panel: Panel, t: &RobotTrack) {
    let bed = |r: &TrackRow| r.altitude_m - r.p[2];
    let deepest = t.rows.iter().map(bed).fold(0.0, f64::max);
    panel.y = [(1.08 * deepest).max(1e-3), (-0.04 * deepest).min(0.0)];
    axes(c, &panel, "Depth (m)");
    panel.clip(c);
    for mut line in curve(&panel, &t.rows, |r| Some(bed(r))) {
        if let (Some(a), Some(b)) = (line.first().copied(), line.last().copied()) {
            line.extend([[b[0], panel.bottom()], [a[0], panel.bottom()]]);
            c.polygon(line, &Style::fill(BED));
        }
    }
    c.unclip();
    let asked = curve(&panel, &t.rows, |r| r.depth_asked_m);
    draw_curve(c, &panel, &asked, &Style::line(ORANGE, 1.2));
    let own = curve(&panel, &t.rows, |r| Some(-r.p[2]));
    draw_curve(c, &panel, &own, &Style::line(BLUE, 1.4));
    let mut key = vec![("vehicle", BLUE), ("bed", BED)];
    if t.rows.iter().any(|r| r.depth_asked_m.is_some()) {
        key.push(("commanded", ORANGE));
    }
    panel.key(c, &key);
}

/// Altitude, true and commanded.
pub(super) fn altitude(c: &mut Canvas, mut panel: Panel, t: &RobotTrack) {
    let both = t.rows.iter().flat_map(|r| [Some(r.altitude_m), r.altitude_asked_m]);
    let range = range_of(both.flatten(), 0.08).unwrap_or([0.0, 1.0]);
    panel.y = [0.0, range[1].max(1e-3) * 1.15];
    axes(c, &panel, "Altitude (m)");
    let own = curve(&panel, &t.rows, |r| Some(r.altitude_m));
    draw_curve(c, &panel, &own, &Style::line(BLUE, 1.4));
    let asked = curve(&panel, &t.rows, |r| r.altitude_asked_m);
    draw_curve(c, &panel, &asked, &Style::line(ORANGE, 1.4));
    let mut key = vec![("true", BLUE)];
    if t.rows.iter().any(|r| r.altitude_asked_m.is_some()) {
        key.push(("commanded", ORANGE));
    }
    panel.key(c, &key);
}

/// Chemical reading and threshold: in µg/L if full scale is known, otherwise in percent of it.
pub(super) fn reading(c: &mut Canvas, mut panel: Panel, t: &RobotTrack) {
    let (unit, label) = match t.info.full_scale_ug_l {
        Some(f) => (f, "Reading (µg/L)"),
        None => (100.0, "Reading (% FS)"),
    };
    let values = t.rows.iter().filter_map(|r| r.reading);
    let top = values.fold(0.0, f64::max).max(2.0 * t.info.threshold.unwrap_or(0.02));
    panel.y = [-0.04 * top * unit, 1.15 * top * unit];
    axes(c, &panel, label);
    let lines = curve(&panel, &t.rows, |r| r.reading.map(|v| v * unit));
    if lines.iter().all(Vec::is_empty) {
        let at = [panel.left + panel.width / 2.0, panel.top + panel.height / 2.0];
        c.rimmed(at, 11.0, Anchor::Middle, "no chemical sensor or no reading");
        return;
    }
    draw_curve(c, &panel, &lines, &Style::line(DETECTION, 1.0));
    let mut key = vec![("reading", DETECTION)];
    if let Some(threshold) = t.info.threshold {
        let y = panel.py(threshold * unit);
        c.line([panel.left, y], [panel.right(), y], &Style::line(INK, 0.9).dashed("5 3"));
        key.push(("threshold", INK));
    }
    panel.key(c, &key);
}

/// Behaviour as bands, one row for each.
pub(super) fn behaviour(c: &mut Canvas, panel: Panel, t: &RobotTrack) {
    let seen = Behaviour::seen(t.rows.iter().map(|r| r.behaviour));
    let kinds: Vec<Band> = seen.iter().map(|b| palette::behaviour_look(*b)).collect();
    let rows = t.rows.iter().map(|r| {
        let band = seen.iter().position(|s| *s == r.behaviour);
        (r.t_s, band.unwrap_or(0))
    });
    bands(c, &panel, &kinds, &rows.collect::<Vec<_>>());
}

/// Colour and words of a band.
pub(super) type Band<'a> = (&'a str, &'a str);

/// A band for each kind, filled while that kind holds. `rows` are times, each with the kind that holds from then on.
pub(super) fn bands(c: &mut Canvas, panel: &Panel, kinds: &[Band], rows: &[(f64, usize)]) {
    let row = panel.height / kinds.len().max(1) as f64;
    for (k, (_, words)) in kinds.iter().enumerate() {
        let y = panel.top + k as f64 * row;
        if k > 0 {
            c.line([panel.left, y], [panel.right(), y], &Style::line("#e3e3e3", 0.7));
        }
        let at = [panel.left - 7.0, y + row / 2.0 + 3.5];
        c.text(at, 9.5, Anchor::End, words);
    }
    for (_, run) in stretches(rows, |r| r.1) {
        let (begin, kind) = run[0];
        let (x0, x1) = (panel.px(begin), panel.px(run[run.len() - 1].0));
        c.rect(x0, panel.top + (kind as f64 + 0.14) * row, (x1 - x0).max(0.6), 0.72 * row, &Style::fill(kinds[kind].0));
    }
}

/// Distance between the true and the believed position of the robot.
pub(super) fn position_error(c: &mut Canvas, mut panel: Panel, t: &RobotTrack) {
    let error = |r: &TrackRow| {
        let d = [r.believed[0] - r.p[0], r.believed[1] - r.p[1]];
        (d[0] * d[0] + d[1] * d[1]).sqrt()
    };
    let top = t.rows.iter().map(error).fold(0.0, f64::max);
    panel.y = [0.0, (1.15 * top).max(1e-3)];
    axes(c, &panel, "Pos. error (m)");
    let lines = curve(&panel, &t.rows, |r| Some(error(r)));
    draw_curve(c, &panel, &lines, &Style::line(GREY, 1.3));
}
