//! Plain data that the stages hand to each other. A stage knows these types and no other stage.
//!
//! A type here has public fields, constructors and simple accessors. Algorithms and state that lasts from tick to
//! tick belong to the stages, or to [`crate::memory`] and [`crate::places`] where several stages need them.

mod belief;
mod bounds;
mod command;
mod control;
mod decision;
mod estimate;
mod gantry;
mod goal;
mod lcdp;
mod need;
mod pictures;
mod pilot_spec;
mod rates;
mod readings;
mod reply;
mod shown;
mod side;
mod ways;

pub use belief::{Belief, BeliefGrid, Odour};
pub use bounds::Bounds;
pub use command::{Actuation, ActuatorCommand, Command, MoveSetpoint, Setpoint};
pub use control::{
    Capabilities, Control, DriveCommand, DriveEffect, DriveUnit, MOST_DRIVES, NamedDrive, Plant, PlantDrive,
    ThrustTable,
};
pub use decision::{Behaviour, Decision, Declaration, Evidence, Outcome, PictureEvidence, UP_FLOW_EDGE, Verdict};
pub use estimate::{Estimate, FlowEstimate, Observation, detects};
pub use gantry::{
    GantryLayout, GantryObservation, GantryReadings, JointReadings, MAX_PROBES, ProbeMount, ProbeScan, TrackerState,
};
pub use goal::{Goal, GuidanceStatus, HeadGoal, Manoeuvre, Vertical};
pub use lcdp::Lcdp;
pub use need::Need;
pub use pictures::{Picture, SidescanPing};
pub use pilot_spec::{GliderSpec, PilotSpec, ThrustersSpec, TorpedoSpec};
pub use rates::{RateCommand, RateLimits, TurnLimit};
pub use readings::{
    AdcpReading, AltimeterReading, Attitude, Beam, ChemicalReading, CtdReading, DepthReading, DvlReading, LblFix,
    RangeScan, Readings,
};
pub use reply::{ExchangeTiming, HeadOrder, MotionOrder, MoveOrder, Reply, ReplyOutcome};
pub use shown::Shown;
pub use shown::layers::{Layer, LayerState};
pub use shown::regions::{Region, RegionState, Regions, region_name};
pub use shown::zone::Zone;
pub use side::Side;
pub use ways::{Outlook, WAYS, WaysAhead};

#[cfg(test)]
pub(crate) mod testing;
