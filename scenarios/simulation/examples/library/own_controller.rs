//! A controller of your own: the run asks it once a second. It goes up-stream in zigzags until it smells the plume
//! clearly, and declares there.
//!
//! A strategy is built into the scenario's names (`own_strategy.rs`); a controller is called from outside, so it can be a
//! closure of your program, or what another process says.
//!
//! `cargo run --release --example library own_controller`

use rheotaxis::control::{Question, QuestionContent, Response};
use rheotaxis::scenario::load;
use rheotaxis::trial::Trial;
use robots::handoff::{Behaviour, Declaration, Manoeuvre, MotionOrder, MoveOrder, Outcome, Reply, Vertical};
use world::ranges::Positive;
use world::units::Heading;

/// What to do, from what the robot sees and has gathered since the last question.
fn decide(question: &Question) -> Response {
    let QuestionContent::Robot(seen, gathered) = &question.seen else {
        return Response::Nonsense("it steers robots only".to_string());
    };
    let up_stream = (seen.estimate.flow).map_or(Heading::from_deg(270.0), |f| f.up_flow());
    let side = if question.number % 100 < 50 { -1.0 } else { 1.0 };
    let smelt = gathered.highest > 0.2;
    Response::Answer(Reply {
        order: Some(MotionOrder::Move(MoveOrder {
            id: None,
            manoeuvre: Manoeuvre::Course { course: up_stream.turned(side * 0.9) },
            vertical: Some(Vertical::Altitude(2.0)),
            speed_m_s: Some(1.5),
        })),
        behaviour: Some(Behaviour::Other("up_stream")),
        declared: smelt.then(|| Declaration::first(seen.t_s, seen.estimate.position, "strong smell")),
        outcome: smelt.then_some(Outcome::Completed),
        picture: false,
    })
}

#[allow(clippy::print_stdout, reason = "an example shows its result")]
pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    // A scenario of the catalogue whose robot asks somebody outside, once a second.
    let scenario = load("uniform_channel".as_ref())?
        .set("robots[0].strategy", "External(period_s: 1)")?
        .edit(|s| s.time.limit_s = Positive::new(600.0));
    let mut trial = Trial::assemble(&scenario, 1)?;
    trial.control("auv0", decide)?;
    let ended = trial.finish_quietly();
    println!("{} after {:.0} s", ended.outcome.label(), ended.t_s);
    for declared in ended.declarations.values().flatten() {
        println!("declared at {:.0} m east", declared.position.x);
    }
    if ended.declarations.is_empty() {
        return Err("too little was smelt".into());
    }
    Ok(())
}
