//! A sidescan's record of a declared place: its last passes as waterfalls, and all passes placed where the vehicle
//! believed itself to be.

use super::marks;
use super::shaded_cells::{self, ShadedCells};
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::palette;
use crate::charts::panel::Panel;
use crate::results::{RobotEchoes, RobotTrack, RunReport};
use eyes::sidescan::{CELL_M, Row, Waterfall, detect};
use robots::strategy::DetectSpec;

/// Largest number of waterfalls, and the greatest length shown of one, m.
const MOST: usize = 3;
const LONGEST_M: f64 = 80.0;
/// Passes farther than this from the declared place belong to another place, m.
const NEAR_M: f64 = 80.0;
/// Half the width of the map, m, and its cells.
const HALF_M: f64 = 25.0;
const MAP_CELL_M: f64 = 0.4;
/// Pixels per metre of waterfall, and of map.
const WATERFALL_PX: f64 = 5.6;
const MAP_PX: f64 = 9.0;
/// Number of lines and columns of a waterfall that are drawn as one cell.
const BLOCK: usize = 2;
/// Range of levels shown below and above the middle one, dB, and the number of shades for it.
const RANGE_DB: [f64; 2] = [-14.0, 18.0];
const SHADES: usize = 12;
/// Colour of the source's place by the sidescan.
const FOUND: &str = "#56b4e9";

/// Distance between places in the plane, m.
fn apart(a: [f64; 2], b: [f64; 2]) -> f64 {
    let d = [a[0] - b[0], a[1] - b[1]];
    (d[0] * d[0] + d[1] * d[1]).sqrt()
}

/// The figure as SVG; `None` without a pass.
pub fn sidescan(run: &RunReport<'_>, robot: &RobotEchoes) -> Option<String> {
    let track = run.track.robots.iter().find(|t| t.info.id == robot.id);
    let declared = track.and_then(|t| t.declared().last());
    let middle = |w: &Waterfall| {
        let row = &w.rows()[w.rows().len() / 2];
        [row.place.x, row.place.y]
    };
    let near = |w: &&Waterfall| declared.is_none_or(|d| apart(middle(w), d) < NEAR_M);
    let mut passes: Vec<&Waterfall> = robot.passes().filter(near).collect();
    if passes.is_empty() {
        passes = robot.passes().collect();
    }
    let last = *passes.last()?;
    // Short pieces between two turns are drawn on the map, but are no passes to show.
    let long_m = 0.5 * passes.iter().map(|w| length_m(w)).fold(0.0, f64::max);
    let mut shown: Vec<&Waterfall> = (passes.iter().copied()).filter(|w| length_m(w) >= long_m).collect();
    shown.drain(..shown.len().saturating_sub(MOST));
    let level = Levels::from_passes(&passes);
    let longest = shown.iter().map(|w| length_m(w)).fold(0.0, f64::max).min(LONGEST_M);
    let range_m = shown.iter().flat_map(|w| w.rows()).map(|r| r.port_db.len()).max()? as f64 * CELL_M;
    let (wide, high) = (2.0 * range_m * WATERFALL_PX, longest * WATERFALL_PX);
    let map_px = 2.0 * HALF_M * MAP_PX;
    let (left, top, gap) = (64.0, 66.0, 62.0);
    let map_left = left + shown.len() as f64 * (wide + gap);
    let mut c = Canvas::new(map_left + map_px + 30.0, top + high.max(map_px) + 110.0);
    let title = format!("{} · {}: sidescan of the declared place", run.summary.headline(), robot.id);
    c.bold([left, 24.0], 13.0, Anchor::Start, &title);
    for (k, pass) in shown.iter().enumerate() {
        let length = length_m(pass).min(LONGEST_M);
        let panel = Panel {
            left: left + k as f64 * (wide + gap),
            top: top + high - length * WATERFALL_PX,
            width: wide,
            height: length * WATERFALL_PX,
            x: [-range_m, range_m],
            y: [0.0, length],
        };
        waterfall(&mut c, &panel, pass, &level);
        let from = pass.rows()[0].t_s;
        let caption = format!("Pass from {from:.0} s · port | starboard, m");
        c.bold([panel.left, top - 8.0], 10.5, Anchor::Start, &caption);
    }
    c.upright([18.0, top + 0.5 * high], 10.5, "Way along the pass, m");
    let centre = declared.unwrap_or_else(|| middle(last));
    let panel = Panel {
        left: map_left,
        top,
        width: map_px,
        height: map_px,
        x: [centre[0] - HALF_M, centre[0] + HALF_M],
        y: [centre[1] - HALF_M, centre[1] + HALF_M],
    };
    c.bold([map_left, top - 8.0], 10.5, Anchor::Start, "All passes by believed place; east, north, m");
    mosaic(&mut c, &panel, &passes, &level);
    signs(&mut c, &panel, run, robot, track);
    let y = top + high.max(map_px) + 46.0;
    key(&mut c, [left, y], run, robot);
    Some(c.svg(&format!("sidescan{}", robot.id)))
}

