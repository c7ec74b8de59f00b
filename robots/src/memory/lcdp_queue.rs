//! The queue of last chemical detection points that the declaration rules and the reacquisition read.
//!
//! *Source*: Tian et al. 2013, section 3, LCDP_Node and eq. 1.
//!
//! *Parameters*: most points held, `most`; none in the paper, where SIZ_F keeps all points of a mission.
//!
//! *Deviations*: the order along the flow is computed from the present flow whenever it is asked for; the flow at the
//! time when a point was stored does not matter. A full queue forgets its oldest point.

use crate::handoff::Lcdp;
use nalgebra::Vector2;
use std::num::NonZeroUsize;
use world::units::Heading;

/// The points, most up-flow first; points equally far up-flow from right to left, then in order of time.
pub fn most_up_flow_first(points: &[Lcdp], up_flow: Heading) -> Vec<Lcdp> {
    let mut sorted: Vec<(Vector2<f64>, Lcdp)> = points.iter().map(|p| (p.in_flow(up_flow), *p)).collect();
    sorted.sort_by(|(a, p), (b, q)| (a.x.total_cmp(&b.x)).then(a.y.total_cmp(&b.y)).then(p.t_s.total_cmp(&q.t_s)));
    sorted.into_iter().map(|(_, p)| p).collect()
}

/// The points of a mission, oldest first.
#[derive(Clone, Debug, PartialEq)]
pub struct LcdpQueue {
    pub(super) points: Vec<Lcdp>,
    most: usize,
}

impl LcdpQueue {
    /// An empty queue for `most` points.
    pub fn new(most: NonZeroUsize) -> Self {
        Self { points: Vec::new(), most: most.get() }
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
    pub fn all(&self) -> &[Lcdp] {
        &self.points
    }

    /// The newest point.
    pub fn newest(&self) -> Option<Lcdp> {
        self.points.last().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::fixed;
    use proptest::prelude::*;

    fn at(t_s: f64, east: f64, north: f64) -> Lcdp {
        Lcdp::new_at(t_s, Vector2::new(east, north))
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
    fn turns_with_the_flow_and_keeps_its_times() {
        let q = queue(9, &[at(1.0, 0.0, 5.0), at(2.0, 0.0, 20.0), at(3.0, 0.0, 10.0)]);
        assert_eq!(times(&most_up_flow_first(q.all(), Heading::from_deg(0.0))), [2.0, 3.0, 1.0]);
        assert_eq!(times(&most_up_flow_first(q.all(), Heading::from_deg(180.0))), [1.0, 3.0, 2.0]);
        assert_eq!(times(q.all()), [1.0, 2.0, 3.0]);
        assert_eq!(q.newest(), Some(at(3.0, 0.0, 10.0)));
    }

    #[test]
    fn a_full_queue_forgets_its_oldest_whatever_order_they_came_in() {
        let mut q = queue(3, &[at(4.0, 0.0, 0.0), at(2.0, 0.0, 0.0), at(3.0, 0.0, 0.0)]);
        assert_eq!(times(q.all()), [2.0, 3.0, 4.0]);
        q.add(at(5.0, 0.0, 0.0));
        assert_eq!(times(q.all()), [3.0, 4.0, 5.0]);
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
