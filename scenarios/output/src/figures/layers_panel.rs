//! Which layer controlled the vehicle: the layers of a subsumption planner over time, the highest at the top.

use super::series_panels::{BLUE, ORANGE};
use crate::charts::canvas::{Anchor, Canvas, Style};
use crate::charts::panel::Panel;
use crate::results::RobotTrack;
use robots::handoff::LayerState;

const INHIBITED: &str = "#c9c9c9";

/// Colour of a state, and its share of the row's height; silent layers are not drawn.
fn bar(state: LayerState) -> Option<(&'static str, f64)> {
    match state {
        LayerState::Silent => None,
        LayerState::Holds => Some((BLUE, 0.72)),
        LayerState::Suppressed => Some((ORANGE, 0.34)),
        LayerState::Inhibited => Some((INHIBITED, 0.34)),
    }
}

/// One row for each layer: a thick bar where it controls the vehicle, a thin one where a higher layer prevents that.
pub(super) fn layers(c: &mut Canvas, panel: Panel, t: &RobotTrack) {
    let n = t.layers.first().map_or(0, |l| l.1.len());
    let row = panel.height / n.max(1) as f64;
    let end = t.rows.last().map_or(0.0, |r| r.t_s);
    for k in 0..n {
        let top = panel.top + (n - 1 - k) as f64 * row;
        if k + 1 < n {
            let line = Style::line("#e3e3e3", 0.7);
            c.line([panel.left, top], [panel.right(), top], &line);
        }
        let at = [panel.left - 7.0, top + row / 2.0 + 3.5];
        c.text(at, 9.5, Anchor::End, t.layers[0].1[k].name);
        let mut i = 0;
        while i < t.layers.len() {
            let (begin, state) = (t.layers[i].0, t.layers[i].1[k].state);
            // Changes of other layers do not interrupt the bar.
            let rest = t.layers[i..].iter();
            i += rest.take_while(|l| l.1[k].state == state).count();
            let until = t.layers.get(i).map_or(end, |l| l.0);
            if let Some((colour, high)) = bar(state) {
                let (x0, x1) = (panel.px(begin), panel.px(until));
                let y = top + 0.5 * (1.0 - high) * row;
                c.rect(x0, y, (x1 - x0).max(0.6), high * row, &Style::fill(colour));
            }
        }
    }
    let states =
        [("holds", LayerState::Holds), ("suppressed", LayerState::Suppressed), ("inhibited", LayerState::Inhibited)];
    let mut x = panel.right();
    for (words, state) in states.iter().rev() {
        let colour = bar(*state).map_or(INHIBITED, |b| b.0);
        c.text([x, panel.top - 4.0], 9.5, Anchor::End, words);
        let begin = x - 6.0 * words.chars().count() as f64 - 22.0;
        let key = Style::line(colour, 4.0);
        c.line([begin, panel.top - 7.0], [begin + 16.0, panel.top - 7.0], &key);
        x = begin - 14.0;
    }
}
