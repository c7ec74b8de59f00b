//! Goes where the source is nearest on average, each place of it discounted by its distance.
//!
//! *Source*: Littman, Cassandra & Kaelbling 1995 (ICML, 362): the value of each state if it were known, weighed by the
//! belief.
//!
//! *Parameters*: discount for each step, `discount`, 0.9.
//!
//! *Deviations*: distances are straight lines.

use super::choice::{Policy, PolicyParams};
use super::prospect::Prospect;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::catalogue::Entry;
use world::math;
use world::ranges::Fraction;
use world::registry::Listed;
use world::seeds::Stream;

/// Parameters of the policy.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Qmdp {
    /// Discount for each length of a way, more than 0.
    #[default(Fraction::new(0.9))]
    pub discount: Fraction,
}

impl Listed for Qmdp {
    const ENTRY: Entry = Entry {
        name: "Qmdp",
        what: "the way at whose end the discounted distance to the source is best on average",
        source: "Littman et al. 1995",
    };
}

impl PolicyParams for Qmdp {
    fn build(&self) -> Box<dyn Policy> {
        Box::new(self.clone())
    }
}

impl Policy for Qmdp {
    fn choose(&mut self, prospect: &Prospect<'_>, _: &mut Stream) -> usize {
        let ln = math::ln(self.discount.get().max(f64::MIN_POSITIVE));
        prospect.best(|way| prospect.mean_over_distance(way.end, |steps| math::exp(ln * steps)))
    }
}
