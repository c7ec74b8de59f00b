//! Source map by the belief state of a partially observable Markov decision process.
//!
//! *Source*: Wang & Pang, section II-C, eqs. 1–6 (after Jiu, Chen, Deng & Pang 2019).
//!
//! *Parameters*: grid 40 × 25; μ, σx, σy, h in `trajectory` (the paper gives no values: ours); time unit, 1 s,
//! `update_period_s`; chance of a false detection, `false_detection`, none in the paper; `doubt`, none in the paper:
//! see `evidence`.
//!
//! *Deviations*: on a detection the factor is ε + (1 − ε)(1 − γ) with ε = `false_detection`, so that a belief remains
//! after a false alarm that no cell can explain; on none it is γ, as in the paper. One or more detections within an
//! update period count as one. There is no update while the vehicle is outside the grid. Kernel: see `kernel`.

use super::kernel::Kernel;
use super::mapper::{MapParams, Mapper};
use super::over_cells::OverCells;
use super::watch::Sighting;
use super::workings::{CellsSpec, Workings};
use crate::error::RobotError;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::area::Area;
use world::catalogue::Entry;
use world::cost::{Cost, Times};
use world::registry::Listed;
use world::seeds::Stream;

/// The mapper's parameters.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(transparent)]
pub struct PomdpSpec(pub CellsSpec);

impl Listed for PomdpSpec {
    const ENTRY: Entry = Entry {
        name: "Pomdp",
        what: "source map: Bayes' rule with the chance of meeting any release of the look-back",
        source: "Wang & Pang, section II-C, eqs. 1-6",
    };
}

impl MapParams for PomdpSpec {
    fn build(&self, area: &Area, _: Stream) -> Result<Box<dyn Mapper>, RobotError> {
        OverCells::around(&self.0, area, weigh)
    }

    fn check(&self, area: &Area) -> Result<(), RobotError> {
        self.0.check(area)
    }

    fn looks_ahead(&self) -> bool {
        true
    }

    fn cost(&self, times: &Times) -> Cost {
        self.0.cost(times)
    }
}

/// Weighs the places by the chance of meeting any release.
pub(super) fn weigh(with: &mut Workings, kernel: &mut Kernel, seen: &Sighting) {
    kernel.not_detecting(&mut with.likelihood);
    (with.evidence).weigh(seen.t_s, seen.detected, &mut with.likelihood);
}
