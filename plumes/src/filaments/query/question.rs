//! What a question for the concentration is answered from.

use super::packet::CUT_SIGMAS;
use crate::filaments::store::arrays::Store;
use crate::filaments::store::bands::Bands;
use crate::filaments::walls::domain::Domain;
use crate::filaments::water::lookup::Lookup;
use crate::simd::dispatch::InstructionSet;

/// The plume as it is asked.
pub(crate) struct Question<'a> {
    pub(crate) stores: &'a [Store],
    pub(crate) bands: &'a Bands,
    pub(crate) room: &'a Domain,
    pub(crate) lookup: &'a Lookup,
    pub(crate) path: InstructionSet,
    pub(crate) now_s: f64,
}

impl Question<'_> {
    /// Longest reach of any filament, m; 0 in open water, where nobody needs it.
    pub(crate) fn reach(&self) -> f64 {
        if self.room.is_open() {
            return 0.0;
        }
        let oldest = |s: &Store| Some(s.largest(0..s.len(), self.now_s - s.born_s.first()?));
        let largest = self.stores.iter().filter_map(oldest).fold(0.0, f32::max);
        f64::from(CUT_SIGMAS * 1.000_01 * largest)
    }
}