fn length_m(w: &Waterfall) -> f64 {
    let rows = w.rows();
    rows[rows.len() - 1].along_m - rows[0].along_m
}

/// Shades over the levels.
struct Levels {
    middle_db: f64,
}

impl Levels {
    fn from_passes(passes: &[&Waterfall]) -> Self {
        let rows = passes.iter().flat_map(|w| w.rows()).step_by(7);
        let levels = rows.flat_map(|r| r.port_db.iter().chain(&r.starboard_db));
        let mut all: Vec<f32> = levels.copied().filter(|v| v.is_finite()).collect();
        all.sort_by(f32::total_cmp);
        Self { middle_db: all.get(all.len() / 2).map_or(0.0, |v| f64::from(*v)) }
    }

    fn shade(&self, db: f64) -> usize {
        let share = (db - self.middle_db - RANGE_DB[0]) / (RANGE_DB[1] - RANGE_DB[0]);
        (share * SHADES as f64).clamp(0.0, SHADES as f64 - 1.0) as usize
    }
}

/// A line of cells between two `y` values, each `width` wide, from `x` on.
fn line(cells: &mut ShadedCells, panel: &Panel, [x, width]: [f64; 2], y: [f64; 2], shades: &[Option<usize>]) {
    let at = |k: usize| x + k as f64 * width;
    let corners = |from, to| [[at(from), y[0]], [at(to), y[0]], [at(to), y[1]], [at(from), y[1]]];
    cells.line(shades, |from, to| corners(from, to).map(|p| panel.position(p)));
}

/// Mean of the finite levels.
fn mean<'a>(levels: impl Iterator<Item = &'a f32>) -> Option<f64> {
    let (mut sum, mut n) = (0.0, 0);
    for v in levels.filter(|v| v.is_finite()) {
        sum += f64::from(*v);
        n += 1;
    }
    (n > 0).then(|| sum / f64::from(n))
}

fn waterfall(c: &mut Canvas, panel: &Panel, pass: &Waterfall, level: &Levels) {
    let rows = pass.rows();
    let begin = rows[0].along_m;
    let width = BLOCK as f64 * CELL_M;
    panel.clip_black(c);
    let mut cells = ShadedCells::new(SHADES);
    for lines in rows.chunks(BLOCK) {
        let along = |r: &Row| r.along_m - begin;
        let y = [along(&lines[0]), along(&lines[lines.len() - 1]) + pass.line_m()];
        for port in [true, false] {
            let n = lines.iter().map(|r| r.side(port).len()).min().unwrap_or(0) / BLOCK;
            let shade = |k: usize| {
                let block = lines.iter().flat_map(|r| &r.side(port)[k * BLOCK..(k + 1) * BLOCK]);
                mean(block).map(|db| level.shade(db))
            };
            let mut shades: Vec<_> = (0..n).map(shade).collect();
            let mut x = 0.0;
            if port {
                shades.reverse();
                x = -(n as f64) * width;
            }
            line(&mut cells, panel, [x, width], y, &shades);
        }
    }
    cells.draw(c, palette::echo, 0.3);
    for o in detect(pass, &DetectSpec::default()) {
        let side = if o.port { -1.0 } else { 1.0 };
        let at = panel.position([side * o.ground_m, o.along_m - begin]);
        c.circle(at, 11.0, &Style::line("#ffffff", 3.2));
        c.circle(at, 11.0, &Style::line(FOUND, 1.8));
    }
    c.unclip();
    panel.axes(c, 50.0, 10.0);
}

