//! A run that is stepped from outside: the state is read every minute, and the ocean is asked as well.
//!
//! `cargo run --release -p rheotaxis --example stepped`

use rheotaxis::scenario::load;
use rheotaxis::trial::Trial;
use std::path::Path;
use world::fields::Flow;

#[allow(clippy::print_stdout, reason = "an example speaks")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scenario = load(Path::new("uniform_channel"))?;
    let mut trial = Trial::assemble(&scenario, 1)?;
    let mut minute = 1.0;
    while trial.until(60.0 * minute) {
        if let Some(robot) = trial.frame().and_then(|frame| frame.robots.first()) {
            let (believed, place) = (robot.estimate.position, robot.truth.pose.p_WB);
            let ocean = trial.simulation.ocean();
            let water = ocean.velocity(&place, trial.simulation.t_s());
            println!(
                "{minute:.0} min: {} at {:.0} m east, {:.0} m north (believes {:.0}, {:.0}), water {:.2} m/s, {} filaments",
                robot.behaviour.name(),
                place.x,
                place.y,
                believed.x,
                believed.y,
                water.norm(),
                ocean.plume().len()
            );
        }
        minute += 1.0;
    }
    let score = trial.score();
    println!(
        "{}; closest {:.1} m",
        trial.ended().outcome.words(),
        score.closest_m()
    );
    Ok(())
}
