//! The readings of a gantry's probes over time, with thresholds and spikes.
//!
//! *Source*: Webster, Volyanskyy & Weissburg 2012, Fig. 3 (concentration at a point) and Fig. 8 (threshold and spikes).

use super::map::legend::short;
use super::series_panels::{self as panels, BLUE, Band, ORANGE};
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::palette::{self, DETECTION, GREY, INK};
use crate::charts::panel::{Panel, decade, nice_step, number, power_of_ten, ticks};
use crate::results::{GantryRow, GantryTrack, RunReport};
use robots::handoff::Behaviour;
use world::math;

const LEFT: f64 = 100.0;
const WIDTH: f64 = 800.0;
const RIGHT: f64 = 72.0;
const GAP: f64 = 12.0;
/// Heights of the panels: the whole record of a probe, spike frequency, behaviour, and the enlarged part.
const WHOLE: f64 = 104.0;
const RATE: f64 = 72.0;
const BEHAVIOUR: f64 = 84.0;
const CLOSER: f64 = 220.0;
/// Length of the enlarged part, s.
const CLOSER_S: f64 = 20.0;
/// Lowest output above clean water on a logarithmic axis, V: about one step of a 12-bit converter.
const LOWEST_V: f64 = 0.003;

/// The figure as SVG; `None` for probes that were never read.
pub fn probe_records(run: &RunReport<'_>, t: &GantryTrack) -> Option<String> {
    let probes = t.tips.len();
    let read = t.rows.iter().any(|r| r.volts.is_some());
    if probes == 0 || !read || t.rows.len() < 2 {
        return None;
    }
    let n = probes as f64;
    let height = 42.0 + n * (WHOLE + GAP) + RATE + GAP + BEHAVIOUR + 74.0 + CLOSER + 52.0;
    let mut c = Canvas::new(LEFT + WIDTH + RIGHT, height);
    let summary = run.summary;
    let title = format!("{} · {}", summary.headline(), t.info.id);
    c.bold([LEFT, 24.0], 13.0, Anchor::Start, &title);
    // The first frame is one step after the start.
    let x = [0.0_f64.min(t.rows[0].t_s), t.rows[t.rows.len() - 1].t_s];
    let mut top = 40.0;
    let mut next = |height: f64| {
        let panel = Panel { left: LEFT, top, width: WIDTH, height, x, y: [0.0, 1.0] };
        top += height + GAP;
        panel
    };
    let (busiest, window) = busiest(t, probes);
    let most = (t.rows.iter().filter_map(|r| r.volts))
        .flat_map(|v| v.into_iter().take(probes))
        .fold(0.0, |m: f64, v| m.max(v - t.info.range_v[0]));
    for k in 0..probes {
        let mut panel = next(WHOLE);
        panel.y = [log10(LOWEST_V), log10(most.max(10.0 * LOWEST_V)) + 0.6];
        if k == busiest {
            let [a, b] = window.map(|s| panel.px(s));
            c.rect(a, panel.top, b - a, panel.height, &Style::fill("#fff6d6"));
        }
        whole(&mut c, &panel, t, k);
        finish(&mut c, &panel, t, false);
    }
    let mut panel = next(RATE);
    let fastest = t.rows.iter().map(|r| r.spike_hz).fold(0.5, f64::max);
    panel.y = [0.0, 1.15 * fastest];
    panels::axes(&mut c, &panel, "Spikes (Hz)");
    let rate = panels::curve_of(&panel, t.rows.iter().map(|r| (r.t_s, Some(r.spike_hz))));
    panels::draw_curve(&mut c, &panel, &rate, &Style::line(INK, 1.3));
    finish(&mut c, &panel, t, false);
    let panel = next(BEHAVIOUR);
    behaviour(&mut c, &panel, t);
    finish(&mut c, &panel, t, true);
    let mut panel = next(CLOSER);
    panel.top += 62.0;
    panel.x = window;
    closer(&mut c, panel, t, busiest);
    let at = [LEFT + WIDTH / 2.0, c.height - 10.0];
    c.text(at, 12.0, Anchor::Middle, "Mission time (s)");
    Some(c.svg(&format!("probes{}", t.info.id)))
}

fn log10(v: f64) -> f64 {
    math::ln(v) / std::f64::consts::LN_10
}

