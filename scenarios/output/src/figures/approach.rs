//! Speed of a gantry's head, and its distance from the centreline, against the distance to the source.
//!
//! *Source*: Webster, Volyanskyy & Weissburg 2012, Fig. 11, which compares both 100-50 cm and 50-0 cm from the source.

use super::section::Axes;
use super::series_panels::axes as scales;
use super::thinned::stretches;
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::palette::{self, GREY, INK};
use crate::charts::panel::{Panel, range_of};
use crate::results::{GantryRow, GantryTrack, RunReport};
use robots::handoff::Behaviour;

const LEFT: f64 = 92.0;
const WIDTH: f64 = 800.0;
const HEIGHT: f64 = 220.0;
const GAP: f64 = 22.0;
/// The ranges compared (cm), the near one first.
const RANGES: [[f64; 2]; 2] = [[0.0, 50.0], [50.0, 100.0]];
const SHADES: [&str; 2] = ["#eef3f8", "#f8f3ea"];

/// One motion of the head, with the rest that follows.
struct Motion {
    behaviour: Behaviour,
    /// Mean distance down-stream of the source, cm.
    away: f64,
    /// Mean distance from the line along the stream through the source, cm.
    aside: f64,
    /// Speed: distance over time, cm/s.
    speed: f64,
}

/// The figure as SVG; `None` without a source or a step up-stream.
pub fn approach(run: &RunReport<'_>, t: &GantryTrack) -> Option<String> {
    if run.sources.is_empty() {
        return None;
    }
    let place = Axes::from_track(run, t)?;
    let rows = tracking(t);
    let motions = motions(&place, rows);
    let away = rows.iter().map(|r| place.cm(r.head)[0]);
    let x = range_of(away.chain([0.0, 100.0]), 0.03)?;
    if motions.is_empty() {
        return None;
    }
    let mut c = Canvas::new(LEFT + WIDTH + 24.0, 64.0 + 2.0 * (HEIGHT + GAP) + 30.0);
    let summary = run.summary;
    let title = format!("{} · {}", summary.headline(), t.info.id);
    c.bold([LEFT, 24.0], 13.0, Anchor::Start, &title);
    key(&mut c, &motions);
    let said = summary.gantries.iter().find(|g| g.id == t.info.id);
    let cm = |pair: [Option<f64>; 2]| pair.map(|v| v.map(|v| 100.0 * v));
    let none = [None; 2];
    type Kind = (&'static str, &'static str, fn(&Motion) -> f64, [Option<f64>; 2]);
    let kinds: [Kind; 2] = [
        ("Speed (cm/s)", "cm/s", |m| m.speed, said.map_or(none, |g| cm(g.speed_far_near_m_s))),
        ("From centreline (cm)", "cm", |m| m.aside, said.map_or(none, |g| cm(g.offset_far_near_m))),
    ];
    for (k, (label, unit, of, [far, near])) in kinds.into_iter().enumerate() {
        let top = motions.iter().map(of).fold(0.0, f64::max);
        let panel = Panel {
            left: LEFT,
            top: 60.0 + k as f64 * (HEIGHT + GAP),
            width: WIDTH,
            height: HEIGHT,
            x,
            y: [0.0, 1.2 * top.max(0.1)],
        };
        for (range, shade) in RANGES.iter().zip(SHADES) {
            let [a, b] = range.map(|v| panel.px(v));
            c.rect(a, panel.top, b - a, panel.height, &Style::fill(shade));
        }
        scales(&mut c, &panel, label);
        panel.clip(&mut c);
        let line: Vec<_> = motions.iter().map(|m| panel.position([m.away, of(m)])).collect();
        c.polyline(line, &Style::line(GREY, 0.8));
        for m in &motions {
            let colour = palette::behaviour(m.behaviour);
            c.circle(panel.position([m.away, of(m)]), 4.0, &Style::fill(colour).edged("#ffffff", 0.8));
        }
        c.unclip();
        for ([a, b], mean) in RANGES.into_iter().zip([near, far]) {
            if let Some(mean) = mean {
                mean_of(&mut c, &panel, [a, b], mean, unit);
            }
        }
        panel.frame(&mut c, 1.0);
        panel.x_ticks(&mut c, k == 1, 11.0);
    }
    let below = c.height - 12.0;
    c.text([LEFT + WIDTH / 2.0, below], 12.0, Anchor::Middle, "Down-stream of the source (cm)");
    Some(c.svg(&format!("approach{}", t.info.id)))
}

/// From the first step up-stream to the stop.
fn tracking(t: &GantryTrack) -> &[GantryRow] {
    let steps = |r: &GantryRow| matches!(r.behaviour, Behaviour::StepUp | Behaviour::Cast);
    let begin = t.rows.iter().position(steps).unwrap_or(t.rows.len());
    let rows = &t.rows[begin..];
    let end = rows.iter().position(|r| r.behaviour == Behaviour::Done);
    &rows[..end.unwrap_or(rows.len())]
}

fn motions(place: &Axes, rows: &[GantryRow]) -> Vec<Motion> {
    let mut found = Vec::new();
    // Up to the first row of the next motion, because the way between the two belongs to this one.
    for (_, of) in stretches(rows, |r| r.command) {
        let points: Vec<[f64; 2]> = of.iter().map(|r| place.cm(r.head)).collect();
        let way: f64 = (points.windows(2))
            .map(|w| [w[1][0] - w[0][0], w[1][1] - w[0][1]])
            .map(|d| (d[0] * d[0] + d[1] * d[1]).sqrt())
            .sum();
        let time = of[of.len() - 1].t_s - of[0].t_s;
        let n = points.len() as f64;
        if time > 0.0 {
            found.push(Motion {
                behaviour: of[0].behaviour,
                away: points.iter().map(|p| p[0]).sum::<f64>() / n,
                aside: points.iter().map(|p| p[1].abs()).sum::<f64>() / n,
                speed: way / time,
            });
        }
    }
    found
}

/// Draws a range's mean as a line across it.
fn mean_of(c: &mut Canvas, panel: &Panel, [a, b]: [f64; 2], mean: f64, unit: &str) {
    let y = panel.py(mean);
    c.line([panel.px(a), y], [panel.px(b), y], &Style::line("#ffffff", 4.0));
    c.line([panel.px(a), y], [panel.px(b), y], &Style::line(INK, 2.0).dashed("7 4"));
    let words = format!("mean {a:.0}–{b:.0} cm: {mean:.1} {unit}");
    let at = [panel.px(0.5 * (a + b)), panel.top + 16.0];
    c.rimmed(at, 10.5, Anchor::Middle, &words);
}

fn key(c: &mut Canvas, motions: &[Motion]) {
    let mut x = LEFT + 6.0;
    for b in Behaviour::OF_GANTRY {
        if motions.iter().any(|m| m.behaviour == b) {
            let (colour, words) = palette::gantry_look(b);
            c.circle([x, 43.0], 4.0, &Style::fill(colour));
            c.text([x + 9.0, 47.0], 10.5, Anchor::Start, words);
            x += 30.0 + 6.8 * words.chars().count() as f64;
        }
    }
    let right = [LEFT + WIDTH, 47.0];
    c.text(right, 10.5, Anchor::End, "one mark a motion, with the rest after it; from the first step up-stream");
}
