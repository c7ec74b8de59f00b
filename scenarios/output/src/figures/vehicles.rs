//! What tells vehicles apart on a map where there are several: a band round each track, and fainter ends.

use crate::charts::canvas::{Canvas, Style};
use crate::charts::palette;
use crate::charts::panel::Panel;
use crate::figures::thinned::thinned;
use crate::results::RobotTrack;
use robots::handoff::Behaviour;

/// Opacity of a vehicle's band.
pub(super) const BAND: f64 = 0.85;
/// Opacity of what a vehicle does after its mission.
pub(super) const AFTER: f64 = 0.22;
/// Width of a band, px.
pub(super) const WIDTH: f64 = 5.0;

/// Index of the row from which the vehicle's mission is over and stays so; the number of rows if it never is.
pub(super) fn over_from(t: &RobotTrack) -> usize {
    let done = (t.rows.iter().rev()).take_while(|r| r.behaviour == Behaviour::Done);
    t.rows.len() - done.count()
}

/// A band in the vehicle's colour, over which its track is drawn; it ends with the mission.
pub(super) fn band(c: &mut Canvas, panel: &Panel, t: &RobotTrack, k: usize) {
    let end = (over_from(t) + 1).min(t.rows.len());
    let points = thinned(t.rows[..end].iter().map(|r| panel.position([r.p[0], r.p[1]])));
    let style = Style::line(palette::vehicle(k), WIDTH);
    c.polyline(points, &style.faint(BAND));
}
