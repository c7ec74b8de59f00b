//! What a question for the concentration is answered from.

use super::bands::Bands;
use super::domain::Domain;
use super::lookup::Lookup;
use super::packet::CUT_SIGMAS;
use super::store::Store;
use crate::simd::dispatch::InstructionSet;

/// The plume as it is asked.
pub(super) struct Question<'a> {
    pub(super) stores: &'a [Store],
    pub(super) bands: &'a Bands,
    pub(super) room: &'a Domain,
    pub(super) lookup: &'a Lookup,
    pub(super) path: InstructionSet,
    pub(super) now_s: f64,
}

impl Question<'_> {
    /// Longest reach of any filament, m; 0 in open water, where nobody needs it.
    pub(super) fn reach(&self) -> f64 {
        if self.room.is_open() {
            return 0.0;
        }
        let oldest = |s: &Store| Some(s.largest(0..s.len(), self.now_s - s.born_s.first()?));
        let largest = self.stores.iter().filter_map(oldest).fold(0.0, f32::max);
        f64::from(CUT_SIGMAS * 1.000_01 * largest)
    }
}
