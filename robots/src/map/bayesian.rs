//! Source map by Bayesian inference: the sum over releases on a detection, the product on none.
//!
//! *Source*: Pang & Farrell 2006 (IEEE SMC-B 36(5)), as Wang & Pang cite it (ref. 17).
//!
//! *Parameters*: as `Pomdp`; the paper's S_ij is Wang & Pang's p of eq. 1.
//!
//! *Deviations*: reconstructed (the paper's own equations were not available): γ_ij = Π_l (1 − μ S_ij(l)) on
//! non-detection; on detection β_ij = Σ_l S_ij(l), normalised over the cells i; α_i ← α_i·β_ij or α_i·γ_ij,
//! renormalised. It differs from `Pomdp` only on a detection: there it uses the sum over releases instead of 1 − Π.
//! The two are nearly equal where chances are small, and differ near the vehicle, where the product saturates. With ε
//! = `false_detection`: (1 − ε) β + ε / n. Otherwise as `Pomdp`.

use super::kernel::Kernel;
use super::mapper::{MapParams, Mapper};
use super::over_cells::OverCells;
use super::pomdp;
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
pub struct BayesianSpec(pub CellsSpec);

impl Listed for BayesianSpec {
    const ENTRY: Entry = Entry {
        name: "Bayesian",
        what: "source map: product over releases on non-detection, their sum on detection (reconstructed)",
        source: "Pang & Farrell 2006, IEEE SMC-B 36(5)",
    };
}

impl MapParams for BayesianSpec {
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

/// Weighs the places; on a detection by their shares of the sum over releases.
fn weigh(with: &mut Workings, kernel: &mut Kernel, seen: &Sighting) {
    if !seen.detected {
        return pomdp::weigh(with, kernel, seen);
    }
    let (likelihood, evidence) = (&mut with.likelihood, &mut with.evidence);
    kernel.expected(likelihood);
    let total: f64 = likelihood.iter().sum();
    let (e, n) = (evidence.epsilon, likelihood.len() as f64);
    let same = evidence.repeated(seen.t_s, true);
    let (scale, floor) = if total > 0.0 {
        ((1.0 - e) / total, e / n)
    } else {
        // No cell explains the detection: a false alarm, which tells nothing.
        (0.0, 1.0)
    };
    for l in likelihood {
        // A reading that repeats the one before has, like the others, a sum of 1.
        *l = same / n + (1.0 - same) * (*l * scale + floor);
    }
}
