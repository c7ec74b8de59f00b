//! Searches around the newest last detection point in loops like a cloverleaf. One of the leaves lies down-flow.
//!
//! *Source*: Tian et al. 2013, section 3, Fig. 4b (after Li, Farrell, Pang & Arrieta 2006).
//!
//! *Parameters*: N_re, `repetitions`, 2 (2 or 3 in the field); length of a leaf, `leaf_m`, m, larger than the turning
//! radius `turn_radius_m`, about 15: 16 here; number of leaves, `leaves`, not given: 4; distance at which a leaf's
//! corner counts as reached, `arrive_m`, m, not given: 5.
//!
//! *Deviations*: the text does not describe Fig. 4b and does not count the leaves. Here n straight lines through the
//! point, 360°/n apart and joined by turns outside, make n leaves. Each leaf is 180° - 360°/n wide and its sides are
//! `leaf_m` long. With four leaves the turns become circles when `leaf_m` equals the turning radius, which is the
//! paper's bound; the bound for n leaves is turn_radius / tan(90° - 180°/n). The vehicle flies to the corners with Go
//! To Point, "the most robust mode" (Pang 2009, section 4.1): if it had to enter each line with the line's heading, a
//! vehicle of 2 m/s would go far astray in a flow of 1 m/s. The first line starts up-flow of the point, on the
//! vehicle's side, and leads into the down-flow leaf. A last line back to the point closes the last leaf. Each
//! repetition takes the present centre and flow. Corners are held 10 m inside the area. At the end the behaviour
//! empties the list of lost points, as the bowties do, so that the next search begins at a new point; the queue of
//! last detection points stays. If the vehicle turns wider than `turn_radius_m`, leaves that are too short for its
//! turns are lengthened to the bound.

use super::behaviour::BehaviourParams;
use super::{Behave, Stride};
use crate::error::{RobotError, require};
use crate::handoff::{Manoeuvre, Observation, Side};
use crate::memory::PlumeMemory;
use crate::places::{MARGIN_M, inside};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::f64::consts::{FRAC_PI_2, PI, TAU};
use std::num::NonZeroU32;
use world::catalogue::Entry;
use world::math;
use world::ranges::Positive;
use world::registry::Listed;
use world::seeds::Stream;
use world::units::Heading;

/// Parameters of the behaviour.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "CloverleafParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// N_re: how often all leaves are flown.
    #[default(NonZeroU32::new(2).expect("2 is not zero"))]
    pub repetitions: NonZeroU32,
    /// Leaves, 3 to 8.
    #[default(NonZeroU32::new(4).expect("4 is not zero"))]
    pub leaves: NonZeroU32,
    /// Length of a leaf's sides, m.
    #[default(Positive::new(16.0))]
    pub leaf_m: Positive,
    /// Turning radius of the vehicle, m. The leaves must have room for it.
    #[default(Positive::new(15.0))]
    pub turn_radius_m: Positive,
    /// A leaf's corner counts as reached within this distance, m.
    #[default(Positive::new(5.0))]
    pub arrive_m: Positive,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "Cloverleaf",
        what: "reacquire: loops like a cloverleaf around the newest last detection point, one of them down-flow",
        source: "Tian et al. 2013, section 3, Fig. 4b",
    };
}

impl BehaviourParams for Params {
    fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
        Ok(Box::new(Cloverleaf::new(self)?))
    }
}

/// State of the behaviour.
#[derive(Clone, Debug)]
pub struct Cloverleaf {
    params: Params,
    /// Corners started since it was entered.
    begun: u32,
    /// Direction of the first line: down-flow turned by half a leaf; and the sense of the turns.
    first: Heading,
    turn: Side,
    centre: Vector2<f64>,
}

impl Cloverleaf {
    /// # Errors
    /// [`RobotError::Invalid`] if there are too few or too many leaves, or if they are too short to be flown.
    pub fn new(params: &Params) -> Result<Self, RobotError> {
        let must = |holds: bool, field: &str, problem: String| {
            require(holds, format!("reacquire.Cloverleaf.{field}"), problem)
        };
        let leaves = params.leaves.get();
        must((3..=8).contains(&leaves), "leaves", format!("must be 3 to 8, got {leaves}"))?;
        let least_m = params.turn_radius_m.get() / math::tan(half_leaf(leaves));
        must(
            params.leaf_m.get() >= least_m,
            "leaf_m",
            format!(
                "must be at least {least_m:.1} m for {leaves} leaves with turns of {} m, got {}",
                params.turn_radius_m.get(),
                params.leaf_m.get()
            ),
        )?;
        Ok(Self {
            params: params.clone(),
            begun: 0,
            first: Heading::from_deg(0.0),
            turn: Side::Right,
            centre: Vector2::zeros(),
        })
    }

