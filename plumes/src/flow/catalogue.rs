//! The currents a scenario can ask for.

use serde::{Deserialize, Serialize};
use world::catalogue::Entry;

use crate::flow::channel::OpenChannelSpec;
use crate::flow::layered::LayeredSpec;
use crate::flow::meander::MeanderSpec;
use crate::flow::uniform::UniformSpec;

/// One current; a scenario lists those that add up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub enum CurrentSpec {
    /// The same everywhere.
    Uniform(UniformSpec),
    /// Layers of different density with moving interfaces; at most one of these.
    Layered(LayeredSpec),
    /// Slow wandering, the same at all depths.
    Meander(MeanderSpec),
    /// A channel between side walls with its own bed and turbulence; at most one of these.
    OpenChannel(OpenChannelSpec),
}

/// One row for each current.
pub const CATALOGUE: &[Entry] = &[
    Entry {
        name: "Uniform",
        what: "One velocity everywhere and always",
        source: "Farrell et al. 2002, Environ. Fluid Mech. 2, 143",
    },
    Entry {
        name: "Layered",
        what: "Layers of different density and velocity with interfaces that rise and sink",
        source: "Pang 2009, section 6 (Duck); Hazel 1972, J. Fluid Mech. 51, 39; Gill 1982, section 6.2",
    },
    Entry {
        name: "Meander",
        what: "Coloured noise at the area's corners carried inside, made divergence-free",
        source: "Farrell et al. 2002, Environ. Fluid Mech. 2, 143; Chorin 1968, Math. Comp. 22, 745",
    },
    Entry {
        name: "OpenChannel",
        what: "Flume or canal between walls: log law over a smooth or rough bed, and turbulence resolved by random Fourier modes",
        source: "Nezu & Nakagawa 1993, Turbulence in Open-Channel Flows; Fung et al. 1992, J. Fluid Mech. 236, 281",
    },
];

/// What a scenario may say of the water beside its currents, by its field in `water`.
pub const OPTIONS: &[Entry] = &[Entry {
    name: "blockage",
    what: "Obstacles and bed turn the currents aside: free of divergence, tangent to all that is solid; without it water passes through",
    source: "Sherman 1978, J. Appl. Meteorol. 17, 312 (mass-consistent wind fields); Chorin 1968, Math. Comp. 22, 745",
}];
