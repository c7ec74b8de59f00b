//! Instruments that no robot carries.

use world::catalogue::Entry;

/// Instruments of a gantry.
pub const PARTS: &[Entry] = &[Entry {
    name: "probes",
    what: "Conductivity probes of a gantry's head, scanned together: voltage with noise, quantisation, saturation.",
    source: "Webster et al. 2012, section 3",
}];
