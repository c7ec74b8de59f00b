//! Solid things on a sheet. Where water and dye pass under, over or through a solid, it must not hide the plume.

use crate::charts::canvas::{Canvas, Style};
use crate::charts::palette::INK;
use crate::charts::panel::Panel;
use crate::results::ObstacleOutline;
use world::terrain::Terrain;

const FILL: &str = "#8c6d4f";
/// A gap above or below an obstacle counts from this part of the depth on.
const GAP: f64 = 0.02;
/// Distance between the lines of a hatch, px.
const HATCH_PX: f64 = 7.0;

/// How water passes an obstacle, other than round it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Passage {
    /// The solid fills the water from bed to surface.
    Round,
    /// It stands on the bed and ends under water.
    Over,
    /// It hangs or floats.
    Under,
    /// The scenario declares it permeable.
    Through,
}

impl Passage {
    pub(super) const ALL: [Passage; 4] = [Passage::Round, Passage::Over, Passage::Under, Passage::Through];

    /// Its words in the key.
    pub(super) fn label(self) -> &'static str {
        match self {
            Passage::Round => "obstacle",
            Passage::Over => "obstacle with water over it",
            Passage::Under => "obstacle with water under it",
            Passage::Through => "obstacle, dye passes through",
        }
    }

    /// Whether the plume is drawn over it, not under it.
    fn below_plume(self) -> bool {
        matches!(self, Passage::Over)
    }
}

/// How water passes an obstacle.
pub(super) fn passage(o: &ObstacleOutline, terrain: &Terrain) -> Passage {
    let beds = o.corners.iter().map(|c| terrain.bed_z(c[0], c[1]));
    let deepest = beds.fold(0.0, f64::min);
    let gap = GAP * -deepest;
    if o.permeable {
        Passage::Through
    } else if o.z[0] > deepest + gap {
        Passage::Under
    } else if o.z[1] < -gap {
        Passage::Over
    } else {
        Passage::Round
    }
}

/// Draws the solids under the plume, or those above it.
pub(super) fn draw(c: &mut Canvas, panel: &Panel, obstacles: &[ObstacleOutline], terrain: &Terrain, below_plume: bool) {
    for o in obstacles {
        let passage = passage(o, terrain);
        if passage.below_plume() == below_plume {
            solid(c, panel, &panel.all(&o.corners), passage);
        } else if !below_plume {
            // Its edge remains visible through the plume over it.
            c.polygon(panel.all(&o.corners), &Style::line(FILL, 1.4));
        }
    }
}

/// Draws one solid, given its corners on the sheet.
pub(super) fn solid(c: &mut Canvas, panel: &Panel, corners: &[[f64; 2]], passage: Passage) {
    let edge = match passage {
        Passage::Round | Passage::Over => {
            let style = Style::fill(FILL).edged(INK, 1.0);
            return c.polygon(corners.to_vec(), &style);
        }
        Passage::Under => Style::line(FILL, 1.6),
        Passage::Through => Style::line(FILL, 1.2).dashed("3 2"),
    };
    c.lines(&hatch(panel, corners), false, &Style::line(FILL, 0.9));
    c.polygon(corners.to_vec(), &edge);
}

/// Lines at 45 degrees across a convex outline, as far as the panel shows it.
fn hatch(panel: &Panel, corners: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
    // Lines x + y = s that cross the panel.
    let (from, to) = (panel.left + panel.top, panel.right() + panel.bottom());
    let sums = || corners.iter().map(|p| p[0] + p[1]);
    let low = sums().fold(f64::INFINITY, f64::min).max(from);
    let high = sums().fold(f64::NEG_INFINITY, f64::max).min(to);
    let mut lines = Vec::new();
    let mut s = (low / HATCH_PX).ceil() * HATCH_PX;
    while s < high {
        let mut ends: Vec<[f64; 2]> = Vec::new();
        for (k, a) in corners.iter().enumerate() {
            let b = corners[(k + 1) % corners.len()];
            let (da, db) = (a[0] + a[1] - s, b[0] + b[1] - s);
            if (da < 0.0) != (db < 0.0) {
                let share = da / (da - db);
                ends.push([a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])]);
            }
        }
        if ends.len() == 2 {
            lines.push(ends);
        }
        s += HATCH_PX;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn block(low: f64, high: f64) -> ObstacleOutline {
        ObstacleOutline {
            id: "block".into(),
            corners: vec![[0.0, 0.0], [20.0, 0.0], [20.0, 10.0], [0.0, 10.0]],
            z: [low, high],
            permeable: false,
        }
    }

    #[test]
    fn water_finds_its_way_by_the_heights() {
        let of = |low, high| passage(&block(low, high), &Terrain::Level { depth_m: 12.0 });
        assert_eq!(of(-12.0, 0.0), Passage::Round);
        assert_eq!(of(-13.0, 2.0), Passage::Round);
        assert_eq!(of(-12.0, -4.0), Passage::Over);
        assert_eq!(of(-2.0, 1.0), Passage::Under);
        let screen = ObstacleOutline { permeable: true, ..block(-12.0, 0.0) };
        let terrain = Terrain::Level { depth_m: 12.0 };
        assert_eq!(passage(&screen, &terrain), Passage::Through);
    }

    #[test]
    fn a_hatch_stays_in_its_outline_and_ends_however_large_that_is() {
        let panel = Panel { left: 10.0, top: 10.0, width: 200.0, height: 100.0, x: [0.0, 40.0], y: [0.0, 20.0] };
        let inside = hatch(&panel, &panel.all(&block(-2.0, 1.0).corners));
        assert!(inside.len() > 10, "{}", inside.len());
        let of_panel = |p: &[f64; 2]| (10.0..=110.0).contains(&p[0]) && (60.0..=110.0).contains(&p[1]);
        assert!(inside.iter().flatten().all(of_panel), "{inside:?}");
        let far = [[-1e9, -1e9], [1e9, -1e9], [1e9, 1e9], [-1e9, 1e9]];
        assert!(hatch(&panel, &far).len() < 60);
    }
}
