//! The strategies by name.

use super::amp::AmpSpec;
use super::external::ExternalSpec;
use super::inspect::InspectSpec;
use super::map_and_plan::MapAndPlanSpec;
use super::open_loop::OpenLoopSpec;
use super::policy_search::PolicySearchSpec;
use super::route::RouteSpec;
use super::spec::{Strategies, StrategyParams};
use super::subregions::SubregionsSpec;
use super::subsumption::SubsumptionSpec;
use world::rows;

rows! {
    /// Strategies, which decide what a robot does from launch to the end of its mission. Most combine behaviours and a
    /// declaration rule, each chosen by name.
    StrategySpec = Strategies of StrategyParams {
        heading: "Strategies",
        rows: [AmpSpec, MapAndPlanSpec, PolicySearchSpec, SubsumptionSpec, OpenLoopSpec, SubregionsSpec, InspectSpec, RouteSpec, ExternalSpec],
    }
}
