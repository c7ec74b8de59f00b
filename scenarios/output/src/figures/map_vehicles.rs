//! What tells vehicles apart on a map where there are several: a band round each track, and fainter ends.

use super::map_layers::thinned;
use super::map_legend::{entry, heading};
use crate::charts::canvas::{Canvas, Style};
use crate::charts::palette;
use crate::charts::panel::Panel;
use crate::results::{RobotTrack, RunReport};
use robots::handoff::Behaviour;

/// Opacity of a vehicle's band.
const BAND: f64 = 0.85;
/// Opacity of what a vehicle does after its mission.
pub(super) const AFTER: f64 = 0.22;
/// Width of a band, px.
const WIDTH: f64 = 5.0;

/// Index of the row from which the vehicle's mission is over and stays so; the number of rows if it never is.
pub(super) fn over_from(t: &RobotTrack) -> usize {
    let done = (t.rows.iter().rev()).take_while(|r| r.behaviour == Behaviour::Done);
    t.rows.len() - done.count()
}

/// A band in the vehicle's colour, over which its track is drawn; it ends with the mission.
pub(super) fn band(c: &mut Canvas, panel: &Panel, t: &RobotTrack, k: usize) {
    let end = (over_from(t) + 1).min(t.rows.len());
    let points = thinned(t.rows[..end].iter().map(|r| panel.at([r.p[0], r.p[1]])));
    let style = Style::line(palette::vehicle(k), WIDTH);
    c.polyline(points, &style.faint(BAND));
}

/// Keys of the bands, if there are several vehicles; returns where they end.
pub(super) fn keys(c: &mut Canvas, run: &RunReport<'_>, [x, top]: [f64; 2]) -> f64 {
    let robots = &run.track.robots;
    if robots.len() < 2 {
        return top;
    }
    let mut y = top + 6.0;
    heading(c, x, &mut y, "Vehicle, by the band round its track");
    for (k, t) in robots.iter().enumerate() {
        let style = Style::line(palette::vehicle(k), WIDTH).faint(BAND);
        c.line([x, y], [x + 24.0, y], &style);
        entry(c, x, &mut y, &t.info.id);
    }
    if robots.iter().any(|t| over_from(t) < t.rows.len()) {
        let style = Style::line(palette::behaviour(Behaviour::Done), 2.6).faint(AFTER);
        c.line([x, y], [x + 24.0, y], &style);
        entry(c, x, &mut y, "after the end of its mission");
    }
    y
}
