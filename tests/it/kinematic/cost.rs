//! What a mission of a kinematic vehicle costs beside its plume:
//! `cargo test --release -p command what_a_duck_mission_costs -- --ignored --nocapture`.

#![cfg(target_os = "linux")]

use super::with;
use rheotaxis::ocean::SpunUp;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Trial, Unwatched};

/// Steps of a tenth of a second, in which no instrument reads faster.
const TENTHS: [(&str, &str); 3] = [
    ("compass: (rate_hz: 25", "compass: (rate_hz: 10"),
    ("depth: (rate_hz: 25", "depth: (rate_hz: 10"),
    ("step_s: 0.02", "step_s: 0.1"),
];
/// Frames as seldom as somebody needs who reads only the result.
const QUIET: (&str, &str) = (
    "success:",
    "record: (frame_period_s: 10, plume_period_s: 1000),\n    success:",
);

/// Time of one core that this thread has had, s.
fn core_s() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").expect("a Linux kernel");
    let ns = text.split(' ').next().expect("its first number");
    ns.parse::<f64>().expect("a number") / 1e9
}

/// Core time of the mission, s, and its length, s.
fn mission(loaded: &Loaded, seed: u64, spun_up: &SpunUp, until_s: Option<f64>) -> (f64, f64) {
    let mut trial = Trial::assemble(loaded, seed).expect("a run");
    trial.take_over(spun_up).expect("the same ocean");
    let before = core_s();
    match until_s {
        Some(t_s) => {
            trial.until(t_s);
        }
        None => {
            trial.run(&mut Unwatched);
        }
    }
    (core_s() - before, trial.simulation.t_s())
}

/// Prints, for a few seeds, the time of the mission less that of the plume alone for as long.
#[test]
#[ignore = "measures times: to be run on an idle machine"]
fn what_a_duck_mission_costs() {
    let mut quiet = TENTHS.to_vec();
    quiet.push(QUIET);
    let usual = [QUIET];
    let cases: [(&str, &str, &[(&str, &str)]); 3] = [
        ("REMUS, steps of 0.02 s", "Remus100()", &usual),
        ("point, steps of 0.02 s", "Kinematic()", &usual),
        ("point, steps of 0.1 s", "Kinematic()", &quiet),
    ];
    for (name, vehicle, changes) in cases {
        let loaded = with("duck_st", vehicle, changes);
        let mut alone = loaded.clone();
        alone.scenario.robots.clear();
        let mut beside_ms = Vec::new();
        let mut all_s = 0.0;
        for seed in 900_001..900_009 {
            let spun_up = Trial::assemble(&loaded, seed)
                .expect("a run")
                .spin_up(&mut Unwatched)
                .expect("nobody stops it");
            let best = |loaded: &Loaded, until_s| {
                let tries = (0..3).map(|_| mission(loaded, seed, &spun_up, until_s));
                tries.min_by(|a, b| a.0.total_cmp(&b.0)).expect("three")
            };
            let (with_s, lasts_s) = best(&loaded, None);
            let (without_s, _) = best(&alone, Some(lasts_s));
            beside_ms.push(1e3 * (with_s - without_s));
            all_s += lasts_s;
        }
        let n = beside_ms.len() as f64;
        let mean_ms = beside_ms.iter().sum::<f64>() / n;
        println!(
            "{name}: {mean_ms:.1} ms a mission of {:.0} s on average, {:.1} us a second ({beside_ms:.0?})",
            all_s / n,
            1e3 * mean_ms * n / all_s
        );
    }
}
