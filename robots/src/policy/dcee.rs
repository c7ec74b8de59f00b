//! Goes where it is expected to be near the estimated source, and the estimate to be good.
//!
//! *Source*: Chen, Rhodes & Liu 2021 (Automatica): dual control for exploitation and exploration in autonomous search.
//!
//! *Parameters*: none. The cost is E[|x̂ − x|² + tr P]: x̂ and P are mean and covariance of the source's place
//! after the outcome, x is the vehicle's place.
//!
//! *Deviations*: outcomes are whether there is a detection on the way, weighed exactly, instead of sampled
//! concentrations. Weighed exactly, the two terms add up to the mean square distance of the source from the vehicle by
//! the belief of today, whatever could be detected (law of total variance). So it goes to the mean of its belief, and
//! what it learns, it learns on the way there.

use super::choice::{Policy, PolicyParams};
use super::prospect::{Prospect, Way};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::registry::Listed;
use world::seeds::Stream;

/// Dual control has no parameters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Dcee {}

impl Listed for Dcee {
    const ENTRY: Entry = Entry {
        name: "Dcee",
        what: "the way after which distance to the estimated source and its covariance are expected to be least",
        source: "Chen, Rhodes & Liu 2021, Automatica",
    };
}

impl PolicyParams for Dcee {
    fn build(&self) -> Box<dyn Policy> {
        Box::new(self.clone())
    }
}

impl Policy for Dcee {
    fn choose(&mut self, prospect: &Prospect<'_>, _: &mut Stream) -> usize {
        let cost = |way: &Way| -> f64 {
            let of =
                |(chance, mean, trace): (f64, Vector2<f64>, f64)| chance * ((mean - way.end).norm_squared() + trace);
            way.outcomes.iter().map(|outcome| of(prospect.moments(outcome))).sum()
        };
        prospect.best(|way| -cost(way))
    }
}
