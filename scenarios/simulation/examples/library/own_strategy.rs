//! A strategy of your own: up-stream until it smells something, and there it declares.
//!
//! `cargo run --release --example library own_strategy`

use rheotaxis::prelude::*;

params! {
    /// The parameters, as a scenario file gives them. `Positive` is a number that must be above zero; a file with another
    /// number is refused with line and column.
    struct UpFlowParams as "UpFlow", "up-stream until it smells something, and there it declares", from "an example" {
        /// Speed through the water, m/s.
        speed_m_s: Positive = Positive::new(1.5),
        /// Height above the bed, m.
        altitude_m: Positive = Positive::new(2.0),
    }
}

/// From parameters to a strategy at work.
impl StrategyParams for UpFlowParams {
    fn build(&self, _: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(UpFlow(self.clone())))
    }
}

/// The strategy at work. It is called once a tick. It gets what the instruments and the navigation say, never the
/// truth, and answers with a goal for the guidance.
#[derive(Debug)]
struct UpFlow(UpFlowParams);

impl Strategy for UpFlow {
    fn step(&mut self, seen: &Observation, _: &mut Stream) -> Decision {
        let up_stream = (seen.estimate.flow).map_or(Heading::from_deg(270.0), |f| f.up_flow());
        let goal = Goal {
            id: 1,
            manoeuvre: Manoeuvre::Course { course: up_stream },
            vertical: Vertical::Altitude(self.0.altitude_m.get()),
            speed_m_s: self.0.speed_m_s.get(),
        };
        let smelt = seen.chemical.is_some_and(|c| c.detected);
        let place = seen.estimate.position;
        Decision {
            declared: smelt.then(|| Declaration::first(seen.t_s, place, "first smell")),
            outcome: smelt.then_some(Outcome::Completed),
            ..Decision::new(Behaviour::Other("up_flow"), goal)
        }
    }
}

#[allow(clippy::print_stdout, reason = "an example shows its result")]
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A registry that knows the new strategy beside those of the program.
    let registry = Registry::default().with::<Strategies, UpFlowParams>()?;

    // A scenario of the catalogue with this strategy in the place of its own.
    let scenario = load_with(&registry, "uniform_channel".as_ref())?
        .set("robots[0].strategy", "UpFlow(speed_m_s: 1.5)")?
        .edit(|s| {
            s.time.spin_up_s = NonNegative::new(300.0);
            s.time.limit_s = Positive::new(120.0);
        });

    let mut trial = Trial::assemble(&scenario, 1)?;
    trial.until(60.0);
    let robot = &trial.frame().ok_or("no frame")?.robots[0];
    let went_m = 150.0 - robot.truth.pose.p_WB.x;
    println!("{}: {went_m:.0} m up-stream in a minute", robot.behaviour.name());
    let ended = trial.run(&mut rheotaxis::trial::Unwatched);
    println!("{} after {:.0} s", ended.outcome.label(), ended.t_s);
    if went_m < 30.0 {
        return Err("the strategy did not take the vehicle up-stream".into());
    }
    Ok(())
}
