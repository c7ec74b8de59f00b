//! Goes where the source is expected to be near and the belief sure.
//!
//! *Source*: Loisy & Eloy 2022 (Proc. R. Soc. A 478, 20220118): space-aware infotaxis.
//!
//! *Parameters*: none. The cost of a belief is log₂(D + 2^(H−1) − ½), with D the mean distance to the source in
//! steps and H the entropy in bits: about the logarithm of the steps still to go.
//!
//! *Deviations*: distances are straight lines in lengths of a way, not steps on a lattice. The cost is not below 0: it
//! is 0 where the source is met.

use super::choice::{Policy, PolicyParams};
use super::prospect::{BeliefAfter, Prospect};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::math;
use world::registry::Listed;
use world::seeds::Stream;

/// Space-aware infotaxis has no parameters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpaceAware {}

impl Listed for SpaceAware {
    const ENTRY: Entry = Entry {
        name: "SpaceAware",
        what: "the way after which the expected logarithm of distance and entropy together is least",
        source: "Loisy & Eloy 2022, Proc. R. Soc. A 478, 20220118",
    };
}

impl PolicyParams for SpaceAware {
    fn build(&self) -> Box<dyn Policy> {
        Box::new(self.clone())
    }
}

impl Policy for SpaceAware {
    fn choose(&mut self, prospect: &Prospect<'_>, _: &mut Stream) -> usize {
        // 2^(H−1) = e^H / 2 with H in nat. A natural logarithm ranks as the binary one.
        let cost = |after: &BeliefAfter| math::ln((after.distance + 0.5 * math::exp(after.entropy_nat) - 0.5).max(1.0));
        prospect.best(|way| -prospect.expected(way, cost))
    }
}