    /// The corner of the given number. The corners are the start and end of each line, and at last the centre.
    fn corner(&self, number: u32, seen: &Observation) -> Vector2<f64> {
        if number == self.corners() {
            return self.centre;
        }
        let way = (number / 2) % self.params.leaves.get();
        let round = TAU * f64::from(way) / f64::from(self.params.leaves.get());
        let along = self.first.turned(self.turn.sign() * round).unit() * self.leaf_m(seen);
        let from_centre = if number.is_multiple_of(2) { -along } else { along };
        inside(&seen.area, self.centre + from_centre, MARGIN_M)
    }

    /// Length of a leaf's sides, m: with room for the vehicle's own turns.
    fn leaf_m(&self, seen: &Observation) -> f64 {
        let own_m = seen.able.turning_radius_m;
        let leaf_m = self.params.leaf_m.get();
        if own_m > self.params.turn_radius_m.get() {
            leaf_m.max(own_m / math::tan(half_leaf(self.params.leaves.get())))
        } else {
            leaf_m
        }
    }

    /// Number of corners in all repetitions, with the one that leads back along the last leaf's second side.
    fn corners(&self) -> u32 {
        (2 * self.params.leaves.get()).saturating_mul(self.params.repetitions.get()).saturating_add(1)
    }
}

/// Angle between a leaf's middle and its sides, rad.
fn half_leaf(leaves: u32) -> f64 {
    FRAC_PI_2 - PI / f64::from(leaves)
}

impl Behave for Cloverleaf {
    fn enter(&mut self, _: &Observation, _: &PlumeMemory) {
        self.begun = 0;
    }

