//! Flies to one corner after the other of a pattern that hangs on the place where the plume was lost.

use super::{Behave, Stride};
use crate::handoff::{Manoeuvre, Observation};
use crate::memory::PlumeMemory;
use crate::places::{MARGIN_M, inside};
use nalgebra::Vector2;
use std::f64::consts::FRAC_PI_2;
use std::fmt::Debug;
use world::seeds::Stream;
use world::units::Heading;

/// A pattern of corners.
pub(super) trait Pattern: Debug + Send + Sync {
    /// A corner, counted from 0: (up-flow of the lost point, towards the side from which the vehicle came), m; `None`
    /// after the last one.
    fn corner(&self, number: u32) -> Option<Vector2<f64>>;
}

/// The behaviour: a pattern on the newest last detection point, in the flow at the time of the loss. Corners are held
/// inside the area.
#[derive(Debug)]
pub(super) struct Corners<P> {
    pattern: P,
    begun: u32,
    /// The lost point, and its axes: up-flow, and the side from which the vehicle came.
    frame: Option<(Vector2<f64>, [Vector2<f64>; 2])>,
}

impl<P: Pattern> Corners<P> {
    /// The behaviour before it is entered.
    pub(super) fn new(pattern: P) -> Self {
        Self { pattern, begun: 0, frame: None }
    }
}

impl<P: Pattern> Behave for Corners<P> {
    fn enter(&mut self, _: &Observation, _: &PlumeMemory) {
        (self.begun, self.frame) = (0, None);
    }

    fn step(&mut self, seen: &Observation, arrived: bool, memory: &mut PlumeMemory, _: &mut Stream) -> Stride {
        if self.begun > 0 && !arrived {
            return Stride::Keep;
        }
        let Some(lost) = memory.lcdps.newest() else {
            return Stride::Over;
        };
        let (from, [up, back]) = *self.frame.get_or_insert_with(|| {
            let up_flow: Heading = memory.up_flow_or_nose(seen);
            let back = memory.leaves.other().sign() * up_flow.turned(FRAC_PI_2).unit();
            (lost.position, [up_flow.unit(), back])
        });
        let Some(corner) = self.pattern.corner(self.begun) else {
            return Stride::Over;
        };
        self.begun += 1;
        let point = inside(&seen.area, from + up * corner.x + back * corner.y, MARGIN_M);
        Stride::Start(Manoeuvre::GoToPoint { point, radius_m: None })
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::behave::testing::{all, memory, point, v};
    use crate::handoff::Side;
    use crate::handoff::testing::seen;

    /// To the micrometre, without a sign of zero.
    fn tidy(m: f64) -> f64 {
        (m * 1e6).round() / 1e6 + 0.0
    }

    /// The corners (up-flow, towards the side from which it came), m, of a vehicle that has lost the plume on its left
    /// at (20, 30) with up-flow north.
    pub(crate) fn corners(b: &mut dyn Behave) -> Vec<(f64, f64)> {
        let mut m = memory(Some(0.0), &[(20.0, 30.0)]);
        m.leaves = Side::Left;
        let started = all(b, &seen(0.0, v(25.0, 30.0), 0.0, None), &mut m);
        started.iter().map(point).map(|p| (p.y - 30.0, p.x - 20.0)).map(|(up, back)| (tidy(up), tidy(back))).collect()
    }

    #[derive(Debug)]
    struct Two;

    impl Pattern for Two {
        fn corner(&self, number: u32) -> Option<Vector2<f64>> {
            [v(10.0, 5.0), v(0.0, -900.0)].get(number as usize).copied()
        }
    }

    #[test]
    fn corners_hang_on_the_lost_point_and_stay_inside() {
        // Lost on the left: the side from which it came is the right, east. The area ends 200 m west of its centre.
        assert_eq!(corners(&mut Corners::new(Two)), [(10.0, 5.0), (0.0, -210.0)]);
        assert!(all(&mut Corners::new(Two), &seen(0.0, v(0.0, 0.0), 0.0, None), &mut memory(None, &[])).is_empty());
    }
}
