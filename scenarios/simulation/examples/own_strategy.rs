//! A strategy of one's own, known by its name in a scenario: against the water until it smells something, and there it declares.
//!
//! `cargo run --release -p rheotaxis --example own_strategy`

use rheotaxis::scenario::{load_with, template};
use rheotaxis::trial::Trial;
use robots::error::RobotError;
use robots::handoff::{
    Behaviour, Decision, Declaration, Goal, Manoeuvre, Observation, Outcome, Setting, Vertical,
};
use robots::strategy::{Strategies, Strategy, StrategyParams};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::ranges::Positive;
use world::registry::{Listed, Registry};
use world::seeds::Stream;
use world::units::Heading;

/// Parameters: what a scenario may say.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct UpFlowParams {
    /// Speed through the water, m/s.
    speed_m_s: Positive,
    /// Height above the bed, m.
    altitude_m: Positive,
}

impl Listed for UpFlowParams {
    const ENTRY: Entry = Entry {
        name: "UpFlow",
        what: "against the water until it smells something, and there it declares",
        source: "an example",
    };
}

impl StrategyParams for UpFlowParams {
    fn build(&self, _: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(UpFlow(self.clone())))
    }
}

/// The strategy at work.
#[derive(Debug)]
struct UpFlow(UpFlowParams);

impl Strategy for UpFlow {
    fn step(&mut self, seen: &Observation, _: &mut Stream) -> Decision {
        let goal = Goal {
            id: 1,
            manoeuvre: Manoeuvre::Course {
                course: (seen.estimate.flow).map_or(Heading::from_deg(270.0), |f| f.up_flow()),
            },
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

#[allow(clippy::print_stdout, reason = "an example speaks")]
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let registry = Registry::default().with::<Strategies, UpFlowParams>()?;

    // A scenario of the catalogue with this strategy in the place of its own.
    let folder = std::env::temp_dir().join(format!("own_strategy-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;
    let file = folder.join("channel.ron");
    let text = template("uniform_channel")
        .ok_or("it is in the catalogue")?
        .text;
    let begins = text.find("strategy: Amp(").ok_or("it has a strategy")?;
    let own = "strategy: UpFlow(speed_m_s: 1.5, altitude_m: 2.0)";
    let ends = begins + closing(&text[begins..]);
    std::fs::write(&file, format!("{}{own}{}", &text[..begins], &text[ends..]))?;

    let loaded = load_with(&registry, &file)?;
    let ended = Trial::assemble(&loaded, 1)?.finish_quietly();
    println!("{} after {:.0} s", ended.outcome.words(), ended.t_s);
    std::fs::remove_dir_all(&folder)?;
    Ok(())
}

/// Length of `name(…)` to its closing parenthesis.
fn closing(text: &str) -> usize {
    let mut open = 0;
    for (i, c) in text.char_indices() {
        match c {
            '(' => open += 1,
            ')' if open == 1 => return i + 1,
            ')' => open -= 1,
            _ => {}
        }
    }
    text.len()
}
