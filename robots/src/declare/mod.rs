//! Declaration rules: one file each.

mod along_flow;
mod catalogue;
#[cfg(test)]
mod cluster_tests;
mod credible_area;
mod held;
mod rule;
mod siz_f;
mod siz_t;
mod sure;
#[cfg(test)]
mod testing;
mod unchanged;
mod zone_size;
#[cfg(test)]
mod zone_tests;

pub use along_flow::AlongFlow;
pub use catalogue::{BeliefRuleSpec, BeliefRules, DeclareSpec, Declares};
pub use credible_area::{CredibleArea, Params as CredibleAreaParams};
pub use rule::{BeliefRule, BeliefRuleParams, DeclareParams, Points};
pub use siz_f::SizF;
pub use siz_t::{Order as SizOrder, SizT};
pub use sure::{Params as SureParams, Sure};
pub use unchanged::{Params as UnchangedParams, Unchanged};
pub use zone_size::{AdaptiveSize, ZoneSize};
