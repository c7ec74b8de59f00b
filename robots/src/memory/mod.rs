//! What a vehicle remembers of a plume. Behaviours write it; declaration rules and strategies read it.

mod evidence;
mod fixes;
mod lcdp_queue;
mod lost_points;
mod plume_memory;

pub use fixes::{FixMove, FixWatch, NavigationFix};
pub use lcdp_queue::{LcdpQueue, most_up_flow_first};
pub use lost_points::LostPoints;
pub use plume_memory::{LCDPS, PlumeMemory};
