//! Runs in lanes, in one and the same ocean, are the runs alone, bit by bit.

mod bundled;
mod command;

use crate::common::{lasting, scenario};
use rheotaxis::lanes::{LaneError, Lanes, group_by_ocean};
use rheotaxis::scenario::{Loaded, cost};
use rheotaxis::score::Score;
use rheotaxis::trial::{Event, Observer, RunEnd, Trial, Unwatched};

/// Seed of the runs.
const SEED: u64 = 11;

/// Everything that is known at the end of a run.
fn end(trial: &Trial) -> (RunEnd, Score) {
    (trial.ended(), trial.score().clone())
}

/// An observer that only knows which lane it is of.
struct Numbered(usize);

impl Observer for Numbered {
    fn see(&mut self, _event: &Event) {}
}

#[test]
fn robots_with_faults_share_an_ocean_and_fly_as_alone() {
    let all: Vec<Loaded> = [
        "[]",
        "[(at_s: 5, what: Fluorometer(Biased(1)))]",
        "[(at_s: 5, until_s: 9, what: Compass(Stuck)), (at_s: 9, what: Compass(Drifting(1)))]",
        "[(at_s: 4, what: Rudder(Stuck)), (at_s: 6, what: Propeller(Weak(0.5)))]",
        "[(at_s: 5, what: Fixes(Lie(east_m: 20)))]",
    ]
    .iter()
    // Some fixes come a minute apart.
    .map(|faults| lasting(scenario("uniform_channel", &[("robots[0].faults", faults)]), 30.0, 190.0))
    .collect();
    let runs: Vec<_> = all.iter().map(|l| (l, SEED.into())).collect();
    assert_eq!(group_by_ocean(&runs, cost::MEMORY), [[0, 1, 2, 3, 4]]);
    let mut lanes = Lanes::default();
    for (n, loaded) in all.iter().enumerate() {
        lanes.add(loaded, SEED, || Ok::<_, LaneError>(Numbered(n))).expect("one ocean");
    }
    let mut ends: Vec<_> = all.iter().map(|_| None).collect();
    lanes.run(|Numbered(n), run| ends[n] = Some(end(run.expect("no fault of ours"))));
    let mut digests = Vec::new();
    for (loaded, ended) in all.iter().zip(ends) {
        let mut alone = Trial::assemble(loaded, SEED).unwrap();
        alone.run(&mut Unwatched);
        assert_eq!(ended, Some(end(&alone)));
        digests.push(alone.ended().digest);
    }
    digests.sort();
    digests.dedup();
    assert_eq!(digests.len(), all.len(), "each fault does something");
}
