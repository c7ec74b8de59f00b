//! Runs in lanes, in one and the same ocean, are the runs alone, bit by bit.

mod bundled;
mod campaigns;
mod command;
mod faults;

use rheotaxis::lanes::{LaneError, Lanes};
use rheotaxis::scenario::Loaded;
use rheotaxis::score::Score;
use rheotaxis::trial::{Event, Observer, RunEnd, Trial, Unwatched};
use world::ranges::{NonNegative, Positive};

/// Seed of the runs.
const SEED: u64 = 11;

/// Everything that is known at the end of a run, or what went wrong with it.
type End = Result<(RunEnd, Score), String>;

/// Cuts a scenario short.
fn cut(loaded: &mut Loaded, spin_up_s: f64, limit_s: f64) {
    let time = &mut loaded.scenario.time;
    time.spin_up_s = NonNegative::new(time.spin_up_s.get().min(spin_up_s));
    time.limit_s = Positive::new(time.limit_s.get().min(limit_s));
}

fn end(trial: &Trial) -> (RunEnd, Score) {
    (trial.ended(), trial.score().clone())
}

/// The run alone.
fn alone(loaded: &Loaded) -> (RunEnd, Score) {
    let mut trial = Trial::assemble(loaded, SEED).unwrap();
    trial.run(&mut Unwatched);
    end(&trial)
}

/// The runs in lanes, and the order in which they ended.
fn in_lanes(all: &[&Loaded]) -> (Vec<End>, Vec<usize>) {
    let mut ends: Vec<Option<End>> = all.iter().map(|_| None).collect();
    let mut order = Vec::new();
    let mut lanes = Lanes::default();
    for (n, loaded) in all.iter().enumerate() {
        if let Err(error) = lanes.add(loaded, SEED, || Ok::<_, LaneError>(Numbered(n))) {
            ends[n] = Some(Err(error.to_string()));
        }
    }
    lanes.run(|Numbered(n), run| {
        order.push(n);
        let end = run.map(end).map_err(|e| e.to_string());
        assert!(ends[n].replace(end).is_none(), "lane {n} ended twice");
    });
    let ends = ends.into_iter().map(|end| end.expect("each has ended"));
    (ends.collect(), order)
}

/// An observer that only knows which lane it is of.
struct Numbered(usize);

impl Observer for Numbered {
    fn see(&mut self, _event: &Event) {}
}
