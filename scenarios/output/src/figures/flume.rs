//! A gantry's track over an instantaneous field of concentration at the height of its probes.
//!
//! *Source*: Webster, Volyanskyy & Weissburg 2012, Fig. 2 (field) and Fig. 9 (tracks), combined.

use super::map::legend::{BAR, LINE, Mark, SIZE, entry, heading, line, short, signs};
use super::marks;
use super::section::{Axes, Section};
use super::thinned::{stretches, thinned};
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::palette::{self, FLOW, INK};
use crate::charts::panel::Panel;
use crate::results::{GantryRow, GantryTrack, RunReport};
use robots::handoff::Behaviour;

/// Largest size of the panel, px.
const LARGEST: [f64; 2] = [820.0, 700.0];
const COLUMN: f64 = 250.0;
/// Distance between the nodes of the field, px.
const CELL_PX: f64 = 2.0;
const PLUME_OPACITY: f64 = 0.75;

/// The figure as SVG; `None` for a gantry that appears in no frame.
pub fn flume(run: &RunReport<'_>, t: &GantryTrack) -> Option<String> {
    let axes = Axes::from_track(run, t)?;
    let panel = place(&axes);
    let mut c = Canvas::new(panel.right() + COLUMN, (panel.bottom() + 60.0).max(470.0));
    // The height of most probes: on the built-in head, that of both outer ones.
    let z = height(t);
    let n = [panel.width, panel.height].map(|px| (px / CELL_PX).ceil() as usize + 1);
    let at_height =
        |z: f64, n: [usize; 2]| run.dye.and_then(|dye| Section::sample(&axes, z, n, t.info.effluent_kg_m3, dye));
    let section = z.and_then(|z| at_height(z, n));
    // The field below the probes, at the height of the source. Only its edge is drawn, so every other node will do.
    let below = (run.sources.first()).and_then(|s| at_height(s.position.z, n.map(|n| n.div_ceil(2) + 1)));
    panel.clip(&mut c);
    if let Some(section) = &section {
        let last = (section.levels.len() - 1) as f64;
        for (k, level) in section.levels.iter().enumerate() {
            let colour = palette::plume(k as f64 / last);
            let style = Style::fill(&colour).faint(PLUME_OPACITY);
            c.lines(&panel.lines(&section.rings(*level)), true, &style);
        }
    }
    if let Some(below) = &below {
        c.lines(&panel.lines(&below.rings(below.edge())), true, &edge_style());
    }
    if let Some([right, left]) = axes.sides {
        let (right, left) = (panel.py(right), panel.py(left));
        let outside = Style::fill("#eeeeee");
        c.rect(panel.left, right, panel.width, panel.bottom() - right, &outside);
        c.rect(panel.left, panel.top, panel.width, left - panel.top, &outside);
        for y in [right, left] {
            c.line([panel.left, y], [panel.right(), y], &Style::line(INK, 2.4));
        }
    }
    for o in run.obstacles {
        let corners: Vec<_> = o.corners.iter().map(|p| panel.position(axes.cm(*p))).collect();
        c.polygon(corners, &Style::fill("#8c6d4f").edged(INK, 1.0));
    }
    for s in run.sources {
        marks::true_source(&mut c, panel.position(axes.cm([s.position.x, s.position.y])));
    }
    track(&mut c, &panel, &axes, t);
    marks(&mut c, &panel, &axes, t);
    c.unclip();
    panel.frame(&mut c, 1.2);
    panel.x_ticks(&mut c, true, 11.0);
    panel.y_ticks(&mut c, 60.0, 11.0);
    marks::scale_bar(&mut c, &panel, "cm");
    let origin = if run.sources.is_empty() { "start" } else { "source" };
    let names =
        [format!("Down-stream of the {origin} (cm)"), format!("Left of the {origin}, looking down-stream (cm)")];
    panel.names(&mut c, 12.0, [&names[0], &names[1]], [40.0, panel.left - 22.0]);
    let summary = run.summary;
    let title = format!("{} · {}", summary.headline(), t.info.id);
    c.bold([panel.left, 24.0], 13.0, Anchor::Start, &title);
    let at = [panel.right() + 22.0, panel.top];
    let y = legend(&mut c, run, t, at);
    plume_key(&mut c, run, t, [section.as_ref(), below.as_ref()], z, [at[0], y]);
    Some(c.svg(&format!("flume{}", t.info.id)))
}

/// A panel with the same scale in both directions.
fn place(axes: &Axes) -> Panel {
    let (dx, dy) = (axes.x[1] - axes.x[0], axes.y[1] - axes.y[0]);
    let scale = (LARGEST[0] / dx).min(LARGEST[1] / dy);
    Panel { left: 74.0, top: 40.0, width: dx * scale, height: dy * scale, x: axes.x, y: axes.y }
}

/// The most frequent height of the probes' tips, the lowest of several (ENU), m.
fn height(t: &GantryTrack) -> Option<f64> {
    let shared = |z: f64| t.tips.iter().filter(|p| (p[2] - z).abs() < 1e-3).count();
    (t.tips.iter().map(|p| p[2])).max_by(|a, b| shared(*a).cmp(&shared(*b)).then(b.total_cmp(a)))
}

