//! The currents a scenario can ask for.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;

use crate::flow::channel::OpenChannelSpec;
use crate::flow::layered::LayeredSpec;
use crate::flow::meander::MeanderSpec;
use crate::flow::tide::TideSpec;
use crate::flow::uniform::UniformSpec;
use crate::flow::waves::WavesSpec;

/// One current; a scenario lists those that add up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
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
    /// Current ellipses of the tide.
    Tide(TideSpec),
    /// Surface waves; at most one of these, with any number of trains.
    Waves(WavesSpec),
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
    Entry {
        name: "Tide",
        what: "Tidal current: ellipses of constituents, rotating or rectilinear",
        source: "Pugh 1987, Tides, Surges and Mean Sea-Level, section 6:4; Foreman 1978",
    },
    Entry {
        name: "Waves",
        what: "Surface waves by linear theory, trains or a JONSWAP sea: orbits for hull and instruments, Stokes' drift and mixing for the plume",
        source: "Dean & Dalrymple 1991, Water Wave Mechanics; Hasselmann et al. 1973; Andrews & McIntyre 1978, J. Fluid Mech. 89, 609",
    },
];

/// What a scenario may say of the water beside its currents, by its field in `water`.
pub const OPTIONS: &[Entry] = &[Entry {
    name: "blockage",
    what: "Obstacles and bed turn the currents aside: free of divergence, tangent to all that is solid; without it water passes through",
    source: "Sherman 1978, J. Appl. Meteorol. 17, 312 (mass-consistent wind fields); Chorin 1968, Math. Comp. 22, 745",
}];
