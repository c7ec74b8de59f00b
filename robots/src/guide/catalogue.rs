//! The guidance modes by name.

use world::catalogue::Entry;

/// Guidance modes.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "GoToPoint",
        what: "heads for a point at constant speed until within the arrival radius",
        source: "Pang 2009, section 4.1, eq. 4-6",
    },
    Entry {
        name: "FollowLine",
        what: "reaches a line's start with its heading, then steers by the distance off the line",
        source: "Pang 2009, section 4.2, eq. 7-10",
    },
    Entry {
        name: "GoToPointWithHeading",
        what: "follows the shortest of the four CSC Dubins paths to a point and heading",
        source: "Pang 2009, section 4.3; Dubins 1957",
    },
    Entry {
        name: "Course",
        what: "keeps a direction over ground",
        source: "Pang 2009, section 5.3: what Track-In commands",
    },
    Entry {
        name: "Direct",
        what: "passes actuator set-points through, without cage or filter",
        source: "open-loop vehicle trials (Prestero 2001, chapter 6)",
    },
    Entry {
        name: "Cage",
        what: "turns every command away from the area's edge; aborts far outside",
        source: "Pang 2009, section 4.4, eq. 11-13",
    },
];
