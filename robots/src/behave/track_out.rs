//! Just out of the plume: moves up-flow and across the plume to its other side.
//!
//! *Source*: Pang 2009, section 5.4, Table 2; section 6 says that L_u and L_c might shrink near the source.
//!
//! *Parameters*: L_u, `up_m`, m, 18; L_c, `across_m`, m, 18; the arrival radius R is the guidance's. `near` (none in
//! the paper): number of newest points considered, `points`, 3; their extent along the flow at which L_u and L_c are
//! not reduced, `far_m`, 36 m (two steps of L_u); their smallest share, `least`, 0.6 (11 m: not less than R, so that
//! there is a way to go).
//!
//! *Deviations*: Table 2 is not legible in print. This follows the text: from the most up-flow lost point, L_u
//! up-flow and L_c to the side opposite to the one on which the vehicle left the plume. The destination is fixed on
//! entry and held 10 m inside the area, where the cage lets the vehicle arrive. The paper says that neither the width
//! of the plume nor concentrations tell the distance to the source, and gives no rule for `near`. Our rule uses
//! headway: as long as the vehicle makes headway, each lost point lies about L_u up-flow of the one before it; near
//! the source the points gather. L_u and L_c are multiplied by the extent of the newest points along the flow over
//! `far_m`, held between `least` and 1. With fewer points they are not reduced. A vehicle that goes sideways does so
//! with its nose up-flow; one that hovers may wait at the lost point first (`wait_s`).

use super::behaviour::BehaviourParams;
use super::{Behave, Stride};
use crate::error::{RobotError, require};
use crate::handoff::{Lcdp, Manoeuvre, Observation};
use crate::memory::PlumeMemory;
use crate::places::{MARGIN_M, inside};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::f64::consts::FRAC_PI_2;
use std::num::NonZeroUsize;
use world::catalogue::Entry;
use world::ranges::{Fraction, NonNegative, Positive};
use world::registry::Listed;
use world::seeds::Stream;
use world::units::Heading;

/// Parameters of the behaviour.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "UpAcrossParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// L_u: distance up-flow of the point, m.
    #[default(NonNegative::new(18.0))]
    pub up_m: NonNegative,
    /// L_c: distance across the flow from the point, m.
    #[default(NonNegative::new(18.0))]
    pub across_m: NonNegative,
    /// How L_u and L_c shrink near the source. Without it they do not shrink.
    pub near: Option<Near>,
    /// How long it first waits where it is for the plume to come back, s; more than 0 needs a vehicle that hovers.
    #[serde(with = "world::limits::response_s")]
    #[default(NonNegative::new(0.0))]
    pub wait_s: NonNegative,
}

/// Shrinking near the source.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Near {
    /// How many of the newest last detection points are considered, at least 2.
    #[default(NonZeroUsize::new(3).expect("3 is not zero"))]
    pub points: NonZeroUsize,
    /// If the points extend at least this far along the flow, nothing shrinks, m.
    #[default(Positive::new(36.0))]
    pub far_m: Positive,
    /// Least share of L_u and L_c.
    #[default(Fraction::new(0.6))]
    pub least: Fraction,
}

impl Near {
    /// Share of L_u and L_c, from last detection points in order of time.
    fn share(&self, points: &[Lcdp], up_flow: Heading) -> f64 {
        let Some(first) = points.len().checked_sub(self.points.get()) else {
            return 1.0;
        };
        let along = points[first..].iter().map(|p| p.in_flow(up_flow).x);
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        ((high - low) / self.far_m.get()).clamp(self.least.get(), 1.0)
    }
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "UpAcross",
        what: "track out: to a point up-flow and across from the most up-flow lost point",
        source: "Pang 2009, section 5.4, Table 2",
    };
}

impl BehaviourParams for Params {
    fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
        Ok(Box::new(UpAcross::new(self)?))
    }

    fn waits(&self) -> Option<&'static str> {
        (self.wait_s.get() > 0.0).then_some("wait_s")
    }
}

/// State of the behaviour.
#[derive(Clone, Debug)]
pub struct UpAcross {
    params: Params,
    waits_until_s: Option<f64>,
    begun: bool,
}

impl UpAcross {
    /// # Errors
    /// [`RobotError::Invalid`] if the extent of a single point is asked for.
    pub fn new(params: &Params) -> Result<Self, RobotError> {
        require(
            params.near.as_ref().is_none_or(|n| n.points.get() >= 2),
            "track_out.UpAcross.near.points",
            "must be at least 2, got 1",
        )?;
        Ok(Self { params: params.clone(), waits_until_s: None, begun: false })
    }
}

impl Behave for UpAcross {
    fn enter(&mut self, _: &Observation, _: &PlumeMemory) {
        self.begun = false;
        self.waits_until_s = None;
    }

