//! The declaration rules by name.

use super::along_flow::AlongFlow;
use super::rule::{BeliefRuleParams, DeclareParams};
use super::siz_f::SizF;
use super::siz_t::SizT;
use super::{credible_area, sure, unchanged};
use world::kind;

const HEADING: &str = "Declaration rules";

kind! {
    /// Rules that declare where the source is, from the points where the vehicle last detected the plume.
    pub DeclareSpec = Declares of DeclareParams {
        heading: HEADING,
        rows: [AlongFlow, SizT, SizF],
        standard: AlongFlow,
    }
}

kind! {
    /// Rules that declare where the source is, from the robot's map of where it may be.
    pub BeliefRuleSpec = BeliefRules of BeliefRuleParams {
        heading: HEADING,
        rows: [unchanged::Params, credible_area::Params, sure::Params],
        standard: unchanged::Params,
    }
}
