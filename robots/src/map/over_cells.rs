//! A mapper that weighs cells by the back-trajectory kernel; how, its rule says.
//!
//! *Source*: none of its own; see `pomdp` and `bayesian`.
//!
//! *Parameters*: [`CellsSpec`].
//!
//! *Deviations*: none.

use super::doubt::alternatives::Alternatives;
use super::kernel::Kernel;
use super::mapper::Mapper;
use super::watch::{MapObservation, Sighting};
use super::workings::{CellsSpec, Workings};
use crate::error::RobotError;
use crate::handoff::{Belief, BeliefGrid, Outlook, WAYS, WaysAhead};
use std::sync::Arc;
use world::area::Area;

/// Writes into the likelihood what a sighting says of every place; the kernel is aimed at it.
pub(super) type Weigh = fn(&mut Workings, &mut Kernel, &Sighting);

/// State of the mapper.
#[derive(Clone, Debug)]
pub(super) struct OverCells {
    with: Workings,
    kernel: Kernel,
    weigh: Weigh,
}

impl OverCells {
    /// A mapper over a grid; all cells begin with the same probability.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if the chance of a false detection is 0 or 1, or if the look-back holds no release.
    pub(super) fn new(spec: &CellsSpec, grid: BeliefGrid, weigh: Weigh) -> Result<Self, RobotError> {
        let with = Workings::over_cells(spec, grid)?;
        Ok(Self { kernel: Kernel::within(&with.grid, with.places, &spec.trajectory), with, weigh })
    }

    /// The mapper of a scenario, in every variant of the model that the doubt holds.
    pub(super) fn around(spec: &CellsSpec, area: &Area, weigh: Weigh) -> Result<Box<dyn Mapper>, RobotError> {
        Alternatives::around(&spec.doubt, |doubt| {
            let spec = spec.with(doubt);
            Ok(Box::new(Self::new(&spec, spec.grid.build(area)?, weigh)?))
        })
    }
}

impl Mapper for OverCells {
    fn step(&mut self, seen: &MapObservation) {
        let Some(sighting) = self.with.watch.step(seen) else {
            return;
        };
        self.kernel.aim(&self.with.watch.history, sighting.cell);
        (self.weigh)(&mut self.with, &mut self.kernel, &sighting);
        self.with.update(sighting.t_s, sighting.detected);
    }

    fn belief(&self) -> &Belief {
        self.with.belief.belief()
    }

    /// The chance of a detection on a way is that of any of its points, as if they were independent.
    fn outlook(&mut self, ways: &WaysAhead) -> Option<Outlook> {
        self.with.watch.history.releases().next()?;
        let cells = self.belief().grid.len();
        let mut chances = Vec::with_capacity(WAYS);
        for way in 0..WAYS {
            let mut none = vec![1.0; cells];
            for point in ways.points(way) {
                let Some(at) = self.with.grid.cell(&point.push(ways.z_m)) else { continue };
                self.kernel.aim(&self.with.watch.history, at);
                self.kernel.not_detecting(&mut self.with.likelihood);
                self.with.over_places(&mut none);
            }
            chances.push(Arc::new(none.into_iter().map(|n| self.with.evidence.some(n)).collect()));
        }
        Some(Outlook { ways: *ways, chances })
    }

    fn ln_evidence(&self) -> f64 {
        self.with.belief.ln_evidence()
    }
}
