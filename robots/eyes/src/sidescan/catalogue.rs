//! The parameters of the survey's parts, by name.

use world::catalogue::Entry;

/// The uses of a sidescan's pings.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "Waterfall",
        what: "pings by ground range and believed place, corrected for Lambert's law",
        source: "Blondel 2009, The Handbook of Sidescan Sonar, section 4.2",
    },
    Entry {
        name: "HighlightAndShadow",
        what: "objects: a bright return followed by its shadow, by a matched filter with a constant false-alarm rate",
        source: "Dobeck, Hyland & Smedley 1997, Proc. SPIE 3079, 90; Reed, Petillot & Bell 2003, IEEE J. Oceanic Eng. \
            28, 90",
    },
    Entry {
        name: "Merge",
        what: "merges objects of several passes that are the same",
        source: "weighted mean of repeated fixes",
    },
];
