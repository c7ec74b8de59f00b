//! What a mission of a kinematic vehicle costs beside its plume: `cargo run --release -p rheotaxis-studies --example
//! studies kinematic_cost`.
//!
//! For a few seeds of `duck_st`: time of the mission less that of its plume, and of the questions that the fluorometer
//! asks the plume, with one thread. Each ten seconds of a mission count with the least of five times that they took, so
//! that what else the machine does is left out. A word after the command chooses the vehicles whose names hold it, such
//! as `0.1`. Run it on an idle machine.

#![allow(clippy::print_stdout, clippy::disallowed_methods, reason = "it measures and speaks")]

use nalgebra::Vector3;
use rheotaxis::ocean::SpunUp;
use rheotaxis::scenario::{Loaded, load};
use rheotaxis::trial::{Trial, Unwatched};
use std::error::Error;
use std::time::Instant;
use world::fields::Concentration;
use world::frames::Truth;

/// Steps of a tenth of a second, in which no instrument reads faster.
const TENTHS: [(&str, &str); 3] =
    [("robots[0].sensors.compass.rate_hz", "10"), ("robots[0].sensors.depth.rate_hz", "10"), ("time.step_s", "0.1")];
/// Steps of a fifth of a second, in which no instrument reads faster.
const FIFTHS: [(&str, &str); 4] = [
    ("robots[0].sensors.fluorometer.rate_hz", "5"),
    ("robots[0].sensors.compass.rate_hz", "5"),
    ("robots[0].sensors.depth.rate_hz", "5"),
    ("time.step_s", "0.2"),
];

/// `duck_st` with another vehicle and a few other values, and frames as seldom as somebody needs who reads only the
/// result.
fn duck(vehicle: &str, changes: &[(&str, &str)]) -> Result<Loaded, Box<dyn Error>> {
    let quiet = load("duck_st".as_ref())?
        .set("robots[0].vehicle", vehicle)?
        .set("record", "(frame_period_s: 10, plume_period_s: 1000)")?;
    Ok(changes.iter().try_fold(quiet, |loaded, (path, value)| loaded.set(path, value))?)
}

/// A mission with its plume spun up.
struct Mission<'a> {
    loaded: &'a Loaded,
    seed: u64,
    spun_up: &'a SpunUp,
    /// From one reading of the fluorometer to the next, s.
    read_s: f64,
}

impl Mission<'_> {
    fn begun(&self, loaded: &Loaded) -> Trial {
        let mut trial = Trial::assemble(loaded, self.seed).expect("a run");
        trial.take_over(self.spun_up).expect("the same ocean");
        trial
    }

    /// Where its nose, with the fluorometer, is at each of its readings.
    fn track(&self) -> Vec<Vector3<f64>> {
        let mut trial = self.begun(self.loaded);
        let every = (self.read_s / self.loaded.scenario.time.step_s.get()).round() as u64;
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

    /// Time of each [`PIECE_S`] of the whole mission, of its plume that is asked for its concentration at these
    /// places, and of its plume that nobody asks, s. All three go on in turn, because a machine is slower at one time
    /// than at another.
    fn pieces_s(&self, track: &[Vector3<f64>]) -> Vec<[f64; 3]> {
        let mut alone = self.loaded.clone();
        alone.scenario.robots.clear();
        let mut trials = [self.loaded, &alone, &alone].map(|loaded| self.begun(loaded));
        let (mut felt, mut pieces) = (0.0, Vec::new());
        let each = (PIECE_S / self.read_s).round() as usize;
        for (n, places) in track.chunks(each).enumerate() {
            let t_s = |k: usize| self.read_s * ((n * each + k) as f64 + 1.0);
            pieces.push([0, 1, 2].map(|which| {
                let trial = &mut trials[which];
                let before = Instant::now();
                if which == 0 {
                    trial.until(t_s(places.len() - 1));
                } else {
                    for (k, p) in places.iter().enumerate() {
                        trial.until(t_s(k));
                        if which == 1 {
                            felt += trial.simulation.ocean().dye(t_s(k)).concentration(p);
                        }
                    }
                }
                before.elapsed().as_secs_f64()
            }));
        }
        assert!(felt.is_finite());
        pieces
    }

    /// The least time of each piece in some rounds, summed over the mission: of all three, s.
    fn least_s(&self, track: &[Vector3<f64>]) -> [f64; 3] {
        let rounds: Vec<_> = (0..ROUNDS).map(|_| self.pieces_s(track)).collect();
        [0, 1, 2].map(|which| {
            (0..rounds[0].len()).map(|n| rounds.iter().map(|r| r[n][which]).fold(f64::INFINITY, f64::min)).sum()
        })
    }
}

/// Times that each mission is measured.
const ROUNDS: usize = 5;
/// Time of the mission whose cost is measured at once, s.
const PIECE_S: f64 = 10.0;

/// Prints, for a few seeds, the time of the mission less that of its plume: the plume alone, and the plume with the
/// questions that the fluorometer asks it.
pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    println!("{}", crate::head("kinematic_cost"));
    for (name, vehicle, changes, read_s) in [
        ("REMUS, steps of 0.05 s", "Remus100()", &[][..], 0.1),
        ("point, steps of 0.05 s", "Kinematic()", &[][..], 0.1),
        ("point, steps of 0.1 s", "Kinematic()", &TENTHS[..], 0.1),
        ("point, steps of 0.2 s", "Kinematic()", &FIFTHS[..], 0.2),
    ] {
        if std::env::args().nth(2).is_some_and(|part| !name.contains(&part)) {
            continue;
        }
        let loaded = duck(vehicle, changes)?;
        let (mut beside_ms, mut asking_ms, mut lasts_s) = (Vec::new(), Vec::new(), 0.0);
        for seed in 900_001..900_006 {
            let spun_up = Trial::assemble(&loaded, seed)?.spin_up(&mut Unwatched).ok_or("the spin-up was stopped")?;
            let mission = Mission { loaded: &loaded, seed, spun_up: &spun_up, read_s };
            let track = mission.track();
            let [whole_s, asked_s, alone_s] = mission.least_s(&track);
            beside_ms.push(1e3 * (whole_s - asked_s));
            asking_ms.push(1e3 * (asked_s - alone_s));
            lasts_s += read_s * track.len() as f64;
        }
        let n = beside_ms.len() as f64;
        let mean = |ms: &[f64]| ms.iter().sum::<f64>() / n;
        println!(
            "{name}: mission of {:.0} s on average; {:.1} ms beside the plume and what it is asked \
             ({beside_ms:.0?}); {:.1} ms for the fluorometer's questions ({asking_ms:.0?})",
            lasts_s / n,
            mean(&beside_ms),
            mean(&asking_ms),
        );
    }
    Ok(())
}
