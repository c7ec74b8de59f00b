//! A run in steps: the state is read every minute, and the ocean is asked for the water at the vehicle.
//!
//! `cargo run --release --example library stepped`

use rheotaxis::scenario::load;
use rheotaxis::trial::Trial;
use std::path::Path;
use world::fields::Flow;

#[allow(clippy::print_stdout, reason = "an example shows its result")]
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let scenario = load(Path::new("uniform_channel"))?;
    let mut trial = Trial::assemble(&scenario, 1)?;
    let mut minute = 1.0;
    // `until` makes ticks up to a time of the mission; it is false once the run is over.
    while trial.until(60.0 * minute) {
        // A frame is a copy of the state, ten times a second.
        if let Some(robot) = trial.frame().and_then(|frame| frame.robots.first()) {
            let (believed, place) = (robot.estimate.position, robot.truth.pose.p_WB);
            let ocean = trial.simulation.ocean();
            let water = ocean.velocity(&place, trial.simulation.t_s());
            println!(
                "{minute:.0} min: {} at {:.0} m east, {:.0} m north (believes {:.0}, {:.0}), \
                 water {:.2} m/s, {} filaments",
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
    // The score says how each searcher did, whatever was recorded.
    let score = trial.score();
    let searcher = &score.searchers[0];
    println!(
        "{}: {:.0} m travelled, {} detections, {:.1} m from a source at the closest",
        trial.ended().outcome.label(),
        searcher.travelled_m,
        searcher.detections,
        score.closest_m()
    );
    if minute < 2.0 || searcher.travelled_m < 60.0 {
        return Err("the vehicle hardly moved".into());
    }
    Ok(())
}
