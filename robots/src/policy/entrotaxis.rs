//! Goes where the next measurement is hardest to foretell.
//!
//! *Source*: Hutchinson, Oh & Chen 2018 (Information Fusion 42, 179): entrotaxis.
//!
//! *Parameters*: none.
//!
//! *Deviations*: a measurement is whether there is a detection on the way, instead of a concentration. Where that
//! stays uncertain even if the source is known, this policy is drawn there, for it does not ask what would be learned.

use super::choice::{Policy, PolicyParams};
use super::prospect::Prospect;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::math;
use world::registry::Listed;
use world::seeds::Stream;

/// Entrotaxis has no parameters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Entrotaxis {}

impl Listed for Entrotaxis {
    const ENTRY: Entry = Entry {
        name: "Entrotaxis",
        what: "the way on which the outcome is most uncertain",
        source: "Hutchinson et al. 2018, Information Fusion 42, 179",
    };
}

impl PolicyParams for Entrotaxis {
    fn build(&self) -> Box<dyn Policy> {
        Box::new(self.clone())
    }
}

impl Policy for Entrotaxis {
    fn choose(&mut self, prospect: &Prospect<'_>, _: &mut Stream) -> usize {
        let surprise = |chance: f64| if chance > 0.0 { -chance * math::ln(chance) } else { 0.0 };
        prospect.best(|way| prospect.after(way).iter().map(|after| surprise(after.chance)).sum())
    }
}
