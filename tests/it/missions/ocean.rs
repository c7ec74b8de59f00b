//! The ocean goes its way whoever searches in it, and a run is the same however it is stepped.

use rheotaxis::ocean::{Ocean, Origin};
use rheotaxis::scenario::load;
use rheotaxis::trial::{Trial, Unwatched};
use std::path::Path;
use world::clock::Clock;
use world::digest::Digest;

fn plume_of(ocean: &Ocean) -> String {
    let mut digest = Digest::default();
    ocean.plume().digest_into(&mut digest);
    digest.hex()
}

/// With a robot, without one, and without a trial.
#[test]
fn nobodys_search_changes_the_ocean() {
    let loaded = load(Path::new("uniform_channel")).unwrap();
    let away = loaded.clone().edit(|s| s.robots.clear());
    let [with, without] = [&loaded, &away].map(|loaded| {
        let mut trial = Trial::assemble(loaded, 3).unwrap();
        assert!(trial.until(30.0));
        plume_of(trial.simulation.ocean())
    });
    assert_eq!(with, without);

    let time = &loaded.scenario.time;
    let origin = Origin::from_scenario(&loaded.scenario, &loaded.base_dir, 3);
    let mut alone = origin.build(&loaded.base_dir).unwrap();
    alone.spin_up(|_| true);
    let mut clock = Clock::new(time.step_s.get());
    while clock.t_s() < 30.0 - 1e-9 {
        alone.advance(clock.t_next_s());
        clock.advance();
    }
    assert_eq!(plume_of(&alone), with);
}

#[test]
fn a_run_is_the_same_however_it_is_stepped() {
    let loaded = load(Path::new("uniform_channel")).unwrap();
    let trial = || Trial::assemble(&loaded, 5).unwrap();
    let whole = trial().finish_quietly();
    let mut by_steps = trial();
    while by_steps.step() {}
    assert_eq!(by_steps.ended(), whole);
    let mut by_parts = trial();
    for t_s in [0.0, 0.3, 7.0, 7.0, 31.0] {
        assert!(by_parts.until(t_s));
        assert!(by_parts.simulation.t_s() >= t_s - 1e-9);
    }
    assert_eq!(by_parts.run(&mut Unwatched), whole);
    assert_eq!(by_parts.score().searchers.len(), 1);
}
