//! Last chemical detection points: the queue that the declaration rules and the reacquisition read.
//!
//! *Source*: Tian et al. 2013, section 3, LCDP_Node and eq. 1.
//!
//! *Parameters*: most points held, `most`; none in the paper, where SIZ_F keeps all of a mission.
//!
//! *Deviations*: eq. 1 turns the points by f_dir + 180° and calls the smallest x_flow the most up-flow one, which
//! the sign of its rotation leaves open: here x_flow grows down-flow and y_flow to the left of it, so the smallest
//! is the most up-flow. The order is made anew from the present flow whenever it is asked for, whatever the flow was
//! when the points were taken. The frame's origin is the area's: shifting it to a point changes no order.
//! A full queue forgets its oldest point.

use super::{FixMove, NavigationFix, Observation};
use nalgebra::Vector2;
use std::num::NonZeroUsize;
use world::units::Heading;

/// A last chemical detection point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lcdp {
    /// When chemical was last detected there, s.
    pub t_s: f64,
    /// Where, as the vehicle believes (east, north), m.
    pub position: Vector2<f64>,
    /// The reading then, share of the sensor's full scale.
    pub of_full_scale: f64,
    /// Flow there and then (east, north), m/s; `None` as long as none was measured.
    pub flow: Option<Vector2<f64>>,
}

impl Lcdp {
    /// A point of which only time and place matter.
    #[must_use]
    pub fn at(t_s: f64, position: Vector2<f64>) -> Self {
        Self {
            t_s,
            position,
            of_full_scale: 0.0,
            flow: None,
        }
    }

    /// Where the vehicle is now, with what it smells and the flow it believes in.
    #[must_use]
    pub fn here(seen: &Observation) -> Self {
        Self {
            t_s: seen.t_s,
            position: seen.estimate.position,
            of_full_scale: seen.chemical.map_or(0.0, |c| c.of_full_scale),
            flow: seen.estimate.flow.map(|f| f.velocity),
        }
    }

    /// (x_flow, y_flow), m: down-flow, and left of down-flow.
    #[must_use]
    pub fn in_flow(&self, up_flow: Heading) -> Vector2<f64> {
        let down = -up_flow.unit();
        Vector2::new(
            down.dot(&self.position),
            down.x * self.position.y - down.y * self.position.x,
        )
    }
}

/// The points most up-flow first; equal ones from the right to the left, then in order of time.
#[must_use]
pub fn most_up_flow_first(points: &[Lcdp], up_flow: Heading) -> Vec<Lcdp> {
    let mut sorted: Vec<(Vector2<f64>, Lcdp)> =
        points.iter().map(|p| (p.in_flow(up_flow), *p)).collect();
    sorted.sort_by(|(a, p), (b, q)| {
        (a.x.total_cmp(&b.x))
            .then(a.y.total_cmp(&b.y))
            .then(p.t_s.total_cmp(&q.t_s))
    });
    sorted.into_iter().map(|(_, p)| p).collect()
}

/// The points of a mission, oldest first.
#[derive(Clone, Debug, PartialEq)]
pub struct LcdpQueue {
    points: Vec<Lcdp>,
    most: usize,
}

impl LcdpQueue {
    /// An empty queue for `most` points.
    #[must_use]
    pub fn new(most: NonZeroUsize) -> Self {
        Self {
            points: Vec::new(),
            most: most.get(),
        }
    }

    /// Adds a point; a full queue forgets its oldest.
    pub fn add(&mut self, point: Lcdp) {
        let place = self.points.partition_point(|p| p.t_s <= point.t_s);
        self.points.insert(place, point);
        if self.points.len() > self.most {
            self.points.remove(0);
        }
    }

    /// All points, oldest first.
    #[must_use]
    pub fn all(&self) -> &[Lcdp] {
        &self.points
    }

    /// The newest point.
    #[must_use]
    pub fn newest(&self) -> Option<Lcdp> {
        self.points.last().copied()
    }

