//! Plain data passed between the stages; a stage knows these and no other stage.

mod behaviour;
mod belief;
mod command;
mod decision;
mod estimate;
mod fixes;
mod gantry;
mod goal;
mod layers;
mod lcdp;
mod lost_points;
mod pictures;
mod places;
mod readings;
mod regions;
mod setting;

pub use behaviour::{Behave, LCDPS, PlumeMemory, Side, Stride, detects};
pub use belief::{Belief, BeliefGrid, Odour};
pub use command::{ActuatorCommand, Command, Setpoint};
pub use decision::{Behaviour, Decision, Declaration, Evidence, Outcome, UP_FLOW_EDGE, Verdict};
pub use estimate::{Attitude, Estimate, FlowEstimate, Observation};
pub use fixes::{FixMove, FixWatch, NavigationFix};
pub use gantry::{
    GantryBehaviour, GantryDecision, GantryLayout, GantryObservation, GantryReadings,
    JointReadings, MAX_PROBES, ProbeMount, ProbeScan, TrackerState,
};
pub use goal::{Goal, GuidanceStatus, Manoeuvre, Vertical};
pub use layers::{Layer, LayerState};
pub use lcdp::{Lcdp, LcdpQueue, most_up_flow_first};
pub use lost_points::LostPoints;
pub use pictures::{Picture, SidescanPing};
pub use places::{MARGIN_M, edges, inside};
pub use readings::{
    AdcpReading, AltimeterReading, AttitudeReading, Beam, ChemicalReading, CtdReading,
    DepthReading, DvlReading, LblFix, RangeScan, Readings,
};
pub use regions::{Region, RegionState, Regions, region_name};
pub use setting::Setting;

#[cfg(test)]
pub(crate) mod testing;
