//! What happens: scenarios, the tick, trials.

pub mod abnormal;
pub mod assemble;
pub mod frame;
pub mod gantry;
pub mod ocean;
pub mod outcome;
pub mod registry;
pub mod scenario;
pub mod score;
pub mod spun_up;
pub mod system;
pub mod tick;
pub mod trial;
