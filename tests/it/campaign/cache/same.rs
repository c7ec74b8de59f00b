//! A kept spin-up is the one that would be made, bit for bit, and only that.

use super::kit::{all, developed, files, plume, short};
use nalgebra::Vector3;
use rheotaxis::cache::SpinUps;
use rheotaxis::scenario::Loaded;
use rheotaxis::trial::{Trial, Unwatched};
use std::fmt::{self, Write};
use std::time::Duration;
use world::bits::Writer;
use world::digest::Digest;
use world::fields::{Concentration, Flow};
use world::ranges::{HeadingDeg, Positive};

/// Concentration near every hundredth filament, and velocity there, by their bits.
fn seen(trial: &Trial) -> Vec<[u64; 4]> {
    let ocean = trial.simulation.ocean();
    let at = |[x, y, z, ..]: [f64; 5]| {
        let p = Vector3::new(x + 0.01, y, z);
        let v = ocean.velocity(&p, 0.0);
        [ocean.plume().concentration(&p), v.x, v.y, v.z].map(f64::to_bits)
    };
    ocean.plume().iter().step_by(100).map(at).collect()
}

/// Digest of every field of the water, as it is shown for debugging, and of the plume as it is kept.
fn state(trial: &Trial) -> String {
    struct Text(Digest);
    impl fmt::Write for Text {
        fn write_str(&mut self, s: &str) -> fmt::Result {
            self.0.bytes(s.as_bytes());
            Ok(())
        }
    }
    let ocean = trial.simulation.ocean();
    let mut text = Text(Digest::default());
    write!(text, "{:?}", ocean.water()).expect("a digest takes all");
    let mut kept = Writer::default();
    ocean.plume().keep(&mut kept);
    text.0.bytes(&kept.into_bytes());
    text.0.hex()
}

/// Scenario, seconds of spin-up and of the mission, and what it is here for. The missions last beyond the next
/// evaluation of the flow, if there is one, and beyond the next solution round obstacles.
const OCEANS: [(&str, f64, f64, &str); 8] = [
    ("duck_st", 120.0, 15.0, "meander, layers, a long plume"),
    ("duck_mt", 120.0, 15.0, "two sources"),
    ("dalian_bay", 60.0, 12.0, "tide, waves"),
    ("flume_crab", 5.0, 2.0, "eddies, walls"),
    ("block_in_channel", 25.0, 12.0, "unsteady water, a block"),
    ("mound", 20.0, 4.0, "a file of heights"),
    ("reef_mesh", 20.0, 4.0, "a mesh file, steady water"),
    ("wp_laminar", 20.0, 5.0, "steady currents"),
];

#[test]
fn a_run_from_the_cache_is_the_same_run() {
    for (name, spin_up_s, limit_s, what) in OCEANS {
        let dir = tempfile::tempdir().unwrap();
        let loaded = short(name, spin_up_s, limit_s);
        let mut alone = Trial::assemble(&loaded, 3).unwrap();
        alone.spin_up(&mut Unwatched);
        let [mut first, mut second] = [false, true].map(|there| {
            // Each as in a process of its own.
            let kept = all(dir.path());
            let (trial, taken) = developed(&loaded, 3, &kept);
            assert_eq!(taken, there, "{name} ({what})");
            assert!(kept.fault().is_none());
            trial
        });
        for trial in [&first, &second] {
            assert_eq!(state(trial), state(&alone), "{name} ({what})");
        }
        assert!(!seen(&alone).is_empty(), "{name}: a plume to look at");
        for trial in [&first, &second] {
            assert_eq!(plume(trial), plume(&alone), "{name} ({what})");
            assert_eq!(seen(trial), seen(&alone), "{name} ({what})");
        }
        let ended = alone.run(&mut Unwatched);
        for trial in [&mut first, &mut second] {
            assert_eq!(trial.run(&mut Unwatched), ended, "{name} ({what})");
            assert_eq!(plume(trial), plume(&alone), "{name} ({what})");
        }
    }
}

#[test]
fn other_searchers_take_it_and_other_oceans_do_not() {
    let dir = tempfile::tempdir().unwrap();
    let base = short("uniform_channel", 60.0, 5.0);
    let kept = all(dir.path());
    developed(&base, 7, &kept);
    let other = base.clone().edit(|s| {
        s.robots[0].start.heading_deg = HeadingDeg::new(77.0);
        s.time.drift_period_s = Positive::new(1.0);
    });
    let (mut trial, taken) = developed(&other, 7, &kept);
    assert!(taken);
    let alone = Trial::assemble(&other, 7).unwrap().finish_quietly();
    assert_eq!(trial.run(&mut Unwatched), alone);

    let taken = |loaded: &Loaded, seed: u64| developed(loaded, seed, &kept).1;
    assert!(!taken(&base, 8), "another seed");
    let richer = base.clone().edit(|s| s.sources[0].rate_g_s = Positive::new(0.03));
    assert!(!taken(&richer, 7), "another source");
    assert_eq!(files(dir.path()).len(), 3);
    assert!(taken(&base, 7) && taken(&base, 8));
}

#[test]
fn what_is_quickly_made_or_too_large_is_not_kept() {
    let loaded = short("uniform_channel", 30.0, 5.0);
    let dir = tempfile::tempdir().unwrap();
    let patient = all(dir.path()).from(Duration::from_secs(10_000));
    let small = SpinUps::new(dir.path().to_owned(), 500).from(Duration::ZERO);
    for kept in [patient, small] {
        let (trial, taken) = developed(&loaded, 7, &kept);
        assert!(!taken && !trial.simulation.ocean().plume().is_empty());
        assert_eq!(files(dir.path()).len(), 0);
        assert!(kept.fault().is_none());
    }
    // Of a mission without a spin-up there is nothing to keep.
    let at_once = short("remus_zigzag", 0.0, 5.0);
    assert!(!developed(&at_once, 1, &all(dir.path())).1);
    assert_eq!(files(dir.path()).len(), 0);
}
