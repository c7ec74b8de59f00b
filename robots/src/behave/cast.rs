//! Just out of the plume: crosses the flow from side to side, each time farther, with a step up-flow at each turn.
//!
//! *Source*: surge-cast, Lochmatter & Martinoli 2009 (Tracking odor plumes in a laminar wind field with bio-inspired
//! algorithms, ISER 2008, 473) and Li et al. 2001 (cross-flow cast); the cone of possible sources up-flow of a
//! detection, swept row by row, Balkovsky & Shraiman 2002 (PNAS 99, 12589; arXiv:nlin/0109019).
//!
//! *Parameters*: half width of the first crossing, `first_m`, m, 24; how much each next one is wider, `growth_m`, m,
//! 12; step up-flow at each turn, `up_m`, m, 0; greatest half width, `widest_m`, m, 120. Published steps are those of
//! wheeled robots: one step of 1 m to one side, two to the other, and so on. Here a step is 24 m, the turning circle
//! of a REMUS: a crossing shorter than that cannot be flown. A cone of Balkovsky & Shraiman with a half angle of
//! atan(v / V) is `first_m` and `growth_m` of up_m · v / V.
//!
//! *Deviations*: the first crossing leads to the side from which the vehicle came, for the plume is there. When the
//! widest crossing is over, the plume counts as lost: the papers' robots go on for ever.

use super::Behave;
use super::behaviour::BehaviourParams;
use super::corners::{Corners, Pattern};
use crate::error::{RobotError, require};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::{NonNegative, Positive};
use world::registry::Listed;

/// Parameters of the behaviour.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "CastParams")]
#[serde(deny_unknown_fields, default)]
pub(super) struct Params {
    /// Half width of the first crossing, m.
    #[default(Positive::new(24.0))]
    pub first_m: Positive,
    /// How much wider to either side each next crossing is, m.
    #[default(NonNegative::new(12.0))]
    pub growth_m: NonNegative,
    /// Step up-flow at each turn, m.
    #[default(NonNegative::new(0.0))]
    pub up_m: NonNegative,
    /// Greatest half width, m.
    #[default(Positive::new(120.0))]
    pub widest_m: Positive,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "Cast",
        what: "track out: across the flow from side to side, each time farther, with a step up-flow at each turn",
        source: "Lochmatter & Martinoli 2009; Li et al. 2001; Balkovsky & Shraiman 2002",
    };
}

impl BehaviourParams for Params {
    fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
        require(
            self.growth_m.get() > 0.0,
            "track_out.Cast.growth_m",
            "must be > 0: crossings that do not grow would never end",
        )?;
        Ok(Box::new(Corners::new(self.clone())))
    }
}

impl Pattern for Params {
    fn corner(&self, number: u32) -> Option<Vector2<f64>> {
        let half_m = self.first_m.get() + self.growth_m.get() * f64::from(number);
        let side = if number.is_multiple_of(2) { 1.0 } else { -1.0 };
        let corner = Vector2::new(self.up_m.get() * f64::from(number + 1), side * half_m);
        (half_m <= self.widest_m.get()).then_some(corner)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::behave::corners::tests::corners;

    fn params(first_m: f64, growth_m: f64, up_m: f64, widest_m: f64) -> Params {
        Params {
            first_m: Positive::new(first_m),
            growth_m: NonNegative::new(growth_m),
            up_m: NonNegative::new(up_m),
            widest_m: Positive::new(widest_m),
        }
    }

    #[test]
    fn crossings_grow_on_both_sides_until_the_widest() {
        let mut b = params(20.0, 10.0, 0.0, 45.0).build().expect("legal");
        assert_eq!(corners(&mut *b), [(0.0, 20.0), (0.0, -30.0), (0.0, 40.0)]);
        let e = params(20.0, 0.0, 0.0, 45.0).build().expect_err("endless").to_string();
        assert!(e.starts_with("track_out.Cast.growth_m: must be > 0"), "{e}");
    }

    /// Every place of the cone of half angle atan(0.2) up to its end lies within half a row of a crossing.
    #[test]
    fn rows_sweep_the_cone_up_flow() {
        let (row_m, slope) = (24.0, 0.2);
        let pattern = params(row_m * slope, row_m * slope, row_m, 24.1);
        let all: Vec<_> = (0..).map_while(|k| pattern.corner(k)).collect();
        assert_eq!(all.len(), 5);
        for (k, corner) in all.iter().enumerate() {
            assert!((corner.x - row_m * (k + 1) as f64).abs() < 1e-9);
            assert!((corner.y.abs() - slope * corner.x).abs() < 1e-9, "on the cone's edge");
        }
        assert!(all.windows(2).all(|w| w[0].y * w[1].y < 0.0), "from edge to edge");
    }
}
