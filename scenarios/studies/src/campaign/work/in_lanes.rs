//! One run, or the runs of one seed: those with the same ocean in lanes, the others one after the other.
#![allow(clippy::disallowed_methods, reason = "wall times are columns of the table; nothing of them enters a run")]

use super::one_run::{Gatherer, RunName, failed, guarded, outcome_name};
use crate::campaign::contained::contained;
use crate::campaign::outside::{Outside, connect};
use crate::campaign::rows::row::RunRow;
use rheotaxis::cache::SpinUps;
use rheotaxis::lanes::{LaneError, Lanes, group_by_ocean};
use rheotaxis::ocean::SpunUp;
use rheotaxis::outcome::RunOutcome;
use rheotaxis::scenario::{Loaded, cost};
use std::collections::BTreeSet;
use std::time::{Duration, Instant};

/// A run to be made: its name and its scenario.
pub(crate) type PlannedRun<'a> = (RunName, &'a Loaded);

/// How far runs go, and who hears how long they took.
#[derive(Clone, Copy)]
pub(crate) struct LaneLimits<'a> {
    /// Whether more runs may begin.
    pub(crate) begin: &'a dyn Fn() -> bool,
    /// Whether the runs under way go on. Those that do not have no row.
    pub(crate) go_on: &'a dyn Fn() -> bool,
    /// Hears the wall time of the runs that went in lanes together.
    pub(crate) took: &'a dyn Fn(Duration),
    /// Who decides for robots whose strategy is `External`.
    pub(crate) outside: Option<&'a dyn Outside>,
    /// Hears of a run whose searcher outside is not there; it has no row.
    pub(crate) deserted: &'a dyn Fn(&RunName, String),
}

impl LaneLimits<'_> {
    /// All runs go to their ends.
    pub(crate) const NONE: LaneLimits<'static> =
        LaneLimits { begin: &|| true, go_on: &|| true, took: &|_| {}, outside: None, deserted: &|_, _| {} };
}

/// Makes the run. A run that fails or panics also becomes a row, with its error.
pub fn one_run(loaded: &Loaded, name: &RunName) -> RunRow {
    let mut made = None;
    let runs = [(name.clone(), loaded)];
    in_lanes(&runs, None, LaneLimits::NONE, &mut |row| made = Some(row));
    made.unwrap_or_else(|| failed(name, "it did not come to its end".to_string()))
}

