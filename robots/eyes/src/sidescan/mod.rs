//! Turns a sidescan's pings into lines of a picture of the bed, and finds the objects in it.

mod catalogue;
mod detect;
mod merge;
#[cfg(test)]
mod testing;
mod waterfall;

pub use catalogue::CATALOGUE;
pub use detect::{Object, detect};
pub use merge::{MergedObject, merge};
pub use waterfall::{CELL_M, Row, Waterfall};
