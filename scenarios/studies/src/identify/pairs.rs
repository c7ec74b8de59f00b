//! The draws by each pair of unknowns, and each unknown alone.

use super::draws::Unknown;
use super::{Identification, JudgedDraw};
use crate::distribution::Distribution as Prior;
use output::charts::canvas::{Anchor, Canvas, Style};
use output::charts::panel::Panel;
use world::math;

/// Size of a panel, and room on the left and above, px.
const CELL: f64 = 92.0;
const ROOM: [f64; 2] = [120.0, 30.0];
/// Bars of an unknown alone.
const BARS: usize = 11;

/// Where an unknown's values lie on an axis from 0 to 1.
fn place(unknown: &Unknown, d: &JudgedDraw) -> Option<f64> {
    let value = unknown.number(d)?;
    Some(match &unknown.prior {
        Prior::Uniform(a, b) => (value - a) / (b - a),
        Prior::LogUniform(a, b) => math::ln(value / a) / math::ln(b / a),
        Prior::Choice(all) => {
            let n = all.iter().position(|v| Some(v.as_str()) == d.draw.value(&unknown.path))?;
            (n as f64 + 0.5) / all.len() as f64
        }
    })
}

/// The ends of an axis in words.
fn ends(unknown: &Unknown) -> [String; 2] {
    match &unknown.prior {
        Prior::Uniform(a, b) | Prior::LogUniform(a, b) => [a.to_string(), b.to_string()],
        Prior::Choice(all) => [all.first(), all.last()].map(|v| v.cloned().unwrap_or_default()),
    }
}

/// The picture of the accepted draws: below the diagonal pairs, on it each unknown alone, with the line
/// that all bars would reach if nothing were known.
pub(super) fn pairs(found: &Identification) -> String {
    let unknowns: Vec<&Unknown> = found.marginals.iter().map(|m| &m.unknown).collect();
    let n = unknowns.len();
    let size = |room: f64| room + CELL * n as f64 + 40.0;
    let mut c = Canvas::new(size(ROOM[0]), size(ROOM[1]));
    let draws = &found.draws[..found.accepted];
    for row in 0..n {
        for column in 0..=row {
            let panel = Panel {
                left: ROOM[0] + CELL * column as f64,
                top: ROOM[1] + CELL * row as f64,
                width: CELL - 6.0,
                height: CELL - 6.0,
                x: [0.0, 1.0],
                y: [0.0, 1.0],
            };
            panel.clip(&mut c);
            if row == column {
                bars(&mut c, &panel, unknowns[row], draws);
            } else {
                for d in draws {
                    if let Some(at) = place(unknowns[column], d).zip(place(unknowns[row], d)) {
                        c.circle(panel.position([at.0, at.1]), 2.5, &Style::fill("#7a4fa3").faint(0.5));
                    }
                }
            }
            c.unclip();
            panel.frame(&mut c, 0.8);
            if column == 0 {
                c.text([ROOM[0] - 6.0, panel.top + 0.5 * panel.height], 10.0, Anchor::End, unknowns[row].name());
            }
            if row + 1 == n {
                let [low, high] = ends(unknowns[column]);
                c.text([panel.left, panel.bottom() + 11.0], 8.0, Anchor::Start, &low);
                c.text([panel.right(), panel.bottom() + 11.0], 8.0, Anchor::End, &high);
                let middle = panel.left + 0.5 * panel.width;
                c.text([middle, panel.bottom() + 24.0], 9.0, Anchor::Middle, unknowns[column].name());
            }
        }
    }
    c.svg("pairs")
}

fn bars(c: &mut Canvas, panel: &Panel, unknown: &Unknown, draws: &[JudgedDraw]) {
    let n = match &unknown.prior {
        Prior::Choice(all) => all.len(),
        _ => BARS,
    };
    let mut shares = vec![0.0; n];
    for d in draws {
        if let Some(at) = place(unknown, d) {
            shares[((at * n as f64) as usize).min(n - 1)] += 1.0 / draws.len() as f64;
        }
    }
    let most = shares.iter().fold(1.0 / n as f64, |most: f64, s| most.max(*s));
    for (k, share) in shares.iter().enumerate() {
        let [left, right] = [k, k + 1].map(|k| panel.px(k as f64 / n as f64));
        let top = panel.py(0.95 * share / most);
        c.rect(left + 1.0, top, right - left - 2.0, panel.bottom() - top, &Style::fill("#7a4fa3"));
    }
    let even = 0.95 / (n as f64 * most);
    c.line(panel.position([0.0, even]), panel.position([1.0, even]), &Style::line("#444444", 1.0).dashed("4 3"));
}
