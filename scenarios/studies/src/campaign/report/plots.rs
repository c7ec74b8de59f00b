//! The report's figures.

use super::arms::ArmFigures;
use super::curves::Curve;
use super::pairs::{Compares, Comparison};
use super::unit::Unit;
use crate::campaign::stats::{Interval, LEAST_VALUES};
use output::charts::canvas::{Anchor, Canvas, Style};
use output::charts::palette::{GREY, INK};
use output::charts::panel::{Panel, range_of};

/// Colours that the colour-blind can tell apart (Okabe & Ito 2008).
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];

const LEFT: f64 = 72.0;
const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 340.0;
/// Height of a line of a list.
const LINE: f64 = 24.0;
/// Space for names to the left of a list.
const NAMES: f64 = 300.0;

/// Colour of the k-th arm.
pub(super) fn colour(k: usize) -> &'static str {
    COLOURS[k % COLOURS.len()]
}

/// After seven colours, they repeat with dashes.
pub(super) fn line_style(k: usize) -> Style<'static> {
    let style = Style::line(colour(k), 2.0);
    match k / COLOURS.len() {
        0 => style,
        1 => style.dashed("7 4"),
        _ => style.dashed("2 4"),
    }
}

/// Step curves with their bands. With `until_end`, each curve goes to its own end (survival), otherwise to the right
/// edge.
pub(super) fn curves(name: &str, title: &str, x: &str, y: &str, all: &[Curve], until_end: bool) -> String {
    let mut c = Canvas::new(LEFT + WIDTH + 24.0, 40.0 + HEIGHT + 48.0 + 17.0 * all.len() as f64);
    c.bold([LEFT, 24.0], 13.0, Anchor::Start, title);
    let right = all.iter().map(|c| c.end).fold(0.0, f64::max);
    let panel = Panel {
        left: LEFT,
        top: 38.0,
        width: WIDTH,
        height: HEIGHT,
        x: [0.0, if right > 0.0 { 1.02 * right } else { 1.0 }],
        y: [0.0, 1.0],
    };
    panel.grid(&mut c, 60.0);
    panel.clip(&mut c);
    for (k, curve) in all.iter().enumerate() {
        let end = if until_end { curve.end } else { panel.x[1] };
        let high: Vec<_> = steps(curve, end, |p| p.interval.high);
        let mut band = high;
        band.extend(steps(curve, end, |p| p.interval.low).into_iter().rev());
        let tint = Style { fill: Some(colour(k)), fill_opacity: Some(0.15), ..Style::default() };
        c.polygon(panel.all(&band), &tint);
    }
    for (k, curve) in all.iter().enumerate() {
        let end = if until_end { curve.end } else { panel.x[1] };
        c.polyline(panel.all(&steps(curve, end, |p| p.y)), &line_style(k));
    }
    c.unclip();
    panel.axes(&mut c, 60.0, 11.0);
    panel.names(&mut c, 12.0, [x, y], [38.0, LEFT - 22.0]);
    keys(&mut c, LEFT, panel.bottom() + 38.0, all.iter().map(|curve| (curve.arm.as_str(), curve.n)));
    c.svg(name)
}

/// The arms below a figure, each with its number of runs.
pub(super) fn keys<'a>(c: &mut Canvas, left: f64, below: f64, arms: impl Iterator<Item = (&'a str, u64)>) {
    for (k, (arm, n)) in arms.enumerate() {
        let y = below + 17.0 * (k + 1) as f64;
        c.line([left, y - 4.0], [left + 26.0, y - 4.0], &line_style(k));
        c.text([left + 34.0, y], 11.0, Anchor::Start, &format!("{arm} (n = {n})"));
    }
}

/// Corners of a step curve.
fn steps(curve: &Curve, end: f64, of: impl Fn(&super::Point) -> f64) -> Vec<[f64; 2]> {
    let mut out: Vec<[f64; 2]> = Vec::with_capacity(2 * curve.points.len() + 1);
    for p in &curve.points {
        if let Some([_, y]) = out.last().copied() {
            out.push([p.x, y]);
        }
        out.push([p.x, of(p)]);
    }
    if let Some([x, y]) = out.last().copied() {
        out.push([end.max(x), y]);
    }
    out
}

