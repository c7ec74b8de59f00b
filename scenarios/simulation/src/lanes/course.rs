//! Which runs can share an ocean.

use crate::ocean::Origin;
use crate::scenario::{Loaded, Scenario, cost};
use std::path::Path;
use world::seeds::Seed;

/// Everything that the ocean of a run follows from, from its beginning to the end of the mission.
#[derive(Clone, Debug)]
pub(super) struct Course {
    pub(super) origin: Origin,
    step_s: f64,
    drift_period_s: f64,
}

impl Course {
    pub(super) fn from_scenario(scenario: &Scenario, base_dir: &Path, seed: Seed) -> Self {
        Self {
            origin: Origin::from_scenario(scenario, base_dir, seed),
            step_s: scenario.time.step_s.get(),
            drift_period_s: scenario.time.drift_period_s.get(),
        }
    }

    /// The first thing that differs from another course.
    pub(super) fn unlike(&self, other: &Self) -> Option<String> {
        let differ = |a: f64, b: f64| a.to_bits() != b.to_bits();
        if self.origin.seed() != other.origin.seed() {
            Some("seed".to_string())
        } else if differ(self.step_s, other.step_s) {
            Some("time.step_s".to_string())
        } else if differ(self.drift_period_s, other.drift_period_s) {
            Some("time.drift_period_s".to_string())
        } else {
            self.origin.unlike(&other.origin)
        }
    }
}

/// Divides runs into groups that have the same ocean, step by step, and of which all runs together need at most
/// `memory_bytes`; a run that needs more by itself is a group of its own. Each group holds indices of `runs`, in their
/// order, and the groups come in the order of their first runs.
pub fn group_by_ocean(runs: &[(&Loaded, Seed)], memory_bytes: f64) -> Vec<Vec<usize>> {
    struct Group {
        course: Course,
        runs: Vec<usize>,
        bytes: f64,
    }
    let mut groups: Vec<Group> = Vec::new();
    for (n, (loaded, seed)) in runs.iter().enumerate() {
        let course = Course::from_scenario(&loaded.scenario, &loaded.base_dir, *seed);
        let lane = cost::of_lane(&loaded.scenario).bytes();
        let fits = |g: &&mut Group| {
            // This form also keeps out what is not a number.
            g.bytes + lane <= memory_bytes && g.course.unlike(&course).is_none()
        };
        if let Some(group) = groups.iter_mut().find(fits) {
            group.runs.push(n);
            group.bytes += lane;
        } else {
            groups.push(Group { course, runs: vec![n], bytes: cost::cost(&loaded.scenario).bytes() });
        }
    }
    groups.into_iter().map(|group| group.runs).collect()
}
