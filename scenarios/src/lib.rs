//! What happens: scenarios, the tick, trials, and the command `rheotaxis`.

pub mod frame;
pub mod live;
pub mod report;
pub mod scenario;
