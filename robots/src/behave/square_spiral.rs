//! Just out of the plume: a square spiral around the place where it was lost.
//!
//! *Source*: surge-spiral, Lochmatter & Martinoli 2009 (Tracking odor plumes in a laminar wind field with bio-inspired
//! algorithms, ISER 2008, 473); as a square of legs that grow at every second corner in gas-source localisation with
//! wheeled robots.
//!
//! *Parameters*: first leg `leg_m`, m, 24; growth at every second corner, `growth_m`, m, 9.6; number of legs, `legs`,
//! 16. Published are legs of 1 m and a growth of 0.4 m. Here a step is 24 m, as in Cast.
//!
//! *Deviations*: the first leg leads up-flow, for the source is there. The papers' spirals have no end.

use super::Behave;
use super::behaviour::BehaviourParams;
use super::corners::{Corners, Pattern};
use crate::error::RobotError;
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroU32;
use world::catalogue::Entry;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;

/// Parameters of the behaviour.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "SquareSpiralParams")]
#[serde(deny_unknown_fields, default)]
pub(super) struct Params {
    /// Length of the first leg, m.
    #[default(Positive::new(24.0))]
    pub leg_m: Positive,
    /// How much longer legs become at every second corner, m.
    #[default(NonNegative::new(9.6))]
    pub growth_m: NonNegative,
    /// Number of legs.
    #[default(NonZeroU32::new(16).expect("16 is not zero"))]
    pub legs: NonZeroU32,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "SquareSpiral",
        what: "track out: a square spiral around the place where the plume was lost, up-flow first",
        source: "Lochmatter & Martinoli 2009",
    };
}

impl BehaviourParams for Params {
    fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
        Ok(Box::new(Corners::new(self.clone())))
    }
}

impl Pattern for Params {
    fn corner(&self, number: u32) -> Option<Vector2<f64>> {
        if number >= self.legs.get() {
            return None;
        }
        let leg = |k: u32| {
            let length_m = self.leg_m.get() + self.growth_m.get() * f64::from(k / 2);
            length_m * [Vector2::x(), Vector2::y(), -Vector2::x(), -Vector2::y()][k as usize % 4]
        };
        Some((0..=number).map(leg).sum())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::behave::corners::tests::corners;

    #[test]
    fn up_flow_across_and_round_with_longer_legs() {
        let spec = Params {
            leg_m: Positive::new(10.0),
            growth_m: NonNegative::new(4.0),
            legs: NonZeroU32::new(6).expect("not zero"),
        };
        let want = [(10.0, 0.0), (10.0, 10.0), (-4.0, 10.0), (-4.0, -4.0), (14.0, -4.0), (14.0, 14.0)];
        let got = corners(&mut *spec.build().expect("legal"));
        assert_eq!(got.len(), want.len());
        assert!(got.iter().zip(want).all(|(g, w)| (g.0 - w.0).abs() + (g.1 - w.1).abs() < 1e-9), "{got:?}");
    }
}
