//! Just out of the plume: up-flow and across it, to the plume's other side.
//!
//! *Source*: Pang 2009, section 5.4, Table 2.
//!
//! *Parameters*: L_u, `up_m`, m, 18; L_c, `across_m`, m, 18; arrival radius R is the guidance's.
//!
//! *Deviations*: Table 2 is not legible in print; the text is followed: from the most up-flow lost point
//! L_u up-flow and L_c to the side opposite to the one on which the plume was left. The point is fixed on
//! entry and held 10 m inside the area, where the cage lets the vehicle arrive.

use crate::error::RobotError;
use crate::handoff::{Behave, Manoeuvre, Observation, PlumeMemory, Stride, inside};
use serde::{Deserialize, Serialize};
use std::f64::consts::FRAC_PI_2;
use world::ranges::NonNegative;
use world::seeds::Stream;

/// Points are held this far inside the area, m: the cage's 5 m and as much again.
const MARGIN_M: f64 = 10.0;

/// Parameters of the behaviour.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// L_u: up-flow of the point, m.
    pub up_m: NonNegative,
    /// L_c: across the flow from it, m.
    pub across_m: NonNegative,
}

impl Default for Params {
    fn default() -> Self {
        Self {
            up_m: NonNegative::new(18.0),
            across_m: NonNegative::new(18.0),
        }
    }
}

/// State of the behaviour.
#[derive(Clone, Debug)]
pub struct UpAcross {
    up_m: f64,
    across_m: f64,
    begun: bool,
}

impl UpAcross {
    /// # Errors
    /// Never; every parameter has a meaning.
    pub fn new(params: &Params) -> Result<Self, RobotError> {
        Ok(Self {
            up_m: params.up_m.get(),
            across_m: params.across_m.get(),
            begun: false,
        })
    }
}

impl Behave for UpAcross {
    fn enter(&mut self, _: &Observation, _: &PlumeMemory) {
        self.begun = false;
    }

    fn step(
        &mut self,
        seen: &Observation,
        arrived: bool,
        memory: &mut PlumeMemory,
        _: &mut Stream,
    ) -> Stride {
        if self.begun {
            return if arrived { Stride::Over } else { Stride::Keep };
        }
        self.begun = true;
        let up_flow = memory.up_flow_or_nose(seen);
        memory.lost.sort(up_flow);
        let Some(from) = memory.lost.first() else {
            return Stride::Over;
        };
        let right = up_flow.turned(FRAC_PI_2).unit();
        let across = memory.leaves.other().sign() * self.across_m;
        let point = from.position + up_flow.unit() * self.up_m + right * across;
        Stride::Start(Manoeuvre::GoToPoint {
            point: inside(&seen.area, point, MARGIN_M),
            radius_m: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::seen;
    use crate::handoff::{LostPoint, LostPoints, Side};
    use nalgebra::Vector2;
    use std::num::NonZeroUsize;
    use world::units::Heading;

    fn memory(leaves: Side, lost: &[(f64, f64)]) -> PlumeMemory {
        let up = Heading::from_deg(90.0);
        let mut list = LostPoints::new(NonZeroUsize::new(6).expect("6 > 0"));
        for (east, north) in lost {
            let position = Vector2::new(*east, *north);
            list.add(LostPoint { t_s: 0.0, position }, up);
        }
        PlumeMemory {
            up_flow: Some(up),
            last_detection: None,
            leaves,
            lost: list,
        }
    }

    fn point(m: &mut PlumeMemory) -> Vector2<f64> {
        let mut b = UpAcross::new(&Params::default()).expect("legal");
        let o = seen(0.0, Vector2::zeros(), 0.0, None);
        match b.step(&o, false, m, &mut Stream::new(1, "t", "t")) {
            Stride::Start(Manoeuvre::GoToPoint { point, .. }) => point,
            other => panic!("wanted a point, got {other:?}"),
        }
    }

    #[test]
    fn up_flow_and_to_the_other_side_of_the_most_up_flow_point() {
        // Up-flow is east, so right is south. Left on the left: cross to the right.
        let lost = [(20.0, 5.0), (50.0, 0.0), (30.0, 0.0)];
        let p = point(&mut memory(Side::Left, &lost));
        assert!((p - Vector2::new(68.0, -18.0)).norm() < 1e-9);
        let p = point(&mut memory(Side::Right, &lost));
        assert!((p - Vector2::new(68.0, 18.0)).norm() < 1e-9);
    }

    #[test]
    fn held_inside_the_area() {
        // The east edge is at 200 m.
        let p = point(&mut memory(Side::Left, &[(195.0, 0.0)]));
        assert!((p - Vector2::new(190.0, -18.0)).norm() < 1e-9);
    }

    #[test]
    fn over_on_arrival_or_without_a_point() {
        let mut b = UpAcross::new(&Params::default()).expect("legal");
        let mut rng = Stream::new(1, "t", "t");
        let o = seen(0.0, Vector2::zeros(), 0.0, None);
        let mut m = memory(Side::Left, &[(0.0, 0.0)]);
        assert!(matches!(
            b.step(&o, false, &mut m, &mut rng),
            Stride::Start(_)
        ));
        assert_eq!(b.step(&o, false, &mut m, &mut rng), Stride::Keep);
        assert_eq!(b.step(&o, true, &mut m, &mut rng), Stride::Over);
        b.enter(&o, &m);
        assert_eq!(
            b.step(&o, false, &mut memory(Side::Left, &[]), &mut rng),
            Stride::Over
        );
    }
}
