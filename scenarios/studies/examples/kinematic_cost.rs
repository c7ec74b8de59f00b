//! What a mission of a kinematic vehicle costs beside its plume: `cargo run --release -p rheotaxis-studies --example
//! kinematic_cost`.
//!
//! For a few seeds of `duck_st`: core time of the mission less that of its plume, and of the questions that the
//! fluorometer asks the plume, medians of nine. A word after the command chooses the vehicles whose names hold it, such
//! as `0.1`. Linux only (`/proc/thread-self/schedstat`). Run it on an idle machine.

#![allow(clippy::print_stdout, reason = "it measures and speaks")]

use nalgebra::Vector3;
use rheotaxis::ocean::SpunUp;
use rheotaxis::registry::Registry;
use rheotaxis::scenario::{Loaded, load_text, template};
use rheotaxis::trial::{Trial, Unwatched};
use std::error::Error;
use world::fields::Concentration;
use world::frames::Truth;

/// Steps of a tenth of a second, in which no instrument reads faster.
const TENTHS: [(&str, &str); 3] = [
    ("compass: (rate_hz: 20", "compass: (rate_hz: 10"),
    ("depth: (rate_hz: 20", "depth: (rate_hz: 10"),
    ("step_s: 0.05", "step_s: 0.1"),
];
/// Frames as seldom as somebody needs who reads only the result.
const QUIET: (&str, &str) = (
    "success:",
    "record: (frame_period_s: 10, plume_period_s: 1000),\n    success:",
);

/// `duck_st` with another vehicle and a few other texts.
fn duck(vehicle: &str, changes: &[(&str, &str)]) -> Result<Loaded, Box<dyn Error>> {
    let bundled = template("duck_st").ok_or("no duck_st in the catalogue")?;
    let mut text = bundled.text.replace("Remus100()", vehicle);
    for (from, to) in changes {
        if text.matches(from).count() != 1 {
            return Err(format!("duck_st must hold `{from}` once").into());
        }
        text = text.replace(from, to);
    }
    Ok(load_text(&Registry::default(), "duck_st", &text)?)
}

/// Time of one core that this thread has had, s.
fn core_s() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").expect("a Linux kernel");
    let ns = text.split(' ').next().expect("its first number");
    ns.parse::<f64>().expect("a number") / 1e9
}

/// A mission with its plume spun up.
struct Mission<'a> {
    loaded: &'a Loaded,
    seed: u64,
    spun_up: &'a SpunUp,
}

impl Mission<'_> {
    fn begun(&self, loaded: &Loaded) -> Trial {
        let mut trial = Trial::assemble(loaded, self.seed).expect("a run");
        trial.take_over(self.spun_up).expect("the same ocean");
        trial
    }

    /// Where its nose, with the fluorometer, is at each reading: ten a second.
    fn track(&self) -> Vec<Vector3<f64>> {
        let mut trial = self.begun(self.loaded);
        let every = (0.1 / self.loaded.scenario.time.step_s.get()).round() as u64;
        let mut track = Vec::new();
        for step in 1.. {
            let going = trial.step();
            let world = &mut trial.simulation.world;
            let truth = world.query::<&Truth>().single(world).expect("a robot");
            if step % every == 0 {
                track.push(truth.pose.point(Vector3::new(0.72, 0.0, -0.06)));
            }
            if !going {
                break;
            }
        }
        track
    }

    /// Core time of the whole mission, s.
    fn whole_s(&self) -> f64 {
        let mut trial = self.begun(self.loaded);
        let before = core_s();
        trial.run(&mut Unwatched);
        core_s() - before
    }

    /// Core time of its plume without anybody, which is asked for its concentration at these places or not, s.
    fn plume_s(&self, track: &[Vector3<f64>], asked: bool) -> f64 {
        let mut alone = self.loaded.clone();
        alone.scenario.robots.clear();
        let mut trial = self.begun(&alone);
        let before = core_s();
        let mut felt = 0.0;
        for (k, p) in track.iter().enumerate() {
            let t_s = 0.1 * (k as f64 + 1.0);
            trial.until(t_s);
            if asked {
                felt += trial.simulation.ocean().dye(t_s).at(p);
            }
        }
        assert!(felt.is_finite());
        core_s() - before
    }
}

/// Times that each mission is measured.
const ROUNDS: usize = 9;

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}

/// Prints, for a few seeds, the time of the mission less that of its plume: the plume alone, and the plume with the
/// questions that the fluorometer asks it.
fn main() -> Result<(), Box<dyn Error>> {
    let mut quiet = TENTHS.to_vec();
    quiet.push(QUIET);
    let usual = [QUIET];
    for (name, vehicle, changes) in [
        ("REMUS, steps of 0.05 s", "Remus100()", &usual[..]),
        ("point, steps of 0.05 s", "Kinematic()", &usual),
        ("point, steps of 0.1 s", "Kinematic()", &quiet),
    ] {
        if std::env::args()
            .nth(1)
            .is_some_and(|part| !name.contains(&part))
        {
            continue;
        }
        let loaded = duck(vehicle, changes)?;
        let (mut beside_ms, mut asking_ms, mut lasts_s) = (Vec::new(), Vec::new(), 0.0);
        for seed in 900_001..900_006 {
            let spun_up = Trial::assemble(&loaded, seed)?
                .spin_up(&mut Unwatched)
                .ok_or("the spin-up was stopped")?;
            let mission = Mission {
                loaded: &loaded,
                seed,
                spun_up: &spun_up,
            };
            let track = mission.track();
            // Differences of runs that follow each other, because a machine is slower at one time than at another.
            let (mut beside_s, mut asking_s) = (Vec::new(), Vec::new());
            for _ in 0..ROUNDS {
                let whole = mission.whole_s();
                let asked = mission.plume_s(&track, true);
                let alone = mission.plume_s(&track, false);
                beside_s.push(whole - asked);
                asking_s.push(asked - alone);
            }
            beside_ms.push(1e3 * median(beside_s));
            asking_ms.push(1e3 * median(asking_s));
            lasts_s += 0.1 * track.len() as f64;
        }
        let n = beside_ms.len() as f64;
        let mean = |ms: &[f64]| ms.iter().sum::<f64>() / n;
        println!(
            "{name}: mission of {:.0} s on average; {:.1} ms of a core beside the plume and what it is asked \
             ({beside_ms:.0?}); {:.1} ms for the fluorometer's questions ({asking_ms:.0?})",
            lasts_s / n,
            mean(&beside_ms),
            mean(&asking_ms),
        );
    }
    Ok(())
}
