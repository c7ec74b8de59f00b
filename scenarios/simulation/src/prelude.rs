//! What a strategy, a sensor or a current of your own needs, under one name: `use rheotaxis::prelude::*`.
//!
//! The whole of each crate is beside it: [`world`], [`plumes`], [`robots`].

pub use crate::params;
pub use crate::scenario::{Loaded, load, load_with};
pub use crate::trial::Trial;
pub use nalgebra::{Vector2, Vector3};
pub use plumes::error::PlumeError;
pub use plumes::flow::{CurrentParams, CurrentSlot, Currents, FreeWater, PlaneCurrent};
pub use robots::error::RobotError;
pub use robots::handoff::{
    Behaviour, Decision, Declaration, Goal, Manoeuvre, Need, Observation, Outcome, Readings, Vertical,
};
pub use robots::sense::{Fitting, Sensor, SensorParams, Sensors, Surroundings};
pub use robots::strategy::{About, Setting, Strategies, Strategy, StrategyParams};
pub use world::ranges::{Finite, NonNegative, Positive};
pub use world::registry::{Listed, Registry};
pub use world::seeds::Stream;
pub use world::units::Heading;
