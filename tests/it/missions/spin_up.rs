//! A spin-up taken over from another run is the same, bit for bit, as one's own; and refused where it is not.

use rheotaxis::ocean::{Mismatch, SpunUp};
use rheotaxis::scenario::{Id, Loaded, Scenario, load};
use rheotaxis::trial::{Event, Observer, Trial, Unwatched};
use std::path::Path;
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};

/// A scenario that comes with the program, cut short.
fn short(name: &str) -> Loaded {
    let mut loaded = load(Path::new(name)).unwrap();
    loaded.scenario.time.spin_up_s = NonNegative::new(120.0);
    loaded.scenario.time.limit_s = Positive::new(40.0);
    loaded
}

fn changed(loaded: &Loaded, change: impl Fn(&mut Scenario)) -> Loaded {
    let mut loaded = loaded.clone();
    change(&mut loaded.scenario);
    loaded
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
        let base = short(name);
        let elsewhere = changed(&base, |s| {
            s.robots[0].start.heading_deg = HeadingDeg::try_from(77.0).unwrap();
            s.time.drift_period_s = Positive::new(1.0);
            s.time.limit_s = Positive::new(30.0);
        });
        let two = changed(&base, |s| {
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
fn threads_may_share_it() {
    let base = short("uniform_channel");
    let (state, digest) = (spun_up(&base, 3), alone(&base, 3));
    std::thread::scope(|scope| {
        let runs = [(); 3].map(|()| {
            let (state, base) = (state.clone(), &base);
            scope.spawn(move || after(&state, base, 3))
        });
        drop(state);
        for run in runs {
            assert_eq!(run.join().unwrap(), digest);
        }
    });
}

#[test]
fn another_place_water_source_time_or_seed_is_refused_by_name() {
    let base = short("duck_st");
    let state = spun_up(&base, 11);
    let differs = |change: fn(&mut Scenario)| {
        let mut trial = Trial::assemble(&changed(&base, change), 11).unwrap();
        match trial.take_over(&state).unwrap_err() {
            Mismatch::Block(block) => block,
            seed => panic!("{seed}"),
        }
    };
    assert_eq!(differs(|s| s.area.width_m = Positive::new(360.0)), "area");
    let level = |s: &mut Scenario| {
        s.terrain = load(Path::new("uniform_channel")).unwrap().scenario.terrain;
    };
    assert_eq!(differs(level), "terrain");
    assert_eq!(differs(|s| s.water.currents.truncate(1)), "water");
    assert_eq!(differs(|s| s.sources[0].rate_g_s = Positive::new(0.03)), "sources");
    assert_eq!(differs(|s| s.permeable.push("pile".into())), "permeable");
    type Change = (fn(&mut Scenario), &'static str);
    let times: [Change; 3] = [
        (|s| s.time.spin_up_s = NonNegative::new(121.0), "time.spin_up_s"),
        (|s| s.time.spin_up_period_s = Positive::new(0.5), "time.spin_up_period_s"),
        (|s| s.time.flow_period_s = NonNegative::new(5.0), "time.flow_period_s"),
    ];
    for (change, block) in times {
        assert_eq!(differs(change), block);
    }

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
    let mut trial = Trial::assemble(&short("uniform_channel"), 1).unwrap();
    assert!(trial.spin_up(&mut Impatient(false)).is_none());
    let ended = trial.run(&mut Unwatched);
    assert_eq!(ended.outcome, rheotaxis::outcome::RunOutcome::Interrupted);
    assert_eq!(ended.steps, 0);
}