fn mosaic(c: &mut Canvas, panel: &Panel, passes: &[&Waterfall], level: &Levels) {
    let n = (2.0 * HALF_M / MAP_CELL_M) as usize;
    let mut sums = vec![(0.0, 0u32); n * n];
    for pass in passes {
        for row in pass.rows() {
            for port in [true, false] {
                for (k, db) in row.side(port).iter().enumerate() {
                    let p = row.ground_position(port, (k as f64 + 0.5) * CELL_M);
                    let at = [(p.x - panel.x[0]) / MAP_CELL_M, (p.y - panel.y[0]) / MAP_CELL_M];
                    let inside = at.iter().all(|v| *v >= 0.0 && *v < n as f64);
                    if inside && db.is_finite() {
                        let cell = &mut sums[at[1] as usize * n + at[0] as usize];
                        *cell = (cell.0 + f64::from(*db), cell.1 + 1);
                    }
                }
            }
        }
    }
    panel.clip_black(c);
    let mut cells = ShadedCells::new(SHADES);
    for j in 0..n {
        let of = |(sum, m): &(f64, u32)| (*m > 0).then(|| level.shade(sum / f64::from(*m)));
        let shades: Vec<_> = sums[j * n..(j + 1) * n].iter().map(of).collect();
        let y = panel.y[0] + j as f64 * MAP_CELL_M;
        line(&mut cells, panel, [panel.x[0], MAP_CELL_M], [y, y + MAP_CELL_M], &shades);
    }
    cells.draw(c, palette::echo, 0.3);
    for pass in passes {
        let line = pass.rows().iter().map(|r| panel.position([r.place.x, r.place.y])).collect();
        c.polyline(line, &Style::line("#ffffff", 0.8).dashed("4 4").faint(0.7));
    }
    c.unclip();
}

/// Marks on the map: the declared place, the sidescan's, true sources and solids.
fn signs(c: &mut Canvas, panel: &Panel, run: &RunReport<'_>, robot: &RobotEchoes, track: Option<&RobotTrack>) {
    panel.clip(c);
    for o in run.obstacles {
        c.polygon(panel.all(&o.corners), &Style::line("#ffffff", 1.2));
    }
    marks::sources(c, panel, run);
    if let Some(d) = track.and_then(|t| t.declared().last()) {
        marks::declared(c, panel.position(d));
    }
    if let Some(p) = surveyed(run, robot) {
        found(c, panel.position(p));
    }
    c.unclip();
    panel.axes(c, 50.0, 10.0);
}

fn surveyed(run: &RunReport<'_>, robot: &RobotEchoes) -> Option<[f64; 2]> {
    let r = run.summary.robots.iter().find(|r| r.id == robot.id)?;
    let p = r.declarations.last()?.surveyed?;
    Some([p.east_m, p.north_m])
}

fn found(c: &mut Canvas, at: [f64; 2]) {
    for (colour, width) in [("#ffffff", 4.0), (FOUND, 2.0)] {
        c.circle(at, 9.0, &Style::line(colour, width));
    }
}

fn key(c: &mut Canvas, [x, y]: [f64; 2], run: &RunReport<'_>, robot: &RobotEchoes) {
    c.text([x, y], 10.0, Anchor::Start, "Level over the bed's, dB:");
    let colours = (0..SHADES).map(|shade| palette::echo(shade as f64 / (SHADES - 1) as f64));
    let end = shaded_cells::scale(c, [x + 140.0, y], colours);
    c.text([x + 140.0, y + 14.0], 9.0, Anchor::Middle, &format!("−{:.0}", -RANGE_DB[0]));
    c.text([end, y + 14.0], 9.0, Anchor::Middle, &format!("{:.0}", RANGE_DB[1]));
    let y = y + 34.0;
    marks::true_source(c, [x + 6.0, y - 4.0]);
    c.text([x + 17.0, y], 10.0, Anchor::Start, "true source");
    marks::declared(c, [x + 106.0, y - 4.0]);
    c.text([x + 118.0, y], 10.0, Anchor::Start, "declared");
    found(c, [x + 190.0, y - 4.0]);
    c.text([x + 205.0, y], 10.0, Anchor::Start, "by the sidescan; object in a pass (detector's defaults)");
    let said = run.summary.robots.iter().find(|r| r.id == robot.id);
    if let Some(d) = said.and_then(|r| r.declarations.last()) {
        let mut words = format!("{:?}.", d.verdict);
        if let Some(e) = &d.error {
            words += &format!(" Declared {:.1} m from the true source", e.total_m);
        }
        if let Some(e) = &d.surveyed_error {
            words += &format!("; by the sidescan {:.1} m from it", e.total_m);
        }
        c.rimmed([x, y + 20.0], 10.5, Anchor::Start, &words);
    }
}
