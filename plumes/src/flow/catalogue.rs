//! The currents a scenario can ask for.

use world::catalogue::Entry;
use world::kind;

use super::channel::open_channel::OpenChannelSpec;
use super::plane_current::meander::MeanderSpec;
use super::plane_current::tide::TideSpec;
use super::plane_current::uniform::UniformSpec;
use crate::flow::current::CurrentParams;
use crate::flow::layered::LayeredSpec;
use crate::flow::waves::WavesSpec;

kind! {
    /// Currents, waves and turbulence. A scenario lists one or more, and their velocities add up.
    pub CurrentSpec = Currents of CurrentParams {
        heading: "Flows",
        rows: [UniformSpec, LayeredSpec, MeanderSpec, OpenChannelSpec, TideSpec, WavesSpec],
    }
}

/// What a scenario may say of the water beside its currents, by its field in `water`.
pub const OPTIONS: &[Entry] = &[Entry {
    name: "blockage",
    what: "Obstacles and bed turn the currents aside: free of divergence, tangent to all that is solid; without it water passes through",
    source: "Sherman 1978, J. Appl. Meteorol. 17, 312 (mass-consistent wind fields); Chorin 1968, Math. Comp. 22, 745",
}];
