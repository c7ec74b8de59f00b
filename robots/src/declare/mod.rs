//! Declaration rules: one file each.

mod along_flow;
mod catalogue;
mod credible_area;
#[cfg(test)]
mod testing;
mod unchanged;

pub use along_flow::AlongFlow;
pub use catalogue::{BeliefRule, BeliefRuleSpec, CATALOGUE, DeclareSpec};
pub use credible_area::{CredibleArea, Params as CredibleAreaParams};
pub use unchanged::{Params as UnchangedParams, Unchanged};
