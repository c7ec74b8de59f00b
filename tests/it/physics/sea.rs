//! A vehicle close under the waves: it holds its depth, its Doppler log dead-reckons, and the flow it believes is the
//! tide's, not the waves'.

use crate::common;
use nalgebra::Vector2;
use rheotaxis::assemble::Simulation;
use rheotaxis::scenario::Scenario;
use robots::handoff::Estimate;
use std::path::Path;
use world::frames::Truth;

/// Five minutes in Dalian Bay without the plume; in front of it the waves as they are there, or none.
fn scenario(waves: bool) -> Scenario {
    let loaded = common::scenario("dalian_bay", &[("time.spin_up_s", "1")]).edit(|s| {
        if !waves {
            s.water.currents.retain(|current| current.name() != "Waves");
        }
    });
    loaded.scenario
}

struct Held {
    /// Mean square of the depth error over the last four minutes, m², and the worst error, m.
    depth: (f64, f64),
    /// Mean square error of the flow believed against the water's without waves, m²/s².
    flow: f64,
    /// How far dead reckoning has drifted since the launch, m.
    drift_m: f64,
}

fn held(waves: bool) -> Held {
    const STEPS: u32 = 15_000;
    let mut sim = Simulation::assemble(&scenario(waves), Path::new(""), 4).unwrap();
    sim.ocean_mut().spin_up(|_| true);
    let mut seen = sim.world.query::<(&Truth, &Estimate)>();
    let (mut n, mut depth, mut worst, mut flow, mut off) = (0.0, 0.0, 0.0_f64, 0.0, Vec::new());
    for step in 0..STEPS {
        sim.tick();
        let (truth, estimate) = seen.single(&sim.world).unwrap();
        let p = truth.pose.p_WB;
        off.push(estimate.position - p.xy());
        if step < 3000 {
            continue;
        }
        n += 1.0;
        let error = p.z + 1.5;
        depth += error * error;
        worst = worst.max(error.abs());
        let ocean = sim.ocean();
        let t = sim.t_s() + ocean.spin_up_s();
        let tide: Vector2<f64> = ocean.water().column(p.xy(), t).velocity(p.z - 1.0).xy();
        flow += (estimate.flow.unwrap().velocity - tide).norm_squared();
    }
    Held { depth: (depth / n, worst), flow: flow / n, drift_m: (off[off.len() - 1] - off[0]).norm() }
}

#[test]
fn a_vehicle_close_under_waves_holds_its_depth_and_knows_the_tide() {
    let (calm, rough) = (held(false), held(true));
    // It feels them: orbits are 4 cm rms high at its depth. (Measured: 1.8 cm rms calm, 3.6 under waves, at worst 14.)
    assert!(rough.depth.0 > 1.2 * calm.depth.0);
    // The surface is six standard deviations of the depth away.
    assert!(rough.depth.0.sqrt() < 1.5 / 6.0 && rough.depth.1 < 0.75);
    // Instrument noise leaves half a centimetre a second, a degree of compass bias two and a half of 1.5 m/s while it
    // turns; waves of 7 cm/s rms
    // through ten seconds of low-pass add a centimetre. Unfiltered they would be 7. (Measured: 1.0 cm/s calm, 1.2
    // under waves.)
    assert!(rough.flow.sqrt() < 0.04, "{}", rough.flow.sqrt());
    // A degree and 0.2 % of five minutes at 1.5 m/s are at most 9 m.
    assert!(rough.drift_m < 9.0 && calm.drift_m < 9.0);
    assert!(rough.drift_m > 0.1);
}
