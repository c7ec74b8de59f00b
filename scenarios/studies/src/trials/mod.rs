//! Trials of a vehicle in open water: what its builder measures before he trusts it with a mission.

mod figure;
mod fly;
mod hull;
mod kinds;
mod manoeuvres;
mod rudder;
mod sail;
mod steering;
mod straight;
mod trial;
mod turns;
mod write;

pub use figure::figure;
pub use fly::{Flight, FlownState, fly, table};
pub use hull::{Looks, drawn};
pub use manoeuvres::{has_rudder, trials};
pub use trial::{Curve, SteeringRow, Trial, TrialNumber};
pub use write::{flown_csv, numbers_csv, steering_csv};