fn name(t: &GantryTrack, k: usize) -> String {
    let given = t.info.probes.get(k).map(|n| n.replace('_', " "));
    given.unwrap_or_else(|| format!("probe {k}"))
}

/// The probe with the most spikes, and the window that contains most of them.
fn busiest(t: &GantryTrack, probes: usize) -> (usize, [f64; 2]) {
    let spikes = |k: usize| t.rows.iter().filter(move |r| r.spike[k]);
    // The first, if several are equal.
    let most = (0..probes).rev().max_by_key(|k| spikes(*k).count()).unwrap_or(0);
    let (begin, end) = (t.rows[0].t_s, t.rows[t.rows.len() - 1].t_s);
    let length = CLOSER_S.min(end - begin);
    let from = spikes(most)
        .map(|r| (r.t_s - 0.5 * length).clamp(begin, (end - length).max(begin)))
        .map(|s| {
            let inside = spikes(most).filter(|r| (s..s + length).contains(&r.t_s));
            (inside.count(), s)
        })
        .fold((0, begin), |best, new| if new.0 > best.0 { new } else { best });
    (most, [from.1, from.1 + length])
}

/// Draws the frame, the ticks of the time axis, and the stop.
fn finish(c: &mut Canvas, panel: &Panel, t: &GantryTrack, numbers: bool) {
    if let Some((s, _)) = t.stopped {
        panels::event(c, panel, s, "");
    }
    panel.frame(c, 1.0);
    panel.x_ticks(c, numbers, 11.0);
}

/// A probe's output above clean water on a logarithmic axis.
fn whole(c: &mut Canvas, panel: &Panel, t: &GantryTrack, k: usize) {
    let bottom = t.info.range_v[0];
    let at = |v: f64| log10((v - bottom).max(LOWEST_V));
    for n in ticks(panel.y, 1.0) {
        let (y, v) = (panel.py(n), power_of_ten(n.round() as i32));
        panel.mark_y(c, y);
        c.text([panel.left - 7.0, y + 3.6], 10.0, Anchor::End, &number(v, v));
    }
    let middle = panel.top + panel.height / 2.0;
    c.upright([20.0, middle], 11.0, &name(t, k));
    c.upright([36.0, middle], 10.0, "V above clean");
    if let Some(v_per_c0) = volts_of_effluent(t) {
        let decades = ticks(panel.y.map(|y| y - log10(v_per_c0)), 1.0);
        let marks = decades.iter().map(|n| (n + log10(v_per_c0), short(power_of_ten(n.round() as i32))));
        of_effluent(c, panel, marks);
    }
    let volts = t.rows.iter().map(|r| (r.t_s, r.volts.map(|v| at(v[k]))));
    let curve = panels::curve_of(panel, volts);
    panels::draw_curve(c, panel, &curve, &Style::line(BLUE, 0.8));
    let threshold = t.rows.iter().map(|r| (r.t_s, Some(at(r.threshold_v[k]))));
    let curve = panels::curve_of(panel, threshold);
    panels::draw_curve(c, panel, &curve, &Style::line(ORANGE, 1.4));
    panel.clip(c);
    for p in spikes(t, k) {
        c.circle(panel.position([p[0], at(p[1])]), 1.8, &Style::fill(DETECTION));
    }
    c.unclip();
    let count = t.rows.iter().filter(|r| r.spike[k]).count();
    let spikes = format!("{count} spike{}", if count == 1 { "" } else { "s" });
    panel.key(c, &[("output", BLUE), ("threshold", ORANGE), (&spikes, DETECTION)]);
}

/// The axis at the right, of concentrations as shares of the effluent's: heights in the panel, and what stands there.
fn of_effluent(c: &mut Canvas, panel: &Panel, marks: impl Iterator<Item = (f64, String)>) {
    let x = panel.right();
    for (at, words) in marks {
        let y = panel.py(at);
        c.line([x, y], [x + 4.0, y], &Style::line(INK, 0.8));
        c.text([x + 7.0, y + 3.6], 10.0, Anchor::Start, &words);
    }
    c.upright([x + 58.0, panel.top + panel.height / 2.0], 10.0, "C/C0");
}