    /// All points, most up-flow first in the present flow.
    #[must_use]
    pub fn by_flow(&self, up_flow: Heading) -> Vec<Lcdp> {
        most_up_flow_first(&self.points, up_flow)
    }

    /// Forgets the points within a distance of a place.
    pub fn forget_near(&mut self, place: Vector2<f64>, within_m: f64) {
        (self.points).retain(|p| (p.position - place).norm() > within_m);
    }

    /// Forgets all points.
    pub fn clear(&mut self) {
        self.points.clear();
    }

    /// A fix has moved the believed position: moves the points by the rule.
    pub fn take_fix(&mut self, fix: &NavigationFix, rule: FixMove) {
        for point in &mut self.points {
            point.position += fix.shift_of(point.t_s, rule);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::fixed;
    use proptest::prelude::*;

    fn at(t_s: f64, east: f64, north: f64) -> Lcdp {
        Lcdp::at(t_s, Vector2::new(east, north))
    }

    fn times(points: &[Lcdp]) -> Vec<f64> {
        points.iter().map(|p| p.t_s).collect()
    }

    fn queue(most: usize, points: &[Lcdp]) -> LcdpQueue {
        let mut q = LcdpQueue::new(NonZeroUsize::new(most).expect("a queue holds something"));
        points.iter().for_each(|p| q.add(*p));
        q
    }

    #[test]
    fn flow_frame_by_hand() {
        let p = at(0.0, 3.0, 4.0);
        // Water to the east: x_flow is east, y_flow north.
        let east = p.in_flow(Heading::from_deg(270.0));
        assert!((east - Vector2::new(3.0, 4.0)).norm() < 1e-12);
        // Water to the south: x_flow is south, y_flow east.
        let south = p.in_flow(Heading::from_deg(0.0));
        assert!((south - Vector2::new(-4.0, 3.0)).norm() < 1e-12);
    }

    #[test]
    fn turns_with_the_flow_and_keeps_its_times() {
        let q = queue(
            9,
            &[at(1.0, 0.0, 5.0), at(2.0, 0.0, 20.0), at(3.0, 0.0, 10.0)],
        );
        assert_eq!(times(&q.by_flow(Heading::from_deg(0.0))), [2.0, 3.0, 1.0]);
        assert_eq!(times(&q.by_flow(Heading::from_deg(180.0))), [1.0, 3.0, 2.0]);
        assert_eq!(times(q.all()), [1.0, 2.0, 3.0]);
        assert_eq!(q.newest(), Some(at(3.0, 0.0, 10.0)));
    }

    #[test]
    fn a_full_queue_forgets_its_oldest_whatever_order_they_came_in() {
        let mut q = queue(
            3,
            &[at(4.0, 0.0, 0.0), at(2.0, 0.0, 0.0), at(3.0, 0.0, 0.0)],
        );
        assert_eq!(times(q.all()), [2.0, 3.0, 4.0]);
        q.add(at(5.0, 0.0, 0.0));
        assert_eq!(times(q.all()), [3.0, 4.0, 5.0]);
        q.clear();
        assert_eq!((q.newest(), q.all().len()), (None, 0));
    }

    proptest! {
        #![proptest_config(fixed(256))]

        #[test]
        fn the_flow_frame_keeps_distances_and_about_turns_reverse_it(
            places in proptest::collection::vec((-500.0..500.0f64, -500.0..500.0f64), 1..12),
            deg in 0.0..360.0,
        ) {
            let points: Vec<Lcdp> = places.iter().enumerate().map(|(k, (e, n))| at(k as f64, *e, *n)).collect();
            let up = Heading::from_deg(deg);
            for p in &points {
                prop_assert!((p.in_flow(up).norm() - p.position.norm()).abs() < 1e-9);
            }
            let sorted = most_up_flow_first(&points, up);
            prop_assert!(sorted.windows(2).all(|w| w[0].in_flow(up).x <= w[1].in_flow(up).x));
            let mut back = most_up_flow_first(&points, up.opposite());
            back.reverse();
            prop_assert_eq!(times(&sorted), times(&back));
        }
    }
}
