//! How the maps converged: distance to the true source, entropy and credible region of all robots, side by side.

use super::belief::remark;
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::panel::{Panel, decade, power_of_ten, range_of};
use crate::results::RunReport;
use crate::results::belief_track::{BeliefRow, RobotBelief, off};
use world::math;

const LEFT: f64 = 92.0;
const WIDTH: f64 = 760.0;
const HEIGHT: f64 = 170.0;
const GAP: f64 = 22.0;
/// Colours that the colour-blind can tell apart (Okabe & Ito 2008).
const COLOURS: [&str; 6] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"];
/// Most points of a curve.
const POINTS: usize = 3000;

/// The convergence of all robots' maps as SVG.
pub fn convergence(run: &RunReport<'_>) -> String {
    let robots = &run.beliefs.robots;
    let unit = if robots.iter().all(|r| r.last.belief.grid.n[2] == 1) { "m²" } else { "m² or m³" };
    let mut c = Canvas::new(LEFT + WIDTH + 24.0, 58.0 + 3.0 * (HEIGHT + GAP) + 40.0);
    let title = format!("{} · maps of the source", run.summary.headline());
    c.bold([LEFT, 22.0], 13.0, Anchor::Start, &title);
    // Under the names of the curves, one line for each robot whose map is certain of a wrong place.
    let remarks: Vec<String> =
        (robots.iter()).filter_map(|r| remark(run, &r.id).map(|words| format!("{}: {words}", r.id))).collect();
    let top = 48.0 + 16.0 * remarks.len() as f64;
    c.height += 16.0 * remarks.len() as f64;
    for (k, words) in remarks.iter().enumerate() {
        c.text([LEFT, 56.0 + 16.0 * k as f64], 10.5, Anchor::Start, words);
    }
    let times = robots.iter().flat_map(|r| r.rows.iter().map(|r| r.t_s));
    let t = range_of(times, 0.0).unwrap_or([0.0, 1.0]);
    let x = [t[0], if t[1] > t[0] { t[1] } else { t[0] + 1.0 }];
    let log10 = |v: f64| math::ln(v.max(1e-9)) / std::f64::consts::LN_10;
    type Value<'a> = Box<dyn Fn(&BeliefRow) -> Option<f64> + 'a>;
    let panels: [(String, bool, Value); 3] = [
        ("Off the source (m)".into(), false, Box::new(|r| off(&r.best, run.sources))),
        ("Entropy (nat)".into(), false, Box::new(|r| Some(r.entropy_nat))),
        (format!("95 % region ({unit})"), true, Box::new(|r| Some(log10(r.credible_95)))),
    ];
    for (k, (label, log, value)) in panels.iter().enumerate() {
        let values = robots.iter().flat_map(|r| r.rows.iter().filter_map(value));
        let range = range_of(values, 0.05).unwrap_or([0.0, 1.0]);
        let y = if *log { range } else { [range[0].min(0.0), range[1]] };
        let panel = Panel { left: LEFT, top: top + k as f64 * (HEIGHT + GAP), width: WIDTH, height: HEIGHT, x, y };
        if *log {
            decades(&mut c, &panel);
        } else {
            panel.grid(&mut c, 40.0);
            panel.y_ticks(&mut c, 40.0, 10.0);
        }
        c.upright([24.0, panel.top + HEIGHT / 2.0], 11.0, label);
        panel.clip(&mut c);
        for (n, robot) in robots.iter().enumerate() {
            let colour = COLOURS[n % COLOURS.len()];
            curve(&mut c, &panel, robot, value, colour);
            if let Some(first) = &robot.first {
                let at = panel.px(first.belief.t_s);
                let style = Style::line(colour, 1.0).dashed("2 3");
                c.line([at, panel.top], [at, panel.bottom()], &style);
            }
        }
        c.unclip();
        panel.frame(&mut c, 1.0);
        panel.x_ticks(&mut c, k == 2, 11.0);
    }
    for (n, robot) in robots.iter().enumerate() {
        let at = LEFT + n as f64 * 130.0;
        let colour = COLOURS[n % COLOURS.len()];
        c.line([at, 36.0], [at + 22.0, 36.0], &Style::line(colour, 2.0));
        c.text([at + 27.0, 40.0], 10.0, Anchor::Start, &robot.id);
    }
    let below = c.height - 12.0;
    let middle = LEFT + WIDTH / 2.0;
    let words = "Mission time (s); dotted: first detection";
    c.text([middle, below], 12.0, Anchor::Middle, words);
    c.svg("convergence")
}

fn curve(c: &mut Canvas, panel: &Panel, robot: &RobotBelief, value: &dyn Fn(&BeliefRow) -> Option<f64>, colour: &str) {
    let stride = robot.rows.len().div_ceil(POINTS).max(1);
    let mut points: Vec<[f64; 2]> = Vec::new();
    for r in robot.rows.iter().step_by(stride) {
        let Some(v) = value(r) else { continue };
        let p = panel.position([r.t_s, v]);
        // A value holds until the next update, so the curve has steps, not slopes.
        if let Some(before) = points.last() {
            points.push([p[0], before[1]]);
        }
        points.push(p);
    }
    c.polyline(points, &Style::line(colour, 1.6));
}

/// Lines and numbers at powers of ten, for logarithmic values.
fn decades(c: &mut Canvas, panel: &Panel) {
    for d in panel.y[0].ceil() as i32..=panel.y[1].floor() as i32 {
        let y = panel.py(f64::from(d));
        panel.mark_y(c, y);
        let v = power_of_ten(d);
        let text = if decade(v) < 0 { format!("{v}") } else { format!("{v:.0}") };
        c.text([panel.left - 7.0, y + 3.6], 10.0, Anchor::End, &text);
    }
}
