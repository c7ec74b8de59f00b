//! The behaviours by name; each place in a strategy has an enum of those that can fill it.

use super::{cloverleaf, find, reacquire, track_in, track_out};
use crate::error::RobotError;
use crate::handoff::Behave;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;

macro_rules! place {
    ($(#[$doc:meta])* $spec:ident { $first:ident, $($name:ident => $module:ident :: $ty:ident),+ $(,)? }) => {
        $(#[$doc])*
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(deny_unknown_fields)]
        pub enum $spec {
            $(#[doc = concat!("See `", stringify!($module), ".rs`.")] $name($module::Params)),+
        }

        impl Default for $spec {
            fn default() -> Self {
                Self::$first(Default::default())
            }
        }

        impl $spec {
            /// The behaviour, ready to be entered.
            ///
            /// # Errors
            /// [`RobotError::Invalid`] when a parameter makes no sense.
            pub fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
                Ok(match self { $(Self::$name(p) => Box::new($module::$ty::new(p)?)),+ })
            }
        }
    };
}

place! {
    /// Ways to look for the plume.
    FindSpec { ZigZag, ZigZag => find::ZigZag }
}
place! {
    /// Ways to go on in the plume.
    TrackInSpec { CounterTurn, CounterTurn => track_in::CounterTurn }
}
place! {
    /// Ways to act just after losing it.
    TrackOutSpec { UpAcross, UpAcross => track_out::UpAcross }
}
place! {
    /// Ways to look round where it was lost.
    ReacquireSpec { Bowtie, Bowtie => reacquire::Bowtie, Cloverleaf => cloverleaf::Cloverleaf }
}

/// Behaviours.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "GoTo",
        what: "goes to a place",
        source: "Pang 2009, section 5.1",
    },
    Entry {
        name: "ZigZag",
        what: "find: crosses the flow at 70 or 110 degrees to it, reflected at the area's edges",
        source: "Pang 2009, section 5.2",
    },
    Entry {
        name: "CounterTurn",
        what: "track in: beta off up-flow, to the other side at each detection",
        source: "Pang 2009, section 5.3, Table 1",
    },
    Entry {
        name: "UpAcross",
        what: "track out: to a point up-flow and across from the most up-flow lost point",
        source: "Pang 2009, section 5.4, Table 2",
    },
    Entry {
        name: "Bowtie",
        what: "reacquire: two crossing lines round the lost points, one point after the other",
        source: "Pang 2009, section 5.5, Table 3, Fig. 6",
    },
    Entry {
        name: "Cloverleaf",
        what: "reacquire: leaves round the newest last detection point, one of them down-flow",
        source: "Tian et al. 2013, section 3, Fig. 4b",
    },
    Entry {
        name: "SoftAvoid",
        what: "avoid: turns off the course asked for, the more the nearer the ranging's echoes in the way are",
        source: "Tian et al. 2013, section 2; Khatib 1986, Int. J. Robotics Research 5(1), 90",
    },
    Entry {
        name: "Passes",
        what: "survey: parallel lines over a place, for sidescan and camera",
        source: "Pang 2009, sections 4.2 and 6",
    },
    Entry {
        name: "GoHome",
        what: "goes back to the launch point",
        source: "Pang 2009, section 4.1",
    },
    Entry {
        name: "TimeTable",
        what: "open loop: rudder, stern plane and propeller from a time table",
        source: "open-loop vehicle trials (Prestero 2001, chapter 6)",
    },
];
