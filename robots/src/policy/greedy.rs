//! Goes where the source most likely is within half a way.
//!
//! *Source*: the greedy policy of the search benchmarks, as in Loisy & Eloy 2022 (Proc. R. Soc. A 478, 20220118).
//!
//! *Parameters*: none.
//!
//! *Deviations*: where no way ends near any probability, the one that ends nearest to the likeliest cell.

use super::choice::{Policy, PolicyParams};
use super::prospect::Prospect;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::registry::Listed;
use world::seeds::Stream;

/// The greedy policy has no parameters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Greedy {}

impl Listed for Greedy {
    const ENTRY: Entry = Entry {
        name: "Greedy",
        what: "the way at whose end the source most likely is",
        source: "Loisy & Eloy 2022, Proc. R. Soc. A 478, 20220118",
    };
}

impl PolicyParams for Greedy {
    fn build(&self) -> Box<dyn Policy> {
        Box::new(self.clone())
    }
}

impl Policy for Greedy {
    fn choose(&mut self, prospect: &Prospect<'_>, _: &mut Stream) -> usize {
        let near = |end| prospect.mean_over_distance(end, |steps| if steps <= 0.5 { 1.0 } else { 0.0 });
        let best = prospect.best(|way| near(way.end));
        if near(prospect.ways()[best].end) > 0.0 { best } else { prospect.towards(prospect.likeliest()) }
    }
}
