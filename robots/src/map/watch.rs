//! What a mapper observes between two of its updates: the flow always, and dye if any reading detected it.
//!
//! *Source*: Wang & Pang, section II-C: once in each time unit the vehicle is in a cell, and detects or does not.
//!
//! *Parameters*: time between two updates, s.
//!
//! *Deviations*: the sensor reports many times in a time unit. One detection makes it a unit with a detection, at the
//! place of the last detection; otherwise the place is that of the last reading.

use super::kernel::flow_history::{FlowHistory, SLACK_S};
use crate::handoff::BeliefGrid;
use nalgebra::{Vector2, Vector3};
use std::sync::Arc;

/// What a mapper sees in a tick: only measured and estimated quantities.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MapObservation {
    /// Time, s.
    pub t_s: f64,
    /// Believed position, world ENU, m.
    pub p_W: Vector3<f64>,
    /// Whether the chemical sensor detected; `None` if it did not report in this tick.
    pub detected: Option<bool>,
    /// Flow measured at the vehicle (east, north), m/s.
    pub flow: Option<Vector2<f64>>,
    /// Whether a position fix came in this tick.
    pub fixed: bool,
}

/// One piece of evidence: the vehicle was in this cell, with or without a detection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sighting {
    /// When, s.
    pub t_s: f64,
    /// The vehicle's cell.
    pub cell: usize,
    /// At least one reading since the last update detected.
    pub detected: bool,
}

/// Gathers observations, and returns a sighting each time an update is due.
#[derive(Clone, Debug)]
pub(super) struct Watch {
    /// The measured flow.
    pub history: FlowHistory,
    grid: Arc<BeliefGrid>,
    period_s: f64,
    next_s: Option<f64>,
    pending: Option<(bool, Vector3<f64>)>,
    fix_s: Option<f64>,
}

impl Watch {
    /// A watch over the grid with an update every `period_s`.
    pub(super) fn new(grid: &Arc<BeliefGrid>, history: FlowHistory, period_s: f64) -> Self {
        Self { history, grid: grid.clone(), period_s, next_s: None, pending: None, fix_s: None }
    }

    /// Takes in an observation.
    pub(super) fn see(&mut self, seen: &MapObservation) {
        let flow = (seen.flow).map(|v| [v.dot(&self.grid.axes[0]), v.dot(&self.grid.axes[1])]);
        self.history.record(seen.t_s, flow);
        if seen.fixed {
            self.fix_s = Some(seen.t_s);
        }
        // A detection stands for the whole period, at the place of its last occurrence.
        match (seen.detected, self.pending) {
            (Some(true), _) | (Some(false), None | Some((false, _))) => {
                self.pending = Some((seen.detected == Some(true), seen.p_W));
            }
            _ => {}
        }
    }

    /// Takes in an observation; returns a sighting if an update is due and there was a reading inside the grid, and a
    /// flow.
    pub(super) fn step(&mut self, seen: &MapObservation) -> Option<Sighting> {
        self.see(seen);
        let next = *self.next_s.get_or_insert(seen.t_s + self.period_s);
        if seen.t_s < next - SLACK_S {
            return None;
        }
        let missed = ((seen.t_s - next + SLACK_S) / self.period_s).floor();
        self.next_s = Some(next + (missed + 1.0) * self.period_s);
        self.take(seen.t_s)
    }

    /// Time of the last fix, given out once, s.
    pub(super) fn fix(&mut self) -> Option<f64> {
        self.fix_s.take()
    }

    /// The gathered sighting, given out once.
    pub(super) fn take(&mut self, t_s: f64) -> Option<Sighting> {
        let (detected, p_W) = self.pending.take()?;
        self.history.releases().next()?;
        Some(Sighting { t_s, cell: self.grid.cell(&p_W)?, detected })
    }
}
