//! A current of your own: a jet, fastest on its axis and slower to its sides.
//!
//! `cargo run --release --example library own_current`

use rheotaxis::prelude::*;

params! {
    /// An eastward jet along north = 0.
    struct Jet as "Jet", "an eastward jet, slower to its sides", from "an example" {
        /// Speed on the axis, m/s.
        speed_m_s: Positive = Positive::new(0.3),
        /// Distance from the axis at which half of the speed is left, m.
        half_width_m: Positive = Positive::new(20.0),
    }
}

/// How it joins the water. The water adds all currents up; this one is the same at all depths.
impl CurrentParams for Jet {
    fn join(&self, water: &mut FreeWater, _: &CurrentSlot) -> Result<(), PlumeError> {
        water.add(self.clone());
        Ok(())
    }

    fn is_steady(&self) -> bool {
        true
    }
}

/// The current itself: (east, north) in m/s at a place and a time.
impl PlaneCurrent for Jet {
    fn velocity(&self, p: Vector2<f64>, _t_s: f64) -> Vector2<f64> {
        let off = p.y / self.half_width_m.get();
        Vector2::new(self.speed_m_s.get() / (1.0 + off * off), 0.0)
    }
}

#[allow(clippy::print_stdout, reason = "an example shows its result")]
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let registry = Registry::default().with::<Currents, Jet>()?;
    let scenario = load_with(&registry, "uniform_channel".as_ref())?
        .set("water.currents", "[Uniform(heading_deg: 90, speed_m_s: 0.2), Jet(half_width_m: 20)]")?
        .set("time", "(spin_up_s: 60, limit_s: 10)")?;

    // The plume drifts with it, and the vehicle is carried by it.
    let mut trial = Trial::assemble(&scenario, 1)?;
    trial.until(10.0);
    let speeds = [0.0, 20.0, 50.0].map(|north_m| {
        let speed_m_s = trial.simulation.velocity(&Vector3::new(0.0, north_m, -5.0)).x;
        println!("{north_m:2.0} m off the axis: {speed_m_s:.2} m/s");
        speed_m_s
    });
    if !(speeds[0] > speeds[1] + 0.1 && speeds[1] > speeds[2] + 0.05) {
        return Err("the jet is not in the water".into());
    }
    Ok(())
}
