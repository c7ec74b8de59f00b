//! Plain data passed between the stages; a stage knows these and no other stage.

mod command;
mod decision;
mod estimate;
mod goal;
mod readings;

pub use command::{ActuatorCommand, Command, Setpoint};
pub use decision::{Behaviour, Decision, Declaration, Outcome};
pub use estimate::{Attitude, Estimate, FlowEstimate, Observation};
pub use goal::{Goal, GuidanceStatus, Manoeuvre, Vertical};
pub use readings::{
    AdcpReading, AltimeterReading, AttitudeReading, ChemicalReading, DepthReading, DvlReading,
    LblFix, Readings,
};
