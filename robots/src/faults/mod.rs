//! Faults that a scenario injects into a robot: instruments that fall silent, stick, or are off; position fixes that
//! lie; drives that stick, weaken or die.
//!
//! The readings are altered after the instruments have made them, and the set-points after the pilot has set them. So
//! no instrument, vehicle or stream of random numbers knows of a fault, and a robot without faults runs as ever. A
//! searcher learns of a fault only through its readings.

mod drive_spec;
mod drives;
mod instrument_spec;
mod instruments;
mod mistakes;
mod reading_fault;
mod span;
mod spec;
#[cfg(test)]
mod testing;

pub use drive_spec::{DriveFault, DriveSpec, FinFault, PropellerFault};
pub use drives::DriveFaults;
pub use instrument_spec::{DensityFault, DyeFault, EyeFault, FixFault, HeadingFault, LieSpec, MetresFault, SpeedFault};
pub use instruments::SensorFaults;
pub use mistakes::{Mistake, mistakes};
pub use span::Span;
pub use spec::{FaultSpec, Faulty};
