//! Gathers information until the belief is sure enough, then goes to the likeliest place.
//!
//! *Source*: dual-mode control after Cassandra, Kaelbling & Kurien 1996 (IROS, 963), with infotaxis as the first mode.
//!
//! *Parameters*: entropy below which it goes to the likeliest cell, `sure_nat`, nat, 1.5.
//!
//! *Deviations*: none.

use super::choice::{Policy, PolicyParams};
use super::infotaxis::Infotaxis;
use super::prospect::Prospect;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::ranges::Positive;
use world::registry::Listed;
use world::seeds::Stream;

/// Parameters of the policy.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Dual {
    /// Entropy of the belief below which it goes to the likeliest cell, nat.
    #[default(Positive::new(1.5))]
    pub sure_nat: Positive,
}

impl Listed for Dual {
    const ENTRY: Entry = Entry {
        name: "Dual",
        what: "infotaxis until the entropy is below 1.5 nat, then to the likeliest cell",
        source: "Cassandra et al. 1996",
    };
}

impl PolicyParams for Dual {
    fn build(&self) -> Box<dyn Policy> {
        Box::new(self.clone())
    }
}

impl Policy for Dual {
    fn choose(&mut self, prospect: &Prospect<'_>, rng: &mut Stream) -> usize {
        if prospect.entropy_nat() < self.sure_nat.get() {
            prospect.towards(prospect.likeliest())
        } else {
            Infotaxis {}.choose(prospect, rng)
        }
    }
}
