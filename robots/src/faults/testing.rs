//! Shared by the tests of faults.

use super::{FaultSpec, Faulty};
use world::ranges::{NonNegative, Positive};

/// A fault from a time until another, s.
pub(super) fn fault(at_s: f64, until_s: Option<f64>, what: Faulty) -> FaultSpec {
    FaultSpec { at_s: NonNegative::new(at_s), until_s: until_s.map(Positive::new), what }
}