/// Makes these runs. `keep` gets each row as soon as its run has ended. Runs with the same spin-up but not the same
/// ocean afterwards take the spin-up over from each other, and the first of them from `kept` if one is there.
pub(crate) fn in_lanes(
    runs: &[PlannedRun<'_>],
    kept: Option<&SpinUps>,
    heed: LaneLimits<'_>,
    keep: &mut dyn FnMut(RunRow),
) {
    let all: Vec<_> = runs.iter().map(|(name, l)| (*l, name.seed)).collect();
    let mut spun = Vec::new();
    let limit = runs.first().map_or(cost::MEMORY, |(_, loaded)| cost::limit(&loaded.registry));
    for group in group_by_ocean(&all, limit) {
        if !(heed.begin)() {
            return;
        }
        let begun = Instant::now();
        let mut left: BTreeSet<usize> = group.iter().copied().collect();
        let together = contained(|| {
            let shared = (&mut spun, kept);
            together(runs, &group, shared, heed, &mut |n, row| {
                left.remove(&n);
                keep(row);
            });
        });
        if let Err(said) = together {
            for n in left {
                keep(failed(&runs[n].0, format!("panicked: {said}")));
            }
        }
        (heed.took)(begun.elapsed());
    }
}

/// Makes the runs of a group, all of which have the same ocean. `keep` gets each row with the index of its run.
fn together(
    runs: &[PlannedRun<'_>],
    group: &[usize],
    (spun, kept): (&mut Vec<SpunUp>, Option<&SpinUps>),
    heed: LaneLimits<'_>,
    keep: &mut dyn FnMut(usize, RunRow),
) {
    let begun = Instant::now();
    let mut lanes = Lanes::default();
    let mut going = 0;
    for &n in group {
        let (name, loaded) = &runs[n];
        let gatherer = || Ok::<_, LaneError>(Gatherer::new(n, name, loaded, heed.go_on));
        match lanes.add(loaded, name.seed, gatherer) {
            Ok(()) => {
                going += 1;
                if let (Some(outside), Some((trial, gatherer))) = (heed.outside, lanes.newest()) {
                    gatherer.deserted = connect(outside, name, loaded, trial).err();
                }
            }
            Err(error) => keep(n, failed(name, error.to_string())),
        }
    }
    let taken = spun.iter().any(|s| lanes.take_over(s).is_ok());
    if !taken {
        spun.extend(match kept {
            Some(kept) => lanes.spin_up_with(kept).map(|d| d.state),
            None => lanes.spin_up(),
        });
    }
    let mut walls = Walls::new(going, (!taken).then(|| begun.elapsed()));
    lanes.run(|gatherer, run| {
        let (n, walls) = (gatherer.run, walls.next());
        let (name, loaded) = &runs[n];
        if let Some(why) = gatherer.deserted {
            (heed.deserted)(name, why);
            return;
        }
        let row = match run {
            Ok(trial) => guarded(name, || gatherer.row(name, loaded, trial, walls)),
            Err(error) => failed(name, error.to_string()),
        };
        if row.outcome != outcome_name(RunOutcome::Interrupted) {
            keep(n, row);
        }
    });
}

/// Divides the wall time of lanes among their runs: that of the missions equally among those under way at the time,
/// that of the spin-up to the run that ends first.
struct Walls {
    last: Instant,
    going: u32,
    mission: Duration,
    spin_up: Option<Duration>,
}

impl Walls {
    /// When the missions begin.
    fn new(going: u32, spin_up: Option<Duration>) -> Self {
        Self { last: Instant::now(), going, mission: Duration::ZERO, spin_up }
    }

    /// The wall times of spin-up and mission of a run that ends now.
    fn next(&mut self) -> [Duration; 2] {
        let now = Instant::now();
        self.mission += (now - self.last) / self.going.max(1);
        self.last = now;
        self.going = self.going.saturating_sub(1);
        [self.spin_up.take().unwrap_or_default(), self.mission]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rheotaxis::scenario::load;
    use std::cell::Cell;
    use std::path::Path;
    use world::ranges::{NonNegative, Positive};

    /// Two arms of a channel, the second of which ends later.
    fn arms() -> [(String, Loaded); 2] {
        let channel = load(Path::new("uniform_channel")).expect("in the catalogue");
        [3.0, 4.0].map(|limit_s| {
            let short = channel.clone().edit(|s| {
                s.time.spin_up_s = NonNegative::new(30.0);
                s.time.limit_s = Positive::new(limit_s);
            });
            (format!("{limit_s} s"), short)
        })
    }

    fn planned(arms: &[(String, Loaded)]) -> Vec<PlannedRun<'_>> {
        let mut runs = Vec::new();
        for (run, (arm, loaded)) in (0..).zip(arms) {
            let name = RunName { run, arm: arm.clone(), ..RunName::default() };
            runs.push((name, loaded));
        }
        runs
    }

    fn rows(runs: &[PlannedRun<'_>], begin: &dyn Fn() -> bool, go_on: &dyn Fn() -> bool) -> Vec<RunRow> {
        let mut rows = Vec::new();
        let heed = LaneLimits { begin, go_on, ..LaneLimits::NONE };
        in_lanes(runs, None, heed, &mut |row| rows.push(row));
        rows
    }

    #[test]
    fn a_panic_in_one_lane_is_the_row_of_that_lane() {
        let arms = arms();
        let runs = planned(&arms);
        // Asked by both lanes in turn, in the spin-up and in each step: here the first lane asks in its mission.
        let asked = Cell::new(0_u32);
        let go_on = || {
            asked.set(asked.get() + 1);
            assert!(asked.get() != 201, "enough");
            true
        };
        let rows = rows(&runs, &|| true, &go_on);
        let broken = rows.iter().find(|r| r.error.is_some()).expect("one row");
        assert_eq!(broken.error.as_deref(), Some("panicked: enough"));
        let (name, loaded) = &runs[1 - broken.run as usize];
        let sound = rows.iter().find(|r| r.run == name.run).expect("another");
        let alone = one_run(loaded, name);
        assert_eq!((&sound.digest, &sound.error), (&alone.digest, &None));
        assert_eq!(rows.len(), 2);
    }

    #[test]
    fn runs_that_do_not_begin_or_do_not_end_have_no_rows() {
        let arms = arms();
        let runs = planned(&arms);
        assert_eq!(rows(&runs, &|| false, &|| true), []);
        assert_eq!(rows(&runs, &|| true, &|| false), []);
        let asked = Cell::new(0_u32);
        // Long enough for the first to end, not for the second.
        let time = &arms[0].1.scenario.time;
        let (spin_up, mission) = (30.0 / time.spin_up_period_s.get(), 3.0 / time.step_s.get());
        let most = (2.0 * (spin_up + mission)) as u32 + 5;
        let go_on = || {
            asked.set(asked.get() + 1);
            asked.get() < most
        };
        let whole = rows(&runs, &|| true, &|| true);
        let part = rows(&runs, &|| true, &go_on);
        let digests = |rows: &[RunRow]| -> Vec<String> { rows.iter().map(|r| r.digest.clone()).collect() };
        assert_eq!(digests(&part), digests(&whole)[..1]);
    }

    #[test]
    fn the_wall_times_of_lanes_add_up_to_that_of_all() {
        let begun = Instant::now();
        let mut walls = Walls::new(3, Some(Duration::from_secs(7)));
        let mut shares = Vec::new();
        for _ in 0..3 {
            std::thread::sleep(Duration::from_millis(2));
            shares.push(walls.next());
        }
        let most = begun.elapsed();
        let spin_ups = shares.iter().map(|[spin_up, _]| spin_up.as_secs());
        assert_eq!(spin_ups.collect::<Vec<_>>(), [7, 0, 0]);
        let missions: Vec<_> = shares.iter().map(|[_, mission]| *mission).collect();
        assert!(missions.is_sorted());
        let sum: Duration = missions.iter().sum();
        assert!(sum <= most && sum >= Duration::from_millis(5), "{sum:?}");
    }
}
