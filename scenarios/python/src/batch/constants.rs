//! What the environments of a batch are like, as arrays.

use super::Rules;
use super::group::{Group, State};
use crate::arrays::{array, column};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// What all environments are like, by row.
#[derive(Default)]
pub(super) struct BatchConstants {
    rows: usize,
    /// Observations of each searcher.
    seen: Vec<Vec<f32>>,
    /// Place (ENU), heading, distance to the nearest source and the least one, of each searcher.
    truth: Vec<Vec<f64>>,
    /// Whether each searcher asks.
    asks: Vec<Vec<bool>>,
    terminated: Vec<bool>,
    truncated: Vec<bool>,
    success: Vec<bool>,
    t_s: Vec<f64>,
    outcomes: Vec<Option<&'static str>>,
    digests: Vec<Option<String>>,
}

impl BatchConstants {
    /// Reads all environments.
    pub(super) fn from_groups(rules: &Rules, groups: &[Group]) -> Self {
        let n = rules.agents.len();
        let mut told = Self {
            seen: vec![Vec::new(); n],
            truth: vec![Vec::new(); n],
            asks: vec![Vec::new(); n],
            ..Self::default()
        };
        for env in groups.iter().flat_map(|group| &group.envs) {
            told.rows += 1;
            for (k, mind) in env.minds.iter().enumerate() {
                let truth = &mind.truth;
                told.seen[k].extend(&mind.features);
                told.truth[k].extend(truth.p_W);
                told.truth[k].extend([truth.heading_rad, truth.distance_m, truth.closest_m]);
                told.asks[k].push(mind.asks);
            }
            told.terminated.push(env.state == State::Terminated);
            told.truncated.push(env.state == State::Truncated);
            told.success.push(env.success);
            told.t_s.push(env.t_s);
            told.outcomes.push(env.outcome.map(|o| o.label()));
            told.digests.push(env.digest.clone());
        }
        told
    }

    /// As arrays of Python, newly made.
    pub(super) fn dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let dict = PyDict::new(py);
        let rows = self.rows;
        let wide = |all: usize| all / rows.max(1);
        let seen = self.seen.iter().map(|v| array(py, v, &[rows, wide(v.len())]));
        dict.set_item("obs", seen.collect::<PyResult<Vec<_>>>()?)?;
        let truth = self.truth.iter().map(|v| array(py, v, &[rows, wide(v.len())]));
        dict.set_item("truth", truth.collect::<PyResult<Vec<_>>>()?)?;
        let asks = self.asks.iter().map(|v| column(py, v));
        dict.set_item("asks", asks.collect::<PyResult<Vec<_>>>()?)?;
        dict.set_item("terminated", column(py, &self.terminated)?)?;
        dict.set_item("truncated", column(py, &self.truncated)?)?;
        dict.set_item("success", column(py, &self.success)?)?;
        dict.set_item("t_s", column(py, &self.t_s)?)?;
        dict.set_item("outcome", &self.outcomes)?;
        dict.set_item("digest", &self.digests)?;
        Ok(dict)
    }
}
