//! Digests that stay the same from version to version, and on every machine, until a change of the physics or of an
//! algorithm is meant. Then the new ones are written down, and the commit says why.
//!
//! Each run has its digest at the end and, early in the mission, one of each part of its state, so that a change says
//! where
//! it bites: in the ocean, the hull, the instruments and the estimate, the map, the decision, or a gantry.

use rheotaxis::frame::Frame;
use rheotaxis::scenario::load;
use rheotaxis::trial::{Trial, Unwatched};
use std::path::Path;
use world::digest::Digest;
use world::ranges::{NonNegative, Positive};

/// When the parts are looked at, s of the mission.
const EARLY_S: f64 = 5.0;

/// Scenario, seed, most seconds of spin-up and of the mission, and what the run is there for.
const RUNS: [(&str, u64, f64, f64, &str); 18] = [
    ("remus_zigzag", 1, 0.0, 1e4, "hull, open loop"),
    ("uniform_channel", 1, 300.0, 60.0, "the adaptive mission planner"),
    ("uniform_channel", 2, 300.0, 60.0, "another seed"),
    ("flume_crab_paper", 1, 1e4, 40.0, "gantry, probes, the crab as printed"),
    ("flume_crab", 1, 1e4, 40.0, "the crab's adaptive units"),
    ("wp_laminar", 1, 300.0, 1e4, "source map, A*, a rule on the map"),
    ("wp_dead_end", 1, 30.0, 60.0, "ranging, replanning, potential field"),
    ("four_maps", 1, 60.0, 120.0, "POMDP, Bayesian, HMM, particles"),
    ("moth_plus", 1, 120.0, 120.0, "subsumption, CTD, layers of water"),
    ("duck_mt", 1, 120.0, 60.0, "subregions"),
    ("dalian_bay", 1, 60.0, 60.0, "tide, waves"),
    ("block_in_channel", 1, 60.0, 30.0, "water round obstacles"),
    ("eyes_over_source", 1, 30.0, 60.0, "sidescan, camera, eyes"),
    ("mound", 1, 30.0, 30.0, "an obstacle from a file"),
    ("lauv_bay", 1, 300.0, 60.0, "a hull of a folder, fins mixed"),
    ("bluerov_harbour", 1, 60.0, 60.0, "hovering, allocation"),
    ("surface_lake", 1, 60.0, 60.0, "a floating hull"),
    ("glider_shelf", 1, 60.0, 300.0, "buoyancy engine, moving mass"),
];

fn line(name: &str, seed: u64, spin_up_s: f64, limit_s: f64) -> String {
    let mut loaded = load(Path::new(name)).unwrap();
    let time = &mut loaded.scenario.time;
    time.spin_up_s = NonNegative::new(time.spin_up_s.get().min(spin_up_s));
    time.limit_s = Positive::new(time.limit_s.get().min(limit_s));
    let mut trial = Trial::assemble(&loaded, seed).unwrap();
    trial.until(EARLY_S);
    let early = parts(&trial);
    let ended = trial.run(&mut Unwatched);
    format!("{name} {seed} {} {} {early}\n", ended.steps, ended.digest)
}

/// Eight hexadecimal digits for each part of the state.
fn parts(trial: &Trial) -> String {
    let frame = trial.frame().expect("frames come ten times a second");
    let mut ocean = Digest::default();
    trial.simulation.ocean().plume().digest_into(&mut ocean);
    let all = [
        ("ocean", ocean),
        (
            "hull",
            of(frame, |f, d| {
                for r in &f.robots {
                    d.f64s(r.truth.pose.p_WB.as_slice());
                    d.f64s(r.truth.v_WB_B.as_slice());
                }
            }),
        ),
        (
            "estimate",
            of(frame, |f, d| {
                for r in &f.robots {
                    d.f64s(r.estimate.position.as_slice());
                    d.f64s(&[r.estimate.depth_m, r.estimate.attitude.heading.rad()]);
                    d.f64s(&[r.chemical.map_or(0.0, |c| c.volts)]);
                }
            }),
        ),
        (
            "map",
            of(frame, |f, d| {
                let beliefs = f.robots.iter().filter_map(|r| r.belief.as_ref());
                beliefs.for_each(|b| d.f64s(&b.p));
            }),
        ),
        (
            "decision",
            of(frame, |f, d| {
                for r in &f.robots {
                    d.text(r.behaviour.name());
                    d.f64s(&r.goal.map_or([0.0; 2], |g| [f64::from(g.id), g.speed_m_s]));
                }
            }),
        ),
        (
            "gantry",
            of(frame, |f, d| {
                for g in &f.gantries {
                    d.f64s(g.head_W.as_slice());
                    d.text(g.behaviour.name());
                }
            }),
        ),
    ];
    all.map(|(name, digest)| format!("{name}:{}", &digest.hex()[..8])).join(" ")
}

fn of(frame: &Frame, write: impl Fn(&Frame, &mut Digest)) -> Digest {
    let mut digest = Digest::default();
    write(frame, &mut digest);
    digest
}

#[test]
fn runs_still_go_through_the_same_states() {
    let golden: Vec<&str> = include_str!("../../golden/digests.txt").lines().collect();
    let mut changed = Vec::new();
    for (n, (name, seed, spin_up_s, limit_s, what)) in RUNS.into_iter().enumerate() {
        let now = line(name, seed, spin_up_s, limit_s);
        if golden.get(n).copied() != Some(now.trim_end()) {
            changed.push(format!("{what}:\n{now}"));
        }
    }
    assert!(changed.is_empty(), "not as in tests/golden/digests.txt:\n{}", changed.concat());
    assert_eq!(golden.len(), RUNS.len());
}
