//! A spin-up taken over from another run is the same, bit for bit, as one's own; and refused where it is not.

use crate::common::short;
use rheotaxis::ocean::{Mismatch, SpunUp};
use rheotaxis::scenario::{Id, Loaded, Scenario};
use rheotaxis::trial::{Event, Observer, Trial, Unwatched};
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};

/// A scenario that comes with the program, cut short.
fn cut(name: &str) -> Loaded {
    short(name, 120.0, 40.0)
}

/// Digest of a run that spins up itself.
fn alone(loaded: &Loaded, seed: u64) -> String {
    Trial::assemble(loaded, seed).unwrap().finish_quietly().digest
}

fn spun_up(loaded: &Loaded, seed: u64) -> SpunUp {
    let mut trial = Trial::assemble(loaded, seed).unwrap();
    trial.spin_up(&mut Unwatched).expect("nobody stopped it")
}

/// Digest of a run that takes over the spin-up of another.
fn after(spun_up: &SpunUp, loaded: &Loaded, seed: u64) -> String {
    let mut trial = Trial::assemble(loaded, seed).unwrap();
    trial.take_over(spun_up).unwrap();
    trial.finish_quietly().digest
}

#[test]
fn arms_that_share_a_spin_up_end_as_if_each_had_its_own() {
    for name in ["duck_st", "uniform_channel"] {
        let base = cut(name);
        let elsewhere = base.clone().edit(|s| {
            s.robots[0].start.heading_deg = HeadingDeg::new(77.0);
            s.time.drift_period_s = Positive::new(1.0);
            s.time.limit_s = Positive::new(30.0);
        });
        let two = base.clone().edit(|s| {
            let mut other = s.robots[0].clone();
            other.id = Id::try_from("auv1".to_string()).unwrap();
            other.start.east_m = Finite::new(other.start.east_m.get() + 9.0);
            s.robots.push(other);
        });
        let mut first = Trial::assemble(&base, 11).unwrap();
        let state = first.spin_up(&mut Unwatched).expect("nobody stopped it");
        assert_eq!(first.run(&mut Unwatched).digest, alone(&base, 11));
        let arms = [&base, &elsewhere, &two].map(|arm| {
            let digest = after(&state, arm, 11);
            assert_eq!(digest, alone(arm, 11), "{name}");
            digest
        });
        assert!(arms[0] != arms[1] && arms[0] != arms[2], "{name}: the arms differ");
        // Those who took it over have not moved it.
        assert_eq!(after(&state, &base, 11), arms[0], "{name}");
    }
}

#[test]
fn another_water_solid_time_or_seed_is_refused_by_name() {
    let base = cut("duck_st");
    let state = spun_up(&base, 11);
    let differs = |change: fn(&mut Scenario)| {
        let mut trial = Trial::assemble(&base.clone().edit(change), 11).unwrap();
        match trial.take_over(&state).unwrap_err() {
            Mismatch::Block(block) => block,
            seed => panic!("{seed}"),
        }
    };
    assert_eq!(differs(|s| s.water.currents.truncate(1)), "water");
    assert_eq!(differs(|s| s.permeable.push("pile".into())), "permeable");
    assert_eq!(differs(|s| s.time.spin_up_s = NonNegative::new(121.0)), "time.spin_up_s");

    let mut other = Trial::assemble(&base, 12).unwrap();
    let error = other.take_over(&state).unwrap_err();
    assert_eq!(error, Mismatch::Seed { theirs: 11.into(), ours: 12.into() });
    assert!(error.to_string().contains("seed 11"), "{error}");
    // Refused, it is as it was.
    assert_eq!(other.finish_quietly().digest, alone(&base, 12));
}

#[test]
fn a_stopped_spin_up_gives_nothing_to_share() {
    struct Impatient(bool);
    impl Observer for Impatient {
        fn see(&mut self, event: &Event) {
            self.0 = matches!(event, Event::SpinUp(share) if *share >= 0.5);
        }
        fn goes_on(&mut self) -> bool {
            !self.0
        }
    }
    let mut trial = Trial::assemble(&cut("uniform_channel"), 1).unwrap();
    assert!(trial.spin_up(&mut Impatient(false)).is_none());
    let ended = trial.run(&mut Unwatched);
    assert_eq!(ended.outcome, rheotaxis::outcome::RunOutcome::Interrupted);
    assert_eq!(ended.steps, 0);
}
