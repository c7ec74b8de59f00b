//! Sources and how they release filaments.

mod source;
mod times;

pub use source::{ReleaseSpec, Source, SourceSpec, clear, place};
pub use times::ReleaseTimes;
