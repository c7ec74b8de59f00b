//! Sources and how they release filaments.

mod source;
mod times;

pub use source::{NozzleSpec, ReleaseSpec, Source, SourceSpec, clear, place};
pub use times::ReleaseTimes;
