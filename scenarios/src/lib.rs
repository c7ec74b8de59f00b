//! What happens: scenarios, the tick, trials, and the command `rheotaxis`.

pub mod abnormal;
pub mod assemble;
pub mod campaign;
pub mod cli;
pub mod frame;
pub mod gantry;
pub mod live;
mod ocean;
pub mod report;
pub mod reproduce;
pub mod scenario;
pub mod score;
pub mod score_vision;
pub mod segment;
pub mod spun_up;
pub mod statistics;
pub mod system;
pub mod tick;
pub mod trial;
