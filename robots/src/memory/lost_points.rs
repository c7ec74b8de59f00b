//! Where the plume was lost: the list that Track-In writes and that Track-Out, Reacquire and the declaration rules
//! read.

use crate::handoff::Lcdp;
use std::num::NonZeroUsize;
use world::units::Heading;

/// The lost points, most up-flow first; a full list drops its most down-flow point.
#[derive(Clone, Debug, PartialEq)]
pub struct LostPoints {
    pub(super) points: Vec<Lcdp>,
    most: usize,
}

impl LostPoints {
    /// An empty list for `most` points.
    pub fn new(most: NonZeroUsize) -> Self {
        Self { points: Vec::new(), most: most.get() }
    }

    /// Adds a point; the list stays in order along the present flow.
    pub fn add(&mut self, point: Lcdp, up_flow: Heading) {
        self.points.push(point);
        self.sort(up_flow);
        self.points.truncate(self.most);
    }

    /// Sorts the points along the present flow, most up-flow first; points equally far in order of time.
    pub fn sort(&mut self, up_flow: Heading) {
        let up = up_flow.unit();
        self.points.sort_by(|a, b| {
            let (a_up, b_up) = (a.position.dot(&up), b.position.dot(&up));
            b_up.total_cmp(&a_up).then(a.t_s.total_cmp(&b.t_s))
        });
    }

    /// Removes the first point.
    pub fn drop_first(&mut self) {
        if !self.points.is_empty() {
            self.points.remove(0);
        }
    }

    /// The most up-flow point, by the flow at the last sorting.
    pub fn first(&self) -> Option<Lcdp> {
        self.points.first().copied()
    }

    /// All points, most up-flow first.
    pub fn all(&self) -> &[Lcdp] {
        &self.points
    }

    /// Forgets all points.
    pub fn clear(&mut self) {
        self.points.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector2;

    fn at(t_s: f64, north: f64) -> Lcdp {
        Lcdp::new_at(t_s, Vector2::new(0.0, north))
    }

    #[test]
    fn keeps_the_most_up_flow_and_turns_with_the_flow() {
        let mut list = LostPoints::new(NonZeroUsize::new(3).expect("3 > 0"));
        let north = Heading::from_deg(0.0);
        for (t, n) in [(0.0, 5.0), (1.0, 20.0), (2.0, 10.0), (3.0, 15.0)] {
            list.add(at(t, n), north);
        }
        let norths = |l: &LostPoints| l.all().iter().map(|p| p.position.y).collect::<Vec<_>>();
        assert_eq!(norths(&list), [20.0, 15.0, 10.0]);
        list.sort(north.opposite());
        assert_eq!(norths(&list), [10.0, 15.0, 20.0]);
        list.drop_first();
        assert_eq!(norths(&list), [15.0, 20.0]);
    }
}
