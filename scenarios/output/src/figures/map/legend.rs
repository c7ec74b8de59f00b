//! The map's keys.

use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::palette::{self, BELIEVED, FLOW, INK};
use crate::charts::panel::{Panel, decade, number};
use crate::figures::marks;
use crate::figures::marks::Bed;
use crate::figures::plume_load::PlumeLoad;
use crate::figures::solids;
use crate::figures::solids::Passage;
use crate::figures::vehicles::{AFTER, BAND, WIDTH, over_from};
use crate::results::{RobotTrack, RunReport};
use robots::handoff::{Behaviour, Declaration};
use world::units::Heading;

/// Height of a line of keys, px.
pub(in crate::figures) const LINE: f64 = 18.0;
pub(in crate::figures) const SIZE: f64 = 10.5;

/// A block of keys. It is drawn downwards from a place and returns where it ends.
pub(super) type Block<'a> = Box<dyn Fn(&mut Canvas, [f64; 2]) -> f64 + 'a>;

/// The blocks of keys that the map needs: tracks, marks, water.
pub(super) fn keys<'a>(run: &'a RunReport<'a>, bed: &'a Bed, plume: Option<&'a PlumeLoad>) -> Vec<Block<'a>> {
    let rows = run.track.robots.iter().flat_map(|t| &t.rows);
    let seen = Behaviour::seen(rows.map(|r| r.behaviour));
    let mut blocks: Vec<Block<'a>> = Vec::new();
    if !seen.is_empty() {
        blocks.push(Box::new(move |c, at| {
            let below = tracks(c, &seen, at);
            vehicles(c, run, [at[0], below])
        }));
    }
    blocks.push(Box::new(|c, at| marks(c, run, at)));
    blocks.push(Box::new(move |c, [x, top]| {
        let mut y = top + 6.0;
        flow(c, run, x, &mut y);
        depth_key(c, x, &mut y, bed);
        if let Some(p) = plume {
            plume_key(c, x, &mut y, p, run.plume.map_or(0.0, |p| p.t_s));
        }
        y
    }));
    blocks
}

/// Keys of the bands, if there are several vehicles; returns where they end.
fn vehicles(c: &mut Canvas, run: &RunReport<'_>, [x, top]: [f64; 2]) -> f64 {
    let robots = &run.track.robots;
    if robots.len() < 2 {
        return top;
    }
    let mut y = top + 6.0;
    heading(c, x, &mut y, "Vehicle, by the band round its track");
    for (k, t) in robots.iter().enumerate() {
        line(c, x, &mut y, &Style::line(palette::vehicle(k), WIDTH).faint(BAND), &t.info.id);
    }
    if robots.iter().any(|t| over_from(t) < t.rows.len()) {
        let style = Style::line(palette::behaviour(Behaviour::Done), 2.6).faint(AFTER);
        line(c, x, &mut y, &style, "after the end of its mission");
    }
    y
}

fn tracks(c: &mut Canvas, seen: &[Behaviour], [x, top]: [f64; 2]) -> f64 {
    let mut y = top + 6.0;
    heading(c, x, &mut y, "True track, by behaviour");
    for b in seen {
        let (colour, words) = palette::behaviour_look(*b);
        line(c, x, &mut y, &Style::line(colour, 2.6), words);
    }
    line(c, x, &mut y, &Style::line(BELIEVED, 0.9).dashed("2 2"), "believed track");
    y
}

fn marks(c: &mut Canvas, run: &RunReport<'_>, [x, top]: [f64; 2]) -> f64 {
    let mut y = top + 6.0;
    let robots = &run.track.robots;
    let any = |of: fn(&RobotTrack) -> bool| robots.iter().any(of);
    let marks: [Mark<'_>; 7] = [
        (any(|t| !t.rows.is_empty()), marks::start, "start"),
        (any(|t| !t.detections.is_empty()), marks::detection, "detection"),
        (any(|t| !t.lost_points.is_empty()), marks::lost_point, "plume lost (believed)"),
        (any(|t| t.declarations.iter().any(|d| !d.at_edge())), marks::declared, "declared source"),
        (
            any(|t| t.declarations.iter().any(|d| d.evidence.is_some())),
            |c, p| marks::zone(c, p, 8.0),
            "round the points it rests on",
        ),
        (any(|t| t.declarations.iter().any(Declaration::at_edge)), marks::plume_at_edge, "plume at up-flow edge"),
        (!run.sources.is_empty(), marks::true_source, "true source"),
    ];
    signs(c, x, &mut y, &marks);
    line(c, x, &mut y, &Style::line(INK, 1.6).dashed("7 4"), "operating area");
    if any(|t| !t.regions.is_empty()) {
        line(c, x, &mut y, &marks::region_line(), "subregion");
    }
    obstacles(c, run, x, &mut y);
    y
}