    fn step(&mut self, seen: &Observation, arrived: bool, memory: &mut PlumeMemory, _: &mut Stream) -> Stride {
        if self.begun > 0 && !arrived {
            return Stride::Keep;
        }
        let number = self.begun;
        if number.is_multiple_of(2 * self.params.leaves.get()) && number + 1 < self.corners() {
            let Some(point) = memory.lcdps.newest() else {
                return Stride::Over;
            };
            self.centre = inside(&seen.area, point.position, MARGIN_M);
            let up_flow = memory.up_flow_or_nose(seen);
            if number == 0 {
                let right = up_flow.turned(FRAC_PI_2).unit();
                // The first line leads from the vehicle's side to the other; the turns then close this leaf.
                self.turn = Side::from_rightward((seen.estimate.position - self.centre).dot(&right));
            }
            let half = half_leaf(self.params.leaves.get());
            self.first = up_flow.opposite().turned(self.turn.sign() * half);
        }
        if number > self.corners() {
            memory.lost.clear();
            return Stride::Over;
        }
        self.begun += 1;
        Stride::Start(Manoeuvre::GoToPoint {
            point: self.corner(number, seen),
            radius_m: Some(self.params.arrive_m.get()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::behave::testing::{all, memory, point, step, v};
    use crate::handoff::testing::seen;

    fn params(leaves: u32, leaf_m: f64) -> Params {
        let leaves = NonZeroU32::new(leaves).expect("not zero");
        Params { leaves, leaf_m: Positive::new(leaf_m), ..Params::default() }
    }

    /// All corners until the end, for a vehicle that stays at `here`; the plume was lost far east, then at `lost`.
    fn corners(params: &Params, lost: Vector2<f64>, up_deg: f64, here: Vector2<f64>) -> Vec<Vector2<f64>> {
        let mut m = memory(Some(up_deg), &[(500.0, 0.0), (lost.x, lost.y)]);
        let started = all(&mut Cloverleaf::new(params).expect("legal"), &seen(0.0, here, 0.0, None), &mut m);
        assert_eq!((m.lost.all().len(), m.lcdps.all().len()), (0, 2));
        let arrive = Some(params.arrive_m.get());
        assert!(started.iter().all(|m| matches!(m, Manoeuvre::GoToPoint { radius_m, .. } if *radius_m == arrive)));
        started.iter().map(point).collect()
    }

    #[test]
    fn four_leaves_by_hand() {
        // Up-flow is north; the vehicle is up-flow of the point and to its right.
        let found = corners(&params(4, 20.0), v(10.0, 20.0), 0.0, v(12.0, 40.0));
        let d = 20.0 / 2f64.sqrt();
        // Through the point to the south-west, north-west, north-east, south-east: always turning right. The first
        // two lines make the southern leaf.
        let ends = [(-d, -d), (-d, d), (d, d), (d, -d)];
        assert_eq!(found.len(), 18, "two rounds of four ways, and back");
        for k in 0..8 {
            let end = v(ends[k % 4].0, ends[k % 4].1);
            assert!((found[2 * k] - v(10.0, 20.0) + end).norm() < 1e-9, "{k}");
            assert!((found[2 * k + 1] - v(10.0, 20.0) - end).norm() < 1e-9, "{k}");
        }
        // The last leaf's second side, and back to the point.
        assert!((found[16] - found[0]).norm() < 1e-9);
        assert_eq!(found[17], v(10.0, 20.0));
        // From the left it is the mirror image.
        let found = corners(&params(4, 20.0), v(10.0, 20.0), 0.0, v(8.0, 40.0));
        assert!((found[1] - v(10.0 + d, 20.0 - d)).norm() < 1e-9);
        assert!((found[3] - v(10.0 + d, 20.0 + d)).norm() < 1e-9);
    }

    #[test]
    fn leaves_have_room_for_the_vehicle_s_own_turns() {
        // Wider leaves need less.
        for (leaves, able_m, leaf_m) in
            [(4, 0.0, 30.0), (4, 15.0, 30.0), (4, 29.0, 30.0), (4, 40.0, 40.0), (6, 60.0, 60.0 / 3f64.sqrt())]
        {
            let mut b = Cloverleaf::new(&params(leaves, 30.0)).expect("legal");
            let mut o = seen(0.0, v(0.0, 5.0), 0.0, None);
            o.able.turning_radius_m = able_m;
            let found = all(&mut b, &o, &mut memory(Some(0.0), &[(0.0, 0.0)]));
            assert!((point(&found[0]).norm() - leaf_m).abs() < 1e-9, "{leaves} leaves, {able_m} m");
        }
    }

    #[test]
    fn one_leaf_lies_down_flow_for_any_number_and_any_flow() {
        for leaves in 3..=8 {
            for up_deg in [0.0, 77.0, 180.0, 333.0] {
                let found = corners(&params(leaves, 30.0), v(0.0, 0.0), up_deg, v(0.0, 5.0));
                // From the end of the first line to the start of the second: the leaf's middle is down-flow.
                let down = Heading::from_deg(up_deg).opposite();
                assert!(Heading::from_vector(found[1] + found[2]).turn_to(down).abs() < 1e-9);
                // The lines all turn to the same side, by 360/n degrees each.
                let ways: Vec<Heading> =
                    (found.chunks_exact(2).take(leaves as usize)).map(|w| Heading::from_vector(w[1] - w[0])).collect();
                for w in ways.windows(2) {
                    let turn = w[0].turn_to(w[1]).abs();
                    assert!((turn - TAU / f64::from(leaves)).abs() < 1e-9);
                }
            }
        }
    }

    #[test]
    fn held_inside_the_area_even_in_its_corner() {
        // North-east corner at (200, 300).
        for p in corners(&Params::default(), v(230.0, 330.0), 0.0, v(190.0, 290.0)) {
            assert!(p.x <= 190.0 && p.y <= 290.0);
        }
    }

    #[test]
    fn keeps_its_corner_until_it_arrives_and_is_over_without_a_point() {
        let mut b = Cloverleaf::new(&Params::default()).expect("legal");
        let mut m = memory(Some(0.0), &[(0.0, 0.0)]);
        let o = seen(0.0, v(1.0, 9.0), 0.0, None);
        b.enter(&o, &m);
        assert!(matches!(step(&mut b, &o, false, &mut m), Stride::Start(_)));
        assert_eq!(step(&mut b, &o, false, &mut m), Stride::Keep);
        assert!(matches!(step(&mut b, &o, true, &mut m), Stride::Start(_)));
        // When it is entered again, it starts again.
        b.enter(&o, &m);
        assert!(matches!(step(&mut b, &o, false, &mut m), Stride::Start(_)));
        assert!(all(&mut b, &o, &mut memory(None, &[])).is_empty());
    }

    /// Four leaves close at 15 m, three at 15 sqrt(3) = 26 m.
    #[test]
    fn leaves_that_cannot_be_flown_are_refused() {
        for (leaves, leaf_m, legal) in
            [(2, 100.0, false), (4, 14.9, false), (4, 15.1, true), (3, 25.9, false), (3, 26.0, true)]
        {
            assert_eq!(Cloverleaf::new(&params(leaves, leaf_m)).is_ok(), legal, "{leaves} leaves of {leaf_m} m");
        }
    }
}
