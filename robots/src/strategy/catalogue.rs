//! The strategies by name.

use world::catalogue::Entry;

/// Strategies.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "Amp",
        what: "adaptive mission planner: find, track in, track out, reacquire, declare, go home",
        source: "Pang 2009, section 5, Fig. 5",
    },
    Entry {
        name: "MapAndPlan",
        what: "zig-zag to the first detection, then planned paths to the map's likeliest cell, until a rule declares",
        source: "Wang & Pang, section II",
    },
    Entry {
        name: "Subsumption",
        what: "layers from the lowest up: find, maintain, reacquire, declare, avoid, plume map, go home; the highest that asks holds the vehicle",
        source: "Tian et al. 2013, section 2, Fig. 3; Brooks 1986, IEEE J. Robotics and Automation RA-2, 14",
    },
    Entry {
        name: "OpenLoop",
        what: "rudder, stern plane and propeller from a time table",
        source: "open-loop vehicle trials (Prestero 2001, chapter 6)",
    },
    Entry {
        name: "Subregions",
        what: "one subregion after the other, searched until declared in, traced to its up-flow edge or timed out",
        source: "Pang 2009, section 6",
    },
];
