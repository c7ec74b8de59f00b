//! Time series of one robot: depth over the bed, altitude, reading, behaviour, and position error.

use super::layers_panel::layers;
use super::series_panels as panels;
use crate::charts::canvas::{Anchor, Canvas};
use crate::charts::panel::Panel;
use crate::results::{RobotTrack, RunReport};
use robots::handoff::region_name;

const LEFT: f64 = 92.0;
const WIDTH: f64 = 800.0;
const GAP: f64 = 16.0;
const HEIGHT: f64 = 128.0;

/// The series of one robot as SVG.
pub fn series(run: &RunReport<'_>, t: &RobotTrack) -> String {
    let mut kinds: Vec<panels::Draw> =
        vec![panels::depth, panels::altitude, panels::reading, panels::behaviour, panels::position_error];
    if !t.layers.is_empty() {
        kinds.insert(4, layers);
    }
    let high = 40.0 + kinds.len() as f64 * (HEIGHT + GAP) + 44.0;
    let mut c = Canvas::new(LEFT + WIDTH + 24.0, high);
    let title = format!("{} · {}", run.summary.headline(), t.info.id);
    c.bold([LEFT, 24.0], 13.0, Anchor::Start, &title);
    let end = t.rows.last().map_or(1.0, |r| r.t_s);
    let begin = t.rows.first().map_or(0.0, |r| r.t_s);
    let x = [begin, if end > begin { end } else { begin + 1.0 }];
    for (k, draw) in kinds.iter().enumerate() {
        let panel =
            Panel { left: LEFT, top: 38.0 + k as f64 * (HEIGHT + GAP), width: WIDTH, height: HEIGHT, x, y: [0.0, 1.0] };
        draw(&mut c, panel, t);
        panel.frame(&mut c, 1.0);
        panel.x_ticks(&mut c, k + 1 == kinds.len(), 11.0);
        for d in &t.declarations {
            let words = match (k, d.at_edge(), d.region) {
                (0, true, Some(of)) => format!("edge of {}", region_name(of)),
                (0, ..) => "declared".to_owned(),
                _ => String::new(),
            };
            panels::event(&mut c, &panel, d.t_s, &words);
        }
    }
    let below = c.height - 12.0;
    c.text([LEFT + WIDTH / 2.0, below], 12.0, Anchor::Middle, "Mission time (s)");
    c.svg(&format!("series{}", t.info.id))
}