/// Which obstacles there are, by the way that water has past them.
fn obstacles(c: &mut Canvas, run: &RunReport<'_>, x: f64, y: &mut f64) {
    let there = |p: &Passage| {
        let mut all = run.obstacles.iter();
        all.any(|o| solids::passage(o, run.terrain) == *p)
    };
    for passage in Passage::ALL.into_iter().filter(there) {
        let sign = Panel { left: x + 3.0, top: *y - 6.0, width: 18.0, height: 12.0, x: [0.0, 1.0], y: [0.0, 1.0] };
        let corners = sign.all(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
        solids::solid(c, &sign, &corners, passage);
        entry(c, x, y, passage.label());
    }
}

pub(in crate::figures) fn heading(c: &mut Canvas, x: f64, y: &mut f64, words: &str) {
    c.bold([x, *y + 4.0], SIZE, Anchor::Start, words);
    *y += LINE + 2.0;
}

pub(in crate::figures) fn entry(c: &mut Canvas, x: f64, y: &mut f64, words: &str) {
    c.text([x + 34.0, *y + 4.0], SIZE, Anchor::Start, words);
    *y += LINE;
}

/// A line as it is drawn, and what it is.
pub(in crate::figures) fn line(c: &mut Canvas, x: f64, y: &mut f64, style: &Style<'_>, words: &str) {
    c.line([x, *y], [x + 24.0, *y], style);
    entry(c, x, y, words);
}

/// A mark: whether it is there, how it is drawn, and what it is.
pub(in crate::figures) type Mark<'a> = (bool, fn(&mut Canvas, [f64; 2]), &'a str);

/// The marks that are there.
pub(in crate::figures) fn signs(c: &mut Canvas, x: f64, y: &mut f64, marks: &[Mark<'_>]) {
    for (_, draw, words) in marks.iter().filter(|m| m.0) {
        draw(c, [x + 12.0, *y]);
        entry(c, x, y, words);
    }
}

/// Direction and speed of the mean flow at each source.
fn flow(c: &mut Canvas, run: &RunReport<'_>, x: f64, y: &mut f64) {
    for s in run.sources {
        let speed = s.flow.norm();
        if speed < 1e-6 {
            continue;
        }
        let u = s.flow / speed;
        let m = [x + 12.0, *y + 4.0];
        let half = [11.0 * u.x, -11.0 * u.y];
        c.arrow([m[0] - half[0], m[1] - half[1]], [m[0] + half[0], m[1] + half[1]], FLOW, 2.0);
        let at = if run.sources.len() > 1 { s.id.as_str() } else { "the source" };
        let words = format!("flow at {at}");
        c.text([x + 34.0, *y], SIZE, Anchor::Start, &words);
        let value = format!("{:.2} m/s towards {:.0}°", speed, Heading::from_vector(s.flow).deg());
        c.text([x + 34.0, *y + 14.0], SIZE, Anchor::Start, &value);
        *y += 2.0 * LINE + 4.0;
    }
}

pub(in crate::figures) const BAR: f64 = 200.0;

fn depth_key(c: &mut Canvas, x: f64, y: &mut f64, bed: &Bed) {
    if bed.levels.is_empty() {
        let words = format!("Water depth {:.2} m", 0.5 * (bed.range[0] + bed.range[1]));
        c.bold([x, *y + 4.0], SIZE, Anchor::Start, &words);
        *y += LINE + 8.0;
        return;
    }
    heading(c, x, y, "Water depth (m)");
    let first = bed.levels[0] - bed.step;
    let n = bed.levels.len() + 1;
    let levels = (0..n).map(|k| {
        let v = first + k as f64 * bed.step;
        let label = if k > 0 { number(v, bed.step) } else { String::new() };
        (palette::depth(bed.shade(v)), label)
    });
    levels_key(c, x, y, "#7893a8", levels);
}

fn plume_key(c: &mut Canvas, x: f64, y: &mut f64, p: &PlumeLoad, t_s: f64) {
    let words = format!("Plume at {t_s:.0} s: load (mg/m²)");
    heading(c, x, y, &words);
    plume_levels(c, x, y, p);
}

/// Colours of a plume's levels, each with the amount at which it begins.
pub(super) fn plume_levels(c: &mut Canvas, x: f64, y: &mut f64, p: &PlumeLoad) {
    let last = (p.levels.len() - 1) as f64;
    let levels = p.levels.iter().enumerate();
    levels_key(c, x, y, "#5b7a5b", levels.map(|(k, v)| (palette::plume(k as f64 / last), short(*v))));
}

/// A bar of colours, and what stands below the beginning of each.
fn levels_key(
    c: &mut Canvas,
    x: f64,
    y: &mut f64,
    edge: &str,
    levels: impl ExactSizeIterator<Item = (String, String)>,
) {
    let w = BAR / levels.len() as f64;
    for (k, (colour, label)) in levels.enumerate() {
        let left = x + k as f64 * w;
        c.rect(left, *y - 7.0, w, 11.0, &Style::fill(&colour).edged(edge, 0.6));
        if !label.is_empty() {
            c.text([left, *y + 16.0], 9.0, Anchor::Middle, &label);
        }
    }
    *y += 36.0;
}

/// Text of a plume's level: plain if it is short, otherwise with a power of ten.
pub(in crate::figures) fn short(v: f64) -> String {
    let n = decade(v);
    if (-2..=3).contains(&n) {
        return number(v, v);
    }
    let digits = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let sign = if n < 0 { "⁻" } else { "" };
    let power: String =
        n.abs().to_string().chars().filter_map(|d| d.to_digit(10)).map(|d| digits[d as usize]).collect();
    let lead = (v / crate::charts::panel::power_of_ten(n)).round();
    if lead > 1.0 { format!("{lead}·10{sign}{power}") } else { format!("10{sign}{power}") }
}
