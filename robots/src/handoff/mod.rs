//! Plain data passed between the stages; a stage knows these and no other stage.

mod behaviour;
mod belief;
mod command;
mod decision;
mod estimate;
mod gantry;
mod goal;
mod layers;
mod lost_points;
mod pictures;
mod places;
mod readings;
mod regions;
mod setting;

pub use behaviour::{Behave, PlumeMemory, Side, Stride, detects};
pub use belief::{Belief, BeliefGrid, Odour};
pub use command::{ActuatorCommand, Command, Setpoint};
pub use decision::{Behaviour, Decision, Declaration, Outcome, Verdict};
pub use estimate::{Attitude, Estimate, FlowEstimate, Observation};
pub use gantry::{
    GantryBehaviour, GantryDecision, GantryLayout, GantryObservation, GantryReadings,
    JointReadings, MAX_PROBES, ProbeMount, ProbeScan, TrackerState,
};
pub use goal::{Goal, GuidanceStatus, Manoeuvre, Vertical};
pub use layers::{Layer, LayerState};
pub use lost_points::{LostPoint, LostPoints};
pub use pictures::{Picture, SidescanPing};
pub use places::{edges, inside};
pub use readings::{
    AdcpReading, AltimeterReading, AttitudeReading, Beam, ChemicalReading, DepthReading,
    DvlReading, LblFix, RangeScan, Readings,
};
pub use regions::{Region, RegionState, Regions};
pub use setting::Setting;

#[cfg(test)]
pub(crate) mod testing;
