//! The entries of `rheotaxis list` about looking at pictures.

use world::catalogue::Entry;

/// Parts of the visual verification.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "verifier",
        what: "Whether a picture shows a source giving off dye: enough dye that is redder than the rest, and a darker \
            body next to it",
        source: "ours, on the parts found by Tian et al. 2013, section 5",
    },
    Entry {
        name: "add_up",
        what: "Whether all pictures of a place together show a source: laid on the ground by navigation and overlap, \
            added up to a Bayes factor; verified, rejected or cannot tell",
        source: "ours; Wald 1947, Sequential Analysis, ch. 3; registration: Lewis 1995, Vision Interface, 120; Eustice, \
            Pizarro & Singh 2008, IEEE J. Oceanic Eng. 33, 103; visibility: Duntley 1963, J. Opt. Soc. Am. 53, 214",
    },
    Entry {
        name: "colours",
        what: "Fuzzy colour extractor: three passes towards red for the dye, four towards dark blue for the source",
        source: "Tian et al. 2013, section 5, eq. 6-13, GetCP, FuzzyColorSeg",
    },
    Entry {
        name: "delta1, delta2, edges",
        what: "Clusters of the passes' colour patterns: keeps those near the one that is nearest to the reference",
        source: "Tian et al. 2013, section 5, two criteria; Floyd 1962",
    },
    Entry {
        name: "dehaze, give_back",
        what: "Against haze: first removes slow changes and stretches each colour to the whole range; returns the \
            pixels of dropped plume patterns",
        source: "ours; histogram stretching as Iqbal et al. 2007",
    },
];
