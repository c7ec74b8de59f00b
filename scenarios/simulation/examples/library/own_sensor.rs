//! A sensor of your own: the pressure of the water, with noise.
//!
//! `cargo run --release --example library own_sensor`

use rheotaxis::prelude::*;

params! {
    /// The parameters, in the field `pressure` of `sensors`. A field that is left out has its default.
    struct PressureParams as "pressure", "pressure of the water above the vehicle", from "an example" {
        /// Standard deviation of the noise, Pa.
        noise_pa: NonNegative = NonNegative::new(100.0),
    }
}

/// From parameters to an instrument on a vehicle. Its random numbers are its own, so it changes nobody else's.
impl SensorParams for PressureParams {
    fn build(&self, on: &Fitting) -> Result<Box<dyn Sensor>, RobotError> {
        Ok(Box::new(Pressure { noise_pa: self.noise_pa.get(), rng: on.robot.stream("pressure") }))
    }

    // A column of track.csv; live state, recording, summary and page have it, too.
    fn numbers(&self) -> &'static [&'static str] {
        &["pressure_pa"]
    }
}

/// The instrument at work. Sensors are the only parts of a searcher that may read the truth: they turn it into
/// readings.
#[derive(Debug)]
struct Pressure {
    noise_pa: f64,
    rng: Stream,
}

impl Sensor for Pressure {
    fn sense(&mut self, around: &Surroundings, readings: &mut Readings) {
        let p_W = around.truth.pose.p_WB;
        let density = around.flow.density(&p_W, around.clock.t_s());
        let pressure_pa = density * 9.81 * -p_W.z + self.noise_pa * self.rng.normal();
        // Strategies find it in `Observation::other`.
        readings.other.push(("pressure_pa", pressure_pa));
    }
}

#[allow(clippy::print_stdout, reason = "an example shows its result")]
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let registry = Registry::default().with::<Sensors, PressureParams>()?;
    let scenario = load_with(&registry, "uniform_channel".as_ref())?
        .set("robots[0].sensors.pressure", "(noise_pa: 50)")?
        .set("time", "(spin_up_s: 60, limit_s: 10)")?;

    let mut trial = Trial::assemble(&scenario, 1)?;
    trial.until(5.0);
    let depth_m = -trial.frame().ok_or("no frame")?.robots[0].truth.pose.p_WB.z;
    let world = &mut trial.simulation.world;
    let readings = world.query::<&Readings>().single(world)?;
    let (name, pressure_pa) = readings.other.first().ok_or("the sensor says nothing")?;
    println!("{name} {pressure_pa:.0} at a depth of {depth_m:.2} m");
    if (pressure_pa - 1026.0 * 9.81 * depth_m).abs() > 1000.0 {
        return Err("that is not the pressure at this depth".into());
    }
    Ok(())
}