    fn step(&mut self, seen: &Observation, arrived: bool, memory: &mut PlumeMemory, _: &mut Stream) -> Stride {
        if self.begun {
            return if arrived { Stride::Over } else { Stride::Keep };
        }
        let wait_s = self.params.wait_s.get();
        if wait_s > 0.0 && seen.able.hovers {
            match self.waits_until_s {
                None => {
                    self.waits_until_s = Some(seen.t_s + wait_s);
                    return Stride::Start(Manoeuvre::Hold {
                        point: seen.estimate.position,
                        heading: Some(memory.up_flow_or_nose(seen)),
                    });
                }
                Some(until_s) if seen.t_s < until_s => return Stride::Keep,
                Some(_) => {}
            }
        }
        self.begun = true;
        let up_flow = memory.up_flow_or_nose(seen);
        memory.lost.sort(up_flow);
        let Some(from) = memory.lost.first() else {
            return Stride::Over;
        };
        let right = up_flow.turned(FRAC_PI_2).unit();
        let near = self.params.near.as_ref();
        let share = near.map_or(1.0, |n| n.share(memory.lcdps.all(), up_flow));
        let across = memory.leaves.other().sign() * self.params.across_m.get() * share;
        let point = from.position + up_flow.unit() * (self.params.up_m.get() * share) + right * across;
        let point = inside(&seen.area, point, MARGIN_M);
        // A vehicle that goes sideways keeps its nose, and what it smells with, up-flow.
        Stride::Start(if seen.able.sideways {
            Manoeuvre::SlideTo { point, radius_m: None, heading: up_flow }
        } else {
            Manoeuvre::GoToPoint { point, radius_m: None }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::behave::testing::{memory, point, step, v};
    use crate::handoff::Side;
    use crate::handoff::testing::seen;
    use nalgebra::Vector2;

    /// The point of a vehicle at the origin; up-flow is east, so right is south.
    fn goal(params: &Params, leaves: Side, m: &mut PlumeMemory) -> Vector2<f64> {
        m.leaves = leaves;
        let mut b = UpAcross::new(params).expect("legal");
        match step(&mut b, &seen(0.0, v(0.0, 0.0), 0.0, None), false, m) {
            Stride::Start(m) => point(&m),
            other => panic!("wanted a start, got {other:?}"),
        }
    }

    fn lost(leaves: Side, lost: &[(f64, f64)]) -> Vector2<f64> {
        goal(&Params::default(), leaves, &mut memory(Some(90.0), lost))
    }

    #[test]
    fn up_flow_and_to_the_other_side_of_the_most_up_flow_point() {
        // Left on the left: cross to the right. The east edge is at 200 m.
        let points = [(20.0, 5.0), (50.0, 0.0), (30.0, 0.0)];
        for (leaves, points, wanted) in [
            (Side::Left, &points[..], v(68.0, -18.0)),
            (Side::Right, &points, v(68.0, 18.0)),
            (Side::Left, &[(195.0, 0.0)], v(190.0, -18.0)),
        ] {
            assert!((lost(leaves, points) - wanted).norm() < 1e-9, "{leaves:?} {points:?}");
        }
    }

    #[test]
    fn shrinks_as_the_newest_points_gather() {
        let share = |easts: &[f64]| {
            let points: Vec<_> =
                (easts.iter().enumerate()).map(|(k, e)| Lcdp::new_at(k as f64, v(*e, 40.0 * k as f64))).collect();
            Near::default().share(&points, Heading::from_deg(90.0))
        };
        // Too few; on the way, 40 m in three; gathering, 27 m; gathered; in either direction of the flow.
        assert_eq!(share(&[0.0, 5.0]), 1.0);
        assert_eq!(share(&[-60.0, 0.0, 20.0, 40.0]), 1.0);
        assert!((share(&[-60.0, 0.0, 27.0, 9.0]) - 0.75).abs() < 1e-12);
        assert_eq!(share(&[-60.0, 0.0, 3.0, -2.0]), 0.6);
        // Up-flow is east: L_u and L_c of 18 m become 10.8 m.
        let near = Params { near: Some(Near::default()), ..Params::default() };
        let p = goal(&near, Side::Left, &mut memory(Some(90.0), &[(50.0, 0.0); 3]));
        assert!((p - v(60.8, -10.8)).norm() < 1e-9);
        let one = Params { near: Some(Near { points: NonZeroUsize::MIN, ..Near::default() }), ..Params::default() };
        assert!(UpAcross::new(&one).is_err());
    }

    #[test]
    fn over_on_arrival_or_without_a_point() {
        let mut b = UpAcross::new(&Params::default()).expect("legal");
        let o = seen(0.0, v(0.0, 0.0), 0.0, None);
        let mut m = memory(Some(90.0), &[(0.0, 0.0)]);
        assert!(matches!(step(&mut b, &o, false, &mut m), Stride::Start(_)));
        assert_eq!(step(&mut b, &o, false, &mut m), Stride::Keep);
        assert_eq!(step(&mut b, &o, true, &mut m), Stride::Over);
        b.enter(&o, &m);
        assert_eq!(step(&mut b, &o, false, &mut memory(Some(90.0), &[])), Stride::Over);
    }
}
