//! Searches for the plume by going to places of the area that are drawn at random, one after the other.
//!
//! *Source*: random way-points, the floor that knows nothing.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

use super::behaviour::BehaviourParams;
use super::{Behave, Stride};
use crate::error::RobotError;
use crate::handoff::{Manoeuvre, Observation};
use crate::memory::PlumeMemory;
use crate::places::{MARGIN_M, inside};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::registry::Listed;
use world::seeds::Stream;

/// Parameters of the behaviour; it has none.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "RandomPointsParams")]
#[serde(deny_unknown_fields)]
pub(super) struct Params {}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "RandomPoints",
        what: "find: to places of the area drawn at random, one after the other",
        source: "random way-points, a floor for comparisons",
    };
}

impl BehaviourParams for Params {
    fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
        Ok(Box::new(RandomPoints { begun: false }))
    }
}

/// State of the behaviour.
#[derive(Debug)]
struct RandomPoints {
    begun: bool,
}

impl Behave for RandomPoints {
    fn enter(&mut self, _: &Observation, _: &PlumeMemory) {
        self.begun = false;
    }

    fn step(&mut self, seen: &Observation, arrived: bool, _: &mut PlumeMemory, rng: &mut Stream) -> Stride {
        if self.begun && !arrived {
            return Stride::Keep;
        }
        self.begun = true;
        let of = |share: f64, whole_m: f64| (share - 0.5) * whole_m;
        let place = Vector2::new(of(rng.uniform(), seen.area.length_m), of(rng.uniform(), seen.area.width_m));
        let point = inside(&seen.area, seen.area.world(place), MARGIN_M);
        Stride::Start(Manoeuvre::GoToPoint { point, radius_m: None })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::behave::testing::{memory, point, v};
    use crate::handoff::testing::seen;

    #[test]
    fn places_are_spread_over_the_whole_area() {
        let (mut b, mut m, mut rng) =
            (Params {}.build().expect("legal"), memory(None, &[]), Stream::new(1, "points", "test"));
        let o = seen(0.0, v(0.0, 0.0), 0.0, None);
        b.enter(&o, &m);
        let mut quarters = [0; 4];
        for k in 0..400 {
            let Stride::Start(to) = b.step(&o, k > 0, &mut m, &mut rng) else { panic!("a place") };
            let p = point(&to);
            assert!(p.x.abs() <= 190.0 && p.y.abs() <= 290.0, "{p:?}");
            quarters[usize::from(p.x > 0.0) + 2 * usize::from(p.y > 0.0)] += 1;
        }
        // A binomial of 400 and a quarter: five standard deviations are 43.
        assert!(quarters.iter().all(|n| (57..=143).contains(n)), "{quarters:?}");
        assert_eq!(b.step(&o, false, &mut m, &mut rng), Stride::Keep);
    }
}
