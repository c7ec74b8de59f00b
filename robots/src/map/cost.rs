//! Predicts the memory and time that a source map will take.
//!
//! *Source*: the mappers' own loops beside this file; unit costs measured as `world::cost` says.
//!
//! *Parameters*: none.
//!
//! *Deviations*: sets of releases are counted as if the flow were steady: each set then holds ages that differ by 0.8
//! κ.

use super::hmm::HmmSpec;
use super::spec::{GridSpec, TrajectorySpec};
use super::workings::CellsSpec;
use world::cost::{Cost, Part, Times};
use world::math;

/// Memory of a cell, bytes: belief, its logarithm, likelihood, and the copies for the frame and the recording.
const CELL_BYTES: f64 = 80.0;
/// Time for one cell or particle and one set of releases, s.
const CELL_S: f64 = 1e-9;
/// See above.
pub(super) const PARTICLE_S: f64 = 2.7e-9;
/// Time to gather a release, s, and its memory, bytes.
const RELEASE: (f64, f64) = (20e-9, 80.0);
/// Memory of a step of the chain, and of a level in it, bytes; time for a hop of a cell in a row, s.
const STEP_BYTES: (f64, f64) = (400.0, 128.0);
/// See above.
const HOP_S: f64 = 0.5e-9;
/// Most different hops of a step that the chain is built with.
const HOPS: f64 = 9.0;

impl GridSpec {
    /// Number of cells.
    pub fn cells(&self) -> f64 {
        f64::from(self.along) * f64::from(self.across) * f64::from(self.vertical)
    }

    /// Number of places at which a source is considered.
    pub(super) fn all_places(&self) -> f64 {
        self.cells() * f64::from(self.places) * f64::from(self.places)
    }

    fn cost(&self) -> Cost {
        let cells = self.cells();
        Cost::single(Part::new("grid", format!("{cells:.0} cells")).holds(self.all_places() * CELL_BYTES))
    }
}

impl TrajectorySpec {
    /// Number of releases in the look-back, `period_s` apart, and number of sets that they are merged into.
    fn releases(&self, period_s: f64) -> [f64; 2] {
        let all = self.lookback_s.get() / period_s;
        let grows = math::ln(1.0 + 0.8 * self.merge.get());
        let sets = 5.0 + 1.3 * math::ln(all.max(1.0)) / grows;
        // Nothing is merged: no number of sets.
        [all, if sets < all { sets } else { all }]
    }
}

/// Cost of a mapper that weighs its cells by the kernel of the look-back, at `each_s` per set of releases.
pub(super) fn by_kernel(grid: &GridSpec, way: &TrajectorySpec, period_s: f64, each_s: f64, times: &Times) -> Cost {
    let [all, sets] = way.releases(way.release_period_s.get());
    let updates = times.mission_s / period_s.max(times.step_s);
    let mut cost = grid.cost();
    let what = format!("{updates:.1e} updates of the map");
    let update =
        Part::new("update_period_s", what).takes(updates * (sets * each_s + all * RELEASE.0)).by(period_s, -1.0);
    let what = format!("{all:.1e} releases in the look-back");
    let kept =
        Part::new("trajectory.release_period_s", what).holds(all * RELEASE.1).by(way.release_period_s.get(), -1.0);
    cost.parts.extend([update, kept]);
    cost
}

impl CellsSpec {
    pub(super) fn cost(&self, times: &Times) -> Cost {
        let each_s = self.doubt.maps() as f64 * self.grid.all_places() * CELL_S;
        let period_s = self.update_period_s.get();
        by_kernel(&self.grid, &self.trajectory, period_s, each_s, times)
    }
}

impl HmmSpec {
    pub(super) fn work(&self, times: &Times) -> Cost {
        let step_s = self.step_s.get();
        let [steps, sets] = self.trajectory.releases(step_s);
        let maps = self.doubt.maps() as f64;
        let (cells, levels) = (maps * self.grid.all_places(), f64::from(self.grid.vertical));
        let across = f64::from(self.grid.places) * (f64::from(self.grid.along) + f64::from(self.grid.across));
        let rows = maps * (across + levels);
        let hops_s = if self.sheared && levels > 1.0 { 3.0 * cells * HOPS * HOP_S } else { rows * HOPS * HOP_S };
        let updates = times.mission_s / step_s.max(times.step_s);
        let levels = if self.sheared { levels } else { 1.0 };
        let mut cost = self.grid.cost();
        let chain = Part::new("step_s", format!("{steps:.1e} steps of the chain"))
            .holds(steps * (STEP_BYTES.0 + levels * STEP_BYTES.1))
            .takes(updates * (steps * hops_s + sets * cells * CELL_S))
            .by(step_s, -1.0);
        cost.parts.push(chain);
        cost
    }
}
