//! The parts that every mapper over a grid has: a watch over observations, a belief, and the weight of evidence.
//!
//! *Source*: none of its own; see `watch`, `log_belief` and `evidence`.
//!
//! *Parameters*: [`CellsSpec`].
//!
//! *Deviations*: none.

use super::doubt::evidence::{DoubtSpec, Evidence};
use super::doubt::navigation::NavigationError;
use super::log_belief::LogBelief;
use super::spec::{GridSpec, TrajectorySpec};
use super::watch::Watch;
use crate::error::RobotError;
use crate::handoff::BeliefGrid;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::sync::Arc;
use world::area::Area;
use world::ranges::{Fraction, Positive};

/// Parameters of a mapper that weighs cells by the back-trajectory kernel.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct CellsSpec {
    /// The cells.
    pub grid: GridSpec,
    /// Model of how dye travels.
    pub trajectory: TrajectorySpec,
    /// Time between two updates, s.
    #[default(Positive::new(1.0))]
    pub update_period_s: Positive,
    /// Chance ε of a detection where there is no dye; must be greater than 0.
    #[default(Fraction::new(1e-6))]
    pub false_detection: Fraction,
    /// How far the map doubts its model.
    pub doubt: DoubtSpec,
}

impl CellsSpec {
    /// The same with other doubts.
    pub(super) fn with(&self, doubt: &DoubtSpec) -> Self {
        Self { doubt: doubt.clone(), ..self.clone() }
    }

    /// Checks that a mapper can hold so many cells and such a look-back.
    pub(super) fn check(&self, area: &Area) -> Result<(), RobotError> {
        self.grid.build(area)?;
        self.trajectory.check()
    }
}

/// The parts.
#[derive(Clone, Debug)]
pub(super) struct Workings {
    /// The places at which a source is considered: those of the belief's cells, or several in each of them.
    pub grid: Arc<BeliefGrid>,
    /// Places within a cell along each horizontal axis.
    pub places: usize,
    pub watch: Watch,
    pub belief: LogBelief,
    pub evidence: Evidence,
    /// One number per place, for an update.
    pub likelihood: Vec<f64>,
}

impl Workings {
    /// With a release every `release_s` and an update every `update_s`; all cells begin with the same probability.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if a chance is out of range, or if the look-back holds no release.
    pub(super) fn new(
        grid: BeliefGrid,
        trajectory: &TrajectorySpec,
        [release_s, update_s]: [f64; 2],
        false_detection: Fraction,
        doubt: &DoubtSpec,
        places: u32,
    ) -> Result<Self, RobotError> {
        trajectory.check()?;
        let (cells, places) = (Arc::new(grid), places as usize);
        let grid = match places {
            1 => cells.clone(),
            _ => Arc::new(cells.divided(places)),
        };
        Ok(Self {
            watch: Watch::new(&grid, trajectory.history(release_s), update_s),
            belief: LogBelief::over(&cells, &grid, NavigationError::from_doubt(doubt)),
            places,
            evidence: Evidence::new(false_detection, doubt, update_s)?,
            likelihood: vec![1.0; grid.len()],
            grid,
        })
    }

    /// The same, from the parameters that all mappers with the kernel share.
    ///
    /// # Errors
    /// As [`Workings::new`].
    pub(super) fn over_cells(spec: &CellsSpec, grid: BeliefGrid) -> Result<Self, RobotError> {
        let periods = [spec.trajectory.release_period_s, spec.update_period_s].map(Positive::get);
        Self::new(grid, &spec.trajectory, periods, spec.false_detection, &spec.doubt, spec.grid.places)
    }

    /// Multiplies one number per cell by the mean of `likelihood` over its places.
    pub(super) fn over_places(&self, cells: &mut [f64]) {
        if self.places == 1 {
            cells.iter_mut().zip(&self.likelihood).for_each(|(cell, l)| *cell *= l);
            return;
        }
        let grid = &self.belief.belief().grid;
        let mut sums = vec![0.0; cells.len()];
        for (i, l) in self.likelihood.iter().enumerate() {
            let [x, y, z] = self.grid.place(i);
            sums[grid.index([x / self.places, y / self.places, z])] += l;
        }
        let share = 1.0 / (self.places * self.places) as f64;
        cells.iter_mut().zip(sums).for_each(|(cell, sum)| *cell *= sum * share);
    }

    /// Takes `likelihood` into the belief.
    pub(super) fn update(&mut self, t_s: f64, detected: bool) {
        if let Some(fix_s) = self.watch.fix() {
            self.belief.fixed(fix_s);
        }
        self.belief.update(t_s, detected, &self.likelihood, self.evidence.share);
    }
}
