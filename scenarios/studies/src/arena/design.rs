//! The campaign of a family: its arms are the searchers.

use super::family::Machine;
use super::load::{ArenaError, Family};
use super::searcher::SearcherSpec;
use crate::campaign::Campaign;
use crate::distribution::Distribution;
use crate::fill::fill;
use std::fmt::Write as _;
use world::seeds::Key;

const TEXT: &str = "writing to a String succeeds";
/// The pair of fluorometers that bilateral chemotaxis needs.
const PAIR: &str = "robots[0].sensors.fluorometers_aside";

/// Seeds and key, the same for every family.
#[derive(Clone, Copy, Debug)]
pub struct Contest {
    /// Number of seeds; without it, what each family has for a first look.
    pub seeds: Option<u64>,
    /// The first seed.
    pub first_seed: u64,
    /// The key. Seeds under a key that is drawn when all designs are frozen are sealed: nobody can have tuned on them.
    pub key: Key,
}

/// The campaign of a family, with those of the searchers that fit its machine.
///
/// # Errors
/// If none fits, if a text names what the family does not give, or if the campaign is wrong.
pub fn campaign(family: &Family, searchers: &[SearcherSpec], contest: &Contest) -> Result<Campaign, ArenaError> {
    let (spec, name) = (&family.spec, &family.name);
    let machine = spec.machine;
    let fitting: Vec<&SearcherSpec> = searchers.iter().filter(|s| s.machine == machine).collect();
    if fitting.is_empty() {
        return Err(ArenaError::Nobody { family: family.shown.clone(), machine });
    }
    let drawn: Vec<&str> = spec.draw.iter().map(|(path, _)| path.as_str()).collect();
    let wrong = |whose: String| move |problem| ArenaError::Fill { whose, problem };
    let mut given: Vec<(String, String)> = Vec::new();
    for (name, value) in &spec.given {
        let filled = fill(value, &given, &[]).map_err(wrong(format!("{}: given {name}", family.shown)))?;
        given.push((name.clone(), filled));
    }
    let count = contest.seeds.unwrap_or(spec.quick.get());
    let mut text =
        format!("(version: {}, title: {:?}, base: {:?},\n", rheotaxis::scenario::VERSION, spec.title, spec.base);
    writeln!(text, "seeds: Literal(first: {}, count: {count}),\ndraw: [", contest.first_seed).expect(TEXT);
    for (path, of) in &spec.draw {
        writeln!(text, "  (path: {path:?}, of: {}),", of.ron()).expect(TEXT);
    }
    text.push_str("],\narms: [\n");
    for searcher in fitting {
        writeln!(text, "  (name: {:?}, set: [", searcher.name).expect(TEXT);
        // What is drawn is the truth: only who stands in no ranking may be told it, or change the contest.
        let told: &[&str] = if searcher.privileged { &drawn } else { &[] };
        for (path, value) in &searcher.set {
            let whose = format!("{} in {}", searcher.name, family.shown);
            let own = machine.own_paths();
            if !searcher.privileged && !own.iter().any(|of| path == of || path.starts_with(&format!("{of}."))) {
                let problem = format!("`{path}`: a searcher may set only {}", own.join(", "));
                return Err(ArenaError::Fill { whose, problem });
            }
            // The pair is the same instrument for all; its noise and span are not the searcher's.
            if !searcher.privileged && path.starts_with(PAIR) && (path != PAIR || value != "()") {
                let problem = format!("`{path}`: `{PAIR}` is `()` or not there, for instruments are the family's");
                return Err(ArenaError::Fill { whose, problem });
            }
            let value = fill(value, &given, told).map_err(wrong(whose))?;
            writeln!(text, "    ({path:?}, {value:?}),").expect(TEXT);
        }
        text.push_str("  ]),\n");
    }
    text.push_str("])\n");
    let mut campaign = Campaign::new(&format!("arena {name}"), name, &text, family.base.clone())?;
    campaign.key = contest.key;
    Ok(campaign)
}

impl Distribution {
    /// As it stands in a file.
    fn ron(&self) -> String {
        match self {
            Self::Uniform(a, b) => format!("Uniform({a}, {b})"),
            Self::LogUniform(a, b) => format!("LogUniform({a}, {b})"),
            Self::Choice(values) => format!("Choice({values:?})"),
        }
    }
}

impl Machine {
    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Machine::Robot => "vehicle",
            Machine::Gantry => "gantry",
        }
    }

    /// What a searcher that is ranked may set; hull, other instruments, start, water and limits are the family's.
    fn own_paths(self) -> &'static [&'static str] {
        match self {
            Machine::Robot => &["robots[0].strategy", "robots[0].map", PAIR],
            Machine::Gantry => &["gantries[0].tracker"],
        }
    }
}
