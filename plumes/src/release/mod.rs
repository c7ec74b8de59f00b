//! Sources and how they release filaments.

mod placing;
mod source;
mod times;

pub use placing::{clear, misplaced, place};
pub use source::{NozzleSpec, ReleaseSpec, Source, SourceSpec};
pub use times::ReleaseTimes;
