//! Where odour was believed to be, at chosen times: probability of detection, the odour's way to the vehicle, and the
//! vehicle's best way to the odour (products of Farrell, Pang & Li 2003 in addition to the source map).

use super::map::small_maps::{LEFT, axes, place, scale, shades, sheet, vehicle};
use super::marks;
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::panel::Panel;
use crate::results::RunReport;
use crate::results::belief_track::RobotBelief;
use robots::handoff::Odour;

const TOP: f64 = 62.0;
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
    let title = format!("{} · {}: where odour may be met", run.summary.headline(), robot.id);
    let (mut c, panels) = sheet(run, &title, times.len(), TOP, 30.0);
    for (panel, time) in panels.iter().zip(&times) {
        let o = &robot.odour[*time];
        one(&mut c, run, panel, o);
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
    vehicle(&mut c, [x, y - 4.0]);
    c.text([x + 9.0, y], 10.0, Anchor::Start, "vehicle");
    marks::true_source(&mut c, [x + 68.0, y - 4.0]);
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
    place(c, panel, run);
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
        vehicle(c, panel.position([p.x, p.y]));
    }
    marks::sources(c, panel, run);
    axes(c, panel);
}
