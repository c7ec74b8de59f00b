//! The estimators that a scenario can choose.

use world::catalogue::Entry;

/// One row per estimator.
pub const CATALOGUE: &[Entry] = &[Entry {
    name: "DeadReckoning",
    what: "Integrates compass and Doppler log, jumps at long-baseline fixes; flow is ground velocity plus relative \
        water velocity, low-passed.",
    source: "Pang 2009, sections 4 and 6",
}];
