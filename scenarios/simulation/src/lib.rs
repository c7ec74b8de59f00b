//! What happens: scenarios, the tick, trials.

pub mod abnormal;
pub mod assemble;
pub mod auv;
pub mod error;
pub mod explain;
pub mod frame;
pub mod gantry;
pub mod ocean;
pub mod outcome;
pub mod registry;
pub mod scenario;
pub mod score;
pub mod searchers;
pub mod tick;
pub mod trial;
