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

use super::alternatives::Alternatives;
use super::kernel::Kernel;
use super::mapper::{MapParams, Mapper};
use super::watch::MapObservation;
use super::workings::{CellsSpec, Workings};
use crate::error::RobotError;
use crate::handoff::{Belief, BeliefGrid};
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
        Alternatives::around(&self.0.doubt, |doubt| {
            let spec = self.0.with(doubt);
            Ok(Box::new(Pomdp::new(&spec, spec.grid.build(area)?)?))
        })
    }

    fn check(&self, area: &Area) -> Result<(), RobotError> {
        self.0.check(area)
    }

    fn cost(&self, times: &Times) -> Cost {
        self.0.cost(times)
    }
}

/// State of the mapper.
#[derive(Clone, Debug)]
pub struct Pomdp {
    with: Workings,
    kernel: Kernel,
}

impl Pomdp {
    /// A mapper over a grid; all cells begin with the same probability.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the chance of a false detection is 0 or 1, or if the look-back holds no release.
    pub fn new(spec: &CellsSpec, grid: BeliefGrid) -> Result<Self, RobotError> {
        let with = Workings::over_cells(spec, grid)?;
        Ok(Self { kernel: Kernel::within(&with.grid, with.places, &spec.trajectory), with })
    }
}

impl Mapper for Pomdp {
    fn step(&mut self, seen: &MapObservation) {
        let Some(sighting) = self.with.watch.step(seen) else {
            return;
        };
        self.kernel.aim(&self.with.watch.history, sighting.cell);
        self.kernel.not_detecting(&mut self.with.likelihood);
        let (with, detected) = (&mut self.with, sighting.detected);
        (with.evidence).weigh(sighting.t_s, detected, &mut with.likelihood);
        self.with.update(sighting.t_s, sighting.detected);
    }

    fn belief(&self) -> &Belief {
        self.with.belief.belief()
    }

    fn ln_evidence(&self) -> f64 {
        self.with.belief.ln_evidence()
    }
}
