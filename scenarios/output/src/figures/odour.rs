//! Where odour was believed to be, at chosen times: probability of detection, the odour's way to the vehicle, and the
//! vehicle's best way to the odour (products of Farrell, Pang & Li 2003 in addition to the source map).

use super::belief::{axes, bounds, scale, shades};
use super::map_layers as layers;
use super::solids;
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::palette::INK;
use crate::charts::panel::Panel;
use crate::results::RunReport;
use crate::results::belief_track::RobotBelief;
use robots::handoff::Odour;

/// Largest panel, px.
const LARGEST: [f64; 2] = [560.0, 430.0];
const LEFT: f64 = 66.0;
const TOP: f64 = 62.0;
const GAP: [f64; 2] = [70.0, 92.0];
/// Largest number of panels.
const PANELS: usize = 4;
/// The odour's way, and the vehicle's.
const CAME: &str = "#009e73";
const WALK: &str = "#0072b2";

/// What one robot's map said about the odour, as SVG.
pub fn odour(run: &RunReport<'_>, robot: &RobotBelief) -> String {
    let last = robot.odour.len() - 1;
    let mut times: Vec<usize> = (0..PANELS).map(|k| k * last / (PANELS - 1)).collect();
    times.dedup();
    let (x, y) = bounds(run);
    let px = (LARGEST[0] / (x[1] - x[0])).min(LARGEST[1] / (y[1] - y[0]));
    let (width, height) = ((x[1] - x[0]) * px, (y[1] - y[0]) * px);
    let step = width.max(250.0) + GAP[0];
    let mut c = Canvas::new(
        LEFT + times.len().min(2) as f64 * step,
        TOP + times.len().div_ceil(2) as f64 * (height + GAP[1]) + 30.0,
    );
    let title = format!("{} · {}: where odour may be met", run.summary.headline(), robot.id);
    c.bold([LEFT, 24.0], 13.0, Anchor::Start, &title);
    for (k, time) in times.iter().enumerate() {
        let panel = Panel {
            left: LEFT + (k % 2) as f64 * step,
            top: TOP + (k / 2) as f64 * (height + GAP[1]),
            width,
            height,
            x,
            y,
        };
        let o = &robot.odour[*time];
        one(&mut c, run, &panel, o);
        let caption = format!("t = {:.0} s", o.t_s);
        c.bold([panel.left, panel.top - 8.0], 11.0, Anchor::Start, &caption);
        let most = o.detection.iter().fold(0.0, |m: f64, p| m.max(*p));
        let missed: f64 = o.walk.iter().skip(1).map(|cell| 1.0 - o.detection[*cell]).product();
        let numbers = format!(
            "largest chance of detection {most:.3}; on the way of {} cells {:.3}",
            o.walk.len().saturating_sub(1),
            1.0 - missed
        );
        c.text([panel.left, panel.bottom() + 48.0], 10.0, Anchor::Start, &numbers);
    }
    let at = [LEFT, c.height - 34.0];
    scale(&mut c, at, "Chance of detection, share of the largest:", LEFT + 240.0);
    let y = at[1] + 28.0;
    let keys = [(0.0, CAME, "way of odour to the vehicle"), (190.0, WALK, "way most likely to meet it")];
    let x = LEFT + 380.0;
    let vehicle = Style::fill(WALK).edged("#ffffff", 1.2);
    c.circle([x, y - 4.0], 4.0, &vehicle);
    c.text([x + 9.0, y], 10.0, Anchor::Start, "vehicle");
    layers::true_source(&mut c, [x + 68.0, y - 4.0]);
    c.text([x + 79.0, y], 10.0, Anchor::Start, "true source");
    for (from, colour, words) in keys {
        let x = LEFT + from;
        c.line([x, y - 4.0], [x + 26.0, y - 4.0], &Style::line(colour, 2.2));
        c.text([x + 31.0, y], 10.0, Anchor::Start, words);
    }
    c.svg(&format!("odour{}", robot.id))
}

fn one(c: &mut Canvas, run: &RunReport<'_>, panel: &Panel, o: &Odour) {
    panel.clip(c);
    let layer = o.grid.n[0] * o.grid.n[1];
    // The greatest value over all depths.
    let mut plan = vec![0.0_f64; layer];
    for (i, p) in o.detection.iter().enumerate() {
        plan[i % layer] = plan[i % layer].max(*p);
    }
    shades(c, panel, &o.grid, &plan);
    let corners = run.area.corners().map(|p| [p.x, p.y]);
    c.polygon(panel.all(&corners), &Style::line(INK, 1.2).dashed("7 4"));
    for below in [true, false] {
        solids::draw(c, panel, run.obstacles, run.terrain, below);
    }
    for (cells, colour) in [(&o.came, CAME), (&o.walk, WALK)] {
        let line = || {
            let points = cells.iter().map(|cell| o.grid.centre(*cell));
            points.map(|p| panel.position([p.x, p.y])).collect()
        };
        c.polyline(line(), &Style::line("#ffffff", 4.0).faint(0.7));
        c.polyline(line(), &Style::line(colour, 2.2));
    }
    if let Some(cell) = o.walk.first() {
        let p = o.grid.centre(*cell);
        c.circle(panel.position([p.x, p.y]), 4.0, &Style::fill(WALK).edged("#ffffff", 1.2));
    }
    layers::sources(c, panel, run);
    c.unclip();
    panel.frame(c, 1.0);
    axes(c, panel);
}