/// The head's track, coloured by what the searcher did, and where each motion ended.
fn track(c: &mut Canvas, panel: &Panel, axes: &Axes, t: &GantryTrack) {
    let at = |r: &GantryRow| panel.position(axes.cm(r.head));
    c.polyline(thinned(t.rows.iter().map(at)), &Style::line("#ffffff", 4.4).faint(0.8));
    for (_, rows) in stretches(&t.rows, |r| r.behaviour) {
        let style = Style::line(palette::behaviour(rows[0].behaviour), 2.2);
        c.polyline(thinned(rows.iter().map(at)), &style);
    }
    for pair in t.rows.windows(2).skip(1).filter(|pair| pair[0].command != pair[1].command) {
        halt(c, at(&pair[0]));
    }
}

fn edge_style() -> Style<'static> {
    Style::line("#3b6e8f", 0.8).dashed("3 2")
}

fn halt(c: &mut Canvas, p: [f64; 2]) {
    c.circle(p, 2.4, &Style::fill("#ffffff").edged(INK, 1.0));
}

fn probe(c: &mut Canvas, p: [f64; 2]) {
    c.circle(p, 3.0, &Style::fill(INK).edged("#ffffff", 1.0));
}

fn marks(c: &mut Canvas, panel: &Panel, axes: &Axes, t: &GantryTrack) {
    for tip in &t.tips {
        probe(c, panel.position(axes.cm([tip[0], tip[1]])));
    }
    if let Some(first) = t.rows.first() {
        marks::start(c, panel.position(axes.cm(first.head)));
    }
    if let Some(d) = t.declared {
        marks::declared(c, panel.position(axes.cm(d)));
    }
}

fn legend(c: &mut Canvas, run: &RunReport<'_>, t: &GantryTrack, [x, top]: [f64; 2]) -> f64 {
    let mut y = top + 6.0;
    heading(c, x, &mut y, "Track of the head");
    let seen = |b: &Behaviour| t.rows.iter().any(|r| r.behaviour == *b);
    // In the states idle and stopped it does not move, so there is no line to explain.
    let moving = (Behaviour::OF_GANTRY.into_iter()).filter(|b| !matches!(b, Behaviour::Idle | Behaviour::Done));
    for b in moving.filter(seen) {
        let (colour, words) = palette::gantry_look(b);
        line(c, x, &mut y, &Style::line(colour, 2.6), words);
    }
    let marks: [Mark<'_>; 5] = [
        (true, halt, "end of a motion"),
        (true, marks::start, "start"),
        (!t.tips.is_empty(), probe, "probes at the end"),
        (t.declared.is_some(), marks::declared, "stopped: source declared"),
        (!run.sources.is_empty(), marks::true_source, "true source"),
    ];
    signs(c, x, &mut y, &marks);
    y += 10.0;
    for s in run.sources.iter().take(1).filter(|s| s.flow.norm() > 1e-6) {
        let along = -nalgebra::Vector2::from(t.forward).dot(&s.flow);
        let (a, b) = ([x, y], [x + 24.0, y]);
        let (a, b) = if along >= 0.0 { (a, b) } else { (b, a) };
        c.arrow(a, b, FLOW, 2.0);
        let words = format!("flow at the source, {:.1} cm/s", 100.0 * s.flow.norm());
        entry(c, x, &mut y, &words);
    }
    y + 10.0
}

/// Keys of the section at the probes' height, and of the plume's edge at the source's height.
fn plume_key(
    c: &mut Canvas,
    run: &RunReport<'_>,
    t: &GantryTrack,
    [section, below]: [Option<&Section>; 2],
    z: Option<f64>,
    [x, mut y]: [f64; 2],
) {
    let [head_x, head_y] = t.rows.last().map_or([0.0, 0.0], |r| r.head);
    let up_cm = |z: f64| 100.0 * (z - run.terrain.bed_z(head_x, head_y));
    if let (Some(section), Some(z)) = (section, z) {
        let end_s = run.summary.run.totals.mission_s;
        let words = format!("Concentration ({}) at {end_s:.0} s,", section.unit);
        c.bold([x, y + 4.0], SIZE, Anchor::Start, &words);
        y += LINE - 3.0;
        let words = format!("{:.1} cm above the bed (probes)", up_cm(z));
        heading(c, x, &mut y, &words);
        let w = BAR / section.levels.len() as f64;
        let last = (section.levels.len() - 1) as f64;
        for (k, level) in section.levels.iter().enumerate() {
            let left = x + k as f64 * w;
            // As on the sheet, each level covers those below it.
            for under in 0..=k {
                let colour = palette::plume(under as f64 / last);
                let style = Style::fill(&colour).faint(PLUME_OPACITY);
                c.rect(left, y - 7.0, w, 11.0, &style);
            }
            c.rect(left, y - 7.0, w, 11.0, &Style::line("#5b7a5b", 0.6));
            if k % 2 == 0 {
                let at = [left, y + 16.0];
                c.text(at, 9.0, Anchor::Middle, &short(*level));
            }
        }
        y += 40.0;
    }
    if let (Some(below), Some(source)) = (below, run.sources.first()) {
        line(c, x, &mut y, &edge_style(), &format!("{} {}", short(below.edge()), below.unit));
        let words = format!("{:.1} cm above the bed (source)", up_cm(source.position.z));
        entry(c, x, &mut y, &words);
    }
}
