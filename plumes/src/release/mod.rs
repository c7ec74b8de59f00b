//! Sources and how they release filaments.

mod buoyancy;
mod placing;
mod source;
mod times;

pub use buoyancy::{BuoyancySpec, CompositionSpec, Curve, DissolvedSpec, Solute};
pub use placing::{clear, misplaced, place};
pub(crate) use source::VISCOSITY_M2_S;
pub use source::{NozzleSpec, PulseSpec, ReleaseSpec, Source, SourceSpec, ThreadStart};
pub use times::ReleaseTimes;
