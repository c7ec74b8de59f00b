//! How fast a hull alone is computed: `cargo run --release -p rheotaxis-studies --example studies hull_speed`.
//!
//! Each vehicle turns and dives in moving water for half an hour, in steps of 0.02 s, without instruments, plume or
//! contacts. Prints real time over computing time of one thread. Run it on an idle machine.

#![allow(clippy::print_stdout, clippy::disallowed_methods, reason = "it measures and speaks")]

use nalgebra::{Matrix3, Vector3};
use rheotaxis::scenario::FolderFiles;
use robots::handoff::{Actuation, ActuatorCommand};
use robots::vehicles::{SHIPPED, Vehicle, VehicleDrive, VehicleSpec};
use std::error::Error;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;
use world::fields::{Flow, Mixing, WaterSample};
use world::frames::{Pose, Truth};
use world::units::Heading;

const STEP_S: f64 = 0.02;
const LASTS_S: f64 = 1800.0;

/// A shear.
struct Shear;

impl Flow for Shear {
    fn velocity(&self, p: &Vector3<f64>, _: f64) -> Vector3<f64> {
        Vector3::new(0.2 + 0.002 * p.z, 0.0, 0.0)
    }

    fn density(&self, _: &Vector3<f64>, _: f64) -> f64 {
        1025.0
    }

    fn mixing(&self, _: &Vector3<f64>, _: f64) -> Mixing {
        Mixing::default()
    }

    fn sample(&self, p: &Vector3<f64>, t_s: f64) -> WaterSample {
        let mut gradient = Matrix3::zeros();
        gradient[(0, 2)] = 0.002;
        WaterSample { velocity: self.velocity(p, t_s), gradient, rate: Vector3::zeros(), density_kg_m3: 1025.0 }
    }
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    println!("{}", crate::head("hull_speed"));
    for name in SHIPPED.iter().map(|shipped| shipped.folder) {
        let craft = Vehicle::load(&VehicleSpec::Shipped(name.into()), &FolderFiles(Path::new("")))?;
        // The least of three: what else the machine does only adds.
        let least = (0..3).map(|_| seconds(&craft)).fold(f64::MAX, f64::min);
        println!("{name:<16} {:>8.0} x real time", LASTS_S / least);
    }
    Ok(())
}

fn seconds(craft: &Vehicle) -> f64 {
    let mut craft = craft.clone();
    let set = match craft.idle() {
        Actuation::Fins(_) => Actuation::Fins(ActuatorCommand { rudder_rad: 0.05, stern_rad: 0.0, rpm: 1000.0 }),
        idle => {
            // A little of every drive.
            let little = |d: &VehicleDrive| d.named.idle + 0.05 * (d.limits[1] - d.named.idle);
            craft.drives().iter().enumerate().fold(idle, |set, (k, drive)| set.with_drive(k, little(drive)))
        }
    };
    let start = Pose::level(Vector3::new(0.0, 0.0, -5000.0), Heading::from_deg(0.0));
    let mut truth = Truth::at_rest(start);
    let begun = Instant::now();
    for k in 0..(LASTS_S / STEP_S) as u32 {
        truth = craft.step(&truth, &Shear, f64::from(k) * STEP_S, &set, STEP_S);
    }
    black_box(truth);
    begun.elapsed().as_secs_f64()
}
