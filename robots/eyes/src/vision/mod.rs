//! Finds dye and source in a picture by their colours, and decides whether that verifies a declared source.

mod blobs;
mod catalogue;
mod clusters;
mod colour_pattern;
mod dye_look;
mod extractor;
mod fuzzy;
mod level;
mod membership;
mod passes;
pub mod place;
mod stretch;
#[cfg(test)]
mod testing;
mod verifier;

pub use blobs::{Blob, blobs};
pub use catalogue::CATALOGUE;
pub use clusters::{Fate, fates, shortest_paths};
pub use colour_pattern::{Pattern, Reference, WHITE, distance, nearest};
pub use dye_look::DyeLook;
pub use extractor::Extractor;
pub use fuzzy::Inference;
pub use level::levelled;
pub use membership::{Differences, Outputs};
pub use passes::{Pass, Segmentation, Target, segment};
pub use stretch::stretched;
pub use verifier::{Lack, Sighting, Verifier};