/// Success of each arm with its interval.
pub(super) fn success(arms: &[ArmFigures]) -> String {
    let entries: Vec<Entry> = arms
        .iter()
        .enumerate()
        .map(|(k, a)| Entry {
            name: format!("{} (n = {})", a.arm, a.success.n),
            value: a.success.value().map(|v| (100.0 * v, times(a.success.interval(), 100.0))),
            colour: colour(k),
        })
        .collect();
    let height = 40.0 + LINE * entries.len() as f64 + 60.0;
    let mut c = Canvas::new(NAMES + WIDTH - 200.0 + 24.0, height);
    c.bold([16.0, 24.0], 13.0, Anchor::Start, "Success with 95 % interval");
    list(&mut c, 38.0, [0.0, 100.0], None, &entries, "Successes (%)");
    c.svg("success")
}

/// Differences between arms with their intervals, a panel for each measure.
pub(super) fn differences(comparisons: &[Comparison]) -> String {
    let each = |by: Compares| comparisons.iter().filter(move |c| c.by == by);
    let per_panel = LINE * each(Compares::Success).count() as f64 + 84.0;
    let mut c = Canvas::new(NAMES + WIDTH - 200.0 + 24.0, 44.0 + per_panel * Compares::ALL.len() as f64);
    let title = "Paired differences with 95 % interval (first − second; same seeds and conditions)";
    c.bold([16.0, 24.0], 13.0, Anchor::Start, title);
    for (k, by) in Compares::ALL.into_iter().enumerate() {
        let (scale, unit) = match by.unit() {
            Unit::Share => (100.0, "% points"),
            Unit::Metres => (1.0, "m"),
            Unit::Seconds => (1.0, "s"),
            Unit::Speed => (100.0, "cm/s"),
            Unit::Number => (1.0, ""),
        };
        let entries: Vec<Entry> = each(by)
            .map(|c| Entry {
                name: format!("{} − {} ({})", c.first, c.second, c.difference.map_or(0, |d| d.pairs)),
                value: (c.difference)
                    .filter(|d| by == Compares::Success || d.pairs >= LEAST_VALUES)
                    .map(|d| (scale * d.estimate, times(d.interval, scale))),
                colour: if c.difference.is_some_and(|d| !d.interval.contains(0.0)) { INK } else { GREY },
            })
            .collect();
        let values = entries.iter().filter_map(|e| e.value);
        let ends = values.flat_map(|(v, i)| [v, i.low, i.high]).chain([0.0]);
        let known = range_of(ends, 0.06).filter(|[low, high]| high - low > 1e-6);
        let x = known.unwrap_or([-1.0, 1.0]);
        let label = format!("Difference in {} ({unit})", by.label());
        list(&mut c, 38.0 + per_panel * k as f64, x, Some(0.0), &entries, &label);
    }
    c.svg("differences")
}

fn times(i: Interval, scale: f64) -> Interval {
    Interval { low: scale * i.low, high: scale * i.high }
}

struct Entry {
    name: String,
    value: Option<(f64, Interval)>,
    colour: &'static str,
}

/// Values with intervals, one under the other.
fn list(c: &mut Canvas, top: f64, x: [f64; 2], mark: Option<f64>, entries: &[Entry], label: &str) {
    let panel =
        Panel { left: NAMES, top, width: WIDTH - 200.0, height: LINE * entries.len() as f64 + 8.0, x, y: [0.0, 1.0] };
    panel.grid(c, 1e6);
    if let Some(mark) = mark {
        let at = panel.px(mark);
        c.line([at, panel.top], [at, panel.bottom()], &Style::line(INK, 1.0).dashed("4 3"));
    }
    for (k, entry) in entries.iter().enumerate() {
        let y = top + LINE * (k as f64 + 0.5) + 4.0;
        c.text([NAMES - 10.0, y + 4.0], 11.0, Anchor::End, &entry.name);
        let Some((value, i)) = entry.value else {
            c.text([NAMES + 10.0, y + 4.0], 11.0, Anchor::Start, "too few");
            continue;
        };
        let (low, high) = (panel.px(i.low), panel.px(i.high));
        let style = Style::line(entry.colour, 2.0);
        c.line([low, y], [high, y], &style);
        for end in [low, high] {
            c.line([end, y - 4.0], [end, y + 4.0], &style);
        }
        c.circle([panel.px(value), y], 4.0, &Style::fill(entry.colour));
    }
    panel.frame(c, 1.0);
    panel.x_ticks(c, true, 11.0);
    let at = [NAMES + panel.width / 2.0, panel.bottom() + 36.0];
    c.text(at, 12.0, Anchor::Middle, label);
}
