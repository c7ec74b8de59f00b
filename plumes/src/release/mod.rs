//! Sources and how they release filaments.

mod buoyancy;
mod placing;
mod source;
mod times;

pub use buoyancy::{BuoyancySpec, CompositionSpec, Curve, DissolvedSpec, Solute};
pub use placing::{clear, misplaced, place};
pub use source::{NozzleSpec, PulseSpec, ReleaseSpec, Source, SourceSpec};
pub use times::ReleaseTimes;
