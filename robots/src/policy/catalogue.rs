//! The policies by name.

use super::choice::PolicyParams;
use super::{dcee, dual, entrotaxis, greedy, infotaxis, qmdp, space_aware, thompson};
use world::kind;

kind! {
    /// Policies, which choose the next way by the map of the source and what it expects on each way.
    pub PolicySpec = Policies of PolicyParams {
        heading: "Policies",
        rows: [
            infotaxis::Infotaxis, space_aware::SpaceAware, thompson::Params, qmdp::Qmdp, greedy::Greedy, dual::Dual,
            entrotaxis::Entrotaxis, dcee::Dcee,
        ],
        standard: space_aware::SpaceAware,
    }
}
