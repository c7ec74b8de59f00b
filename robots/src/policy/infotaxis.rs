//! Goes where the belief is expected to become surest.
//!
//! *Source*: Vergassola, Villermaux & Shraiman 2007 (Nature 445, 406).
//!
//! *Parameters*: none.
//!
//! *Deviations*: meeting the source is an outcome like others; whoever asks says what can come of a way. A vehicle that
//! passes over its source does not notice it.

use super::choice::{Policy, PolicyParams};
use super::prospect::Prospect;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::registry::Listed;
use world::seeds::Stream;

/// Infotaxis has no parameters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Infotaxis {}

impl Listed for Infotaxis {
    const ENTRY: Entry = Entry {
        name: "Infotaxis",
        what: "the way after which the entropy of the belief is expected to be least",
        source: "Vergassola et al. 2007, Nature 445, 406",
    };
}

impl PolicyParams for Infotaxis {
    fn build(&self) -> Box<dyn Policy> {
        Box::new(self.clone())
    }
}

impl Policy for Infotaxis {
    fn choose(&mut self, prospect: &Prospect<'_>, _: &mut Stream) -> usize {
        prospect.best(|way| -prospect.expected(way, |after| after.entropy_nat))
    }
}