/// Times and outputs of a probe's spikes. A spike is known one scan late, so the moment before is shown.
fn spikes(t: &GantryTrack, k: usize) -> impl Iterator<Item = [f64; 2]> {
    let before = move |w: &[GantryRow]| w[0].volts.map(|v| [w[0].t_s, v[k]]);
    let found = t.rows.windows(2).filter(move |w| w[1].spike[k]);
    found.filter_map(before)
}

/// Output of undiluted effluent above clean water if the range were wide enough, V.
fn volts_of_effluent(t: &GantryTrack) -> Option<f64> {
    let [bottom, top] = t.info.range_v;
    (t.info.effluent_kg_m3).map(|c0| c0 / t.info.full_scale_kg_m3 * (top - bottom))
}

fn behaviour(c: &mut Canvas, panel: &Panel, t: &GantryTrack) {
    let seen: Vec<Behaviour> = (Behaviour::OF_GANTRY.into_iter())
        .filter(|b| t.rows.iter().filter(|r| r.behaviour == *b).count() > 1)
        .collect();
    let kinds: Vec<Band> = seen.iter().map(|b| palette::gantry_look(*b)).collect();
    let rows = t.rows.iter().filter_map(|r| {
        let band = seen.iter().position(|s| *s == r.behaviour)?;
        Some((r.t_s, band))
    });
    panels::bands(c, panel, &kinds, &rows.collect::<Vec<_>>());
}

/// Twenty seconds of one probe in volts, after Fig. 8.
fn closer(c: &mut Canvas, mut panel: Panel, t: &GantryTrack, k: usize) {
    let inside = |r: &&GantryRow| (panel.x[0]..=panel.x[1]).contains(&r.t_s);
    let values = t.rows.iter().filter(inside).filter_map(|r| r.volts);
    let bottom = t.info.range_v[0];
    let top = values.map(|v| v[k]).fold(bottom + 0.05, f64::max);
    panel.y = [bottom - 0.05 * (top - bottom), top + 0.16 * (top - bottom)];
    let words = format!("Closer: {}, the yellow part of its record", name(t, k));
    c.text([panel.left, panel.top - 8.0], 11.0, Anchor::Start, &words);
    panel.grid(c, 32.0);
    panel.y_ticks(c, 32.0, 10.0);
    let middle = panel.top + panel.height / 2.0;
    c.upright([24.0, middle], 11.0, "Output (V)");
    if let Some(v_per_c0) = volts_of_effluent(t) {
        let range = panel.y.map(|y| (y - bottom) / v_per_c0);
        let step = nice_step(range[1] - range[0], panel.height / 40.0);
        let base = decade(step);
        let words = |share: f64| match base {
            ..-3 => format!("{}e{base}", number(share / power_of_ten(base), 1.0)),
            _ => number(share, step),
        };
        let shares = ticks(range, step).into_iter().filter(|s| *s > -0.5 * step);
        of_effluent(c, &panel, shares.map(|share| (bottom + share * v_per_c0, words(share))));
    }
    let volts: Vec<[f64; 2]> =
        (t.rows.iter().filter(inside)).filter_map(|r| Some(panel.position([r.t_s, r.volts?[k]]))).collect();
    let threshold: Vec<[f64; 2]> =
        (t.rows.iter().filter(inside)).map(|r| panel.position([r.t_s, r.threshold_v[k]])).collect();
    panel.clip(c);
    c.polyline(volts, &Style::line(BLUE, 1.2));
    c.polyline(threshold, &Style::line(ORANGE, 1.6).dashed("6 3"));
    for p in spikes(t, k) {
        c.circle(panel.position(p), 3.6, &Style::line(DETECTION, 1.4));
    }
    c.unclip();
    panel.key(c, &[("output", BLUE), ("threshold", ORANGE), ("spike", DETECTION)]);
    if let Some((s, found)) = t.stopped {
        panels::event(c, &panel, s, "");
        let how = if found { "stopped: source declared" } else { "gave up" };
        let at = [panel.right(), panel.top - 8.0];
        c.text(at, 11.0, Anchor::End, &format!("{how} at {s:.1} s"));
    }
    c.rect(panel.left, panel.top, panel.width, panel.height, &Style::line(GREY, 1.0));
    panel.x_ticks(c, true, 11.0);
}
