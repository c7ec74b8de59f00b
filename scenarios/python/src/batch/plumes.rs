//! Spun-up plumes by their seeds, kept for the next episodes.

use super::worker_pool::{Halt, WorkerPool};
use crate::error::other;
use pyo3::prelude::*;
use rheotaxis::cache::{CacheFault, SpinUps};
use rheotaxis::error::AssembleError;
use rheotaxis::ocean::SpunUp;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Event, Observer, Trial};
use std::sync::Arc;

/// Spun-up plumes, the most recently used last.
pub(crate) struct Plumes {
    most: usize,
    kept: Vec<(u64, Arc<SpunUp>)>,
    /// Those on the disk.
    shelf: Option<SpinUps>,
}

/// Stops a spin-up.
struct Stop<'a>(&'a Halt);

impl Observer for Stop<'_> {
    fn see(&mut self, _event: &Event) {}

    fn goes_on(&mut self) -> bool {
        self.0.well()
    }
}

/// A plume to be made.
struct PlumeOrder {
    seed: u64,
    made: Option<Result<SpunUp, AssembleError>>,
}

impl Plumes {
    /// Keeps so many in memory, and uses those on the disk.
    pub(crate) fn new(most: usize, shelf: Option<SpinUps>) -> Self {
        Self { most: most.max(1), kept: Vec::new(), shelf }
    }

    /// What went wrong with those on the disk, since this was asked last.
    pub(crate) fn fault(&self) -> Option<CacheFault> {
        self.shelf.as_ref().and_then(SpinUps::fault)
    }

    /// The plumes of these seeds, in their order; those that are not kept are made.
    pub(crate) fn get(&mut self, loaded: &Loaded, seeds: &[u64], crew: &WorkerPool) -> PyResult<Vec<Arc<SpunUp>>> {
        let mut missing: Vec<u64> = seeds.to_vec();
        missing.sort_unstable();
        missing.dedup();
        missing.retain(|seed| !self.kept.iter().any(|(kept, _)| kept == seed));
        let order = |seed| PlumeOrder { seed, made: None };
        let mut orders: Vec<PlumeOrder> = missing.into_iter().map(order).collect();
        let shelf = self.shelf.as_ref();
        crew.work(&mut orders, |order, halt| {
            order.made = spun_up(loaded, order.seed, shelf, halt).transpose();
        })?;
        for order in orders {
            if let Some(made) = order.made {
                self.kept.push((order.seed, Arc::new(made.map_err(other)?)));
            }
        }
        let mut found = Vec::with_capacity(seeds.len());
        for seed in seeds {
            let place = self.kept.iter().position(|(kept, _)| kept == seed);
            let place = place.ok_or_else(|| other("a spin-up was not made"))?;
            let used = self.kept.remove(place);
            found.push(used.1.clone());
            self.kept.push(used);
        }
        let surplus = self.kept.len().saturating_sub(self.most);
        self.kept.drain(..surplus);
        Ok(found)
    }
}

/// Lets a plume develop; `None` if it was stopped.
fn spun_up(loaded: &Loaded, seed: u64, shelf: Option<&SpinUps>, halt: &Halt) -> Result<Option<SpunUp>, AssembleError> {
    let mut trial = Trial::assemble(loaded, seed)?;
    let mut stop = Stop(halt);
    Ok(match shelf {
        Some(shelf) => trial.spin_up_with(shelf, &mut stop).map(|d| d.state),
        None => trial.spin_up(&mut stop),
    })
}
