//! Whether a plume was traced to the up-flow edge of a region, and where it crosses that edge.
//!
//! *Source*: Pang 2009, section 6: "a source will be declared at the intersection of the plume with the upper edge of
//! the subregion".
//!
//! *Parameters*: see [`EdgeSpec`](super::EdgeSpec). `within_m` 20: destinations are held 10 m inside a region and
//! count as reached 10 m before that (R of Table 4), so that tracing ends there by itself. `plume_s` 10: twice λ of
//! Table 4, long enough to hold both sides of a counter-turn. The paper prints neither.
//!
//! *Deviations*: the paper does not say how the plume's course is found. Here it is the mean place of the newest
//! detections, extended up-flow. The up-flow edge is the one that faces the flow most. A plume that comes in through
//! another edge is followed across it, and crosses the line of the up-flow edge outside the region: then the nearest
//! place on the edge itself is taken.

use nalgebra::Vector2;
use std::collections::VecDeque;
use world::area::Area;
use world::units::Heading;

/// The newest detections.
#[derive(Clone, Debug)]
pub(super) struct Plume {
    window_s: f64,
    newest: VecDeque<(f64, Vector2<f64>)>,
}

impl Plume {
    pub(super) fn new(window_s: f64) -> Self {
        Self { window_s, newest: VecDeque::new() }
    }

    pub(super) fn forget(&mut self) {
        self.newest.clear();
    }

    /// Takes in a detection at a believed place; returns the plume's mean place.
    pub(super) fn note(&mut self, t_s: f64, place: Vector2<f64>) -> Vector2<f64> {
        self.newest.push_back((t_s, place));
        self.newest.retain(|(t, _)| t_s - t <= self.window_s);
        let sum: Vector2<f64> = self.newest.iter().map(|(_, p)| p).sum();
        sum / self.newest.len() as f64
    }
}

/// Where the plume crosses the up-flow edge, if the newest detection has reached it.
pub(super) fn crossing(
    region: &Area,
    up_flow: Heading,
    detection: Vector2<f64>,
    plume: Vector2<f64>,
    within_m: f64,
) -> Option<Vector2<f64>> {
    let up = up_flow.unit();
    let facing = region.sides().edges(detection).into_iter().max_by(|a, b| a.1.dot(&up).total_cmp(&b.1.dot(&up)));
    let (from_edge_m, normal) = facing?;
    if from_edge_m >= within_m {
        return None;
    }
    // At least one of the four edges faces the flow within 45 degrees, so the division is safe.
    let to_edge_m = from_edge_m - (plume - detection).dot(&normal);
    let on_line = region.local(plume + up * (to_edge_m / normal.dot(&up)));
    let (l, w) = (region.length_m / 2.0, region.width_m / 2.0);
    Some(region.world(Vector2::new(on_line.x.clamp(-l, l), on_line.y.clamp(-w, w))))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn region(axis_deg: f64) -> Area {
        Area { centre: Vector2::new(100.0, 50.0), length_m: 200.0, width_m: 80.0, axis: Heading::from_deg(axis_deg) }
    }

    #[test]
    fn by_hand() {
        // North edge at 150 m N, from 60 to 140 m E. Up-flow 330 degrees: 1 m north for 0.577 m west.
        let (r, up) = (region(0.0), Heading::from_deg(330.0));
        let at = |e, n| Vector2::new(e, n);
        assert_eq!(crossing(&r, up, at(100.0, 130.0), at(100.0, 128.0), 20.0), None);
        let c = crossing(&r, up, at(101.0, 131.0), at(100.0, 128.0), 20.0).expect("19 m off");
        assert!((c - at(100.0 - 22.0 * 0.577_350_3, 150.0)).norm() < 1e-4, "{c}");
        // Beyond the edge: moved back to it.
        let c = crossing(&r, up, at(90.0, 160.0), at(90.0, 155.0), 20.0).expect("beyond");
        assert!((c - at(90.0 + 5.0 * 0.577_350_3, 150.0)).norm() < 1e-4, "{c}");
        // Beyond the edge's end: its end.
        let c = crossing(&r, up, at(61.0, 140.0), at(61.0, 140.0), 20.0).expect("10 m off");
        assert!((c - at(60.0, 150.0)).norm() < 1e-9, "{c}");
        // The side edges are not up-flow edges.
        assert_eq!(crossing(&r, up, at(50.0, 50.0), at(50.0, 50.0), 20.0), None);
    }

    #[test]
    fn turns_with_the_region() {
        let (still, turned) = (region(0.0), region(140.0));
        let turn = |p: Vector2<f64>| turned.world(still.local(p));
        let (d, p) = (Vector2::new(95.0, 140.0), Vector2::new(90.0, 130.0));
        let a = crossing(&still, Heading::from_deg(10.0), d, p, 20.0).expect("reached");
        let b = crossing(&turned, Heading::from_deg(150.0), turn(d), turn(p), 20.0);
        assert!((turn(a) - b.expect("reached")).norm() < 1e-9);
    }

    #[test]
    fn the_plume_is_the_mean_of_the_newest() {
        let mut plume = Plume::new(10.0);
        plume.note(0.0, Vector2::new(900.0, 0.0));
        plume.note(5.0, Vector2::new(10.0, 2.0));
        let mean = plume.note(12.0, Vector2::new(20.0, 4.0));
        assert_eq!(mean, Vector2::new(15.0, 3.0));
    }
}
