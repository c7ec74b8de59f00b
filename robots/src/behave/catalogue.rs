//! The behaviours by name. Each place for a behaviour in a strategy has its own list of behaviours that can fill it.

use super::behaviour::BehaviourParams;
use super::{
    bilateral, cast, climb, cloverleaf, find, lawnmower, random_points, reacquire, square_spiral, track_in, track_out,
};
use world::catalogue::Entry;
use world::kind;

const HEADING: &str = "Behaviours";

kind! {
    /// Behaviours that search the area for the plume while nothing has been detected yet (Find).
    pub FindSpec = Finds of BehaviourParams {
        heading: HEADING,
        rows: [find::Params, lawnmower::Params, random_points::Params],
        standard: find::Params,
    }
}

kind! {
    /// Behaviours that follow the plume towards its source while the vehicle detects it (Track-In).
    pub TrackInSpec = TracksIn of BehaviourParams {
        heading: HEADING,
        rows: [track_in::Params, climb::Params, bilateral::Params],
        standard: track_in::Params,
    }
}

kind! {
    /// Behaviours for the first moments after the plume was lost (Track-Out): they try to return into it at once.
    pub TrackOutSpec = TracksOut of BehaviourParams {
        heading: HEADING,
        rows: [track_out::Params, cast::Params, square_spiral::Params],
        standard: track_out::Params,
    }
}

kind! {
    /// Behaviours that search around the last detections when Track-Out has not met the plume again (Reacquire).
    pub ReacquireSpec = Reacquires of BehaviourParams {
        heading: HEADING,
        rows: [reacquire::Params, cloverleaf::Params],
        standard: reacquire::Params,
    }
}

/// Behaviours that belong to strategies; no scenario chooses them by name.
pub const PARTS: &[Entry] = &[
    Entry { name: "GoTo", what: "goes to a place", source: "Pang 2009, section 5.1" },
    Entry {
        name: "SoftAvoid",
        what: "avoid: turns away from echoes ahead; the nearer they are, the sharper the turn",
        source: "Tian et al. 2013, section 2; Khatib 1986, Int. J. Robotics Research 5(1), 90",
    },
    Entry {
        name: "Passes",
        what: "survey: parallel lines over a place, for sidescan and camera",
        source: "Pang 2009, sections 4.2 and 6",
    },
    Entry { name: "GoHome", what: "goes back to the launch point", source: "Pang 2009, section 4.1" },
    Entry {
        name: "TimeTable",
        what: "open loop: rudder, stern plane and propeller from a time table",
        source: "open-loop vehicle trials (Prestero 2001, chapter 6)",
    },
];
