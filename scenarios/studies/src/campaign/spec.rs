//! The content of a campaign file.

use super::seeds::{MOST, Seeds, number_or_form};
use crate::distribution::Distribution;
use crate::draw::Draw;
use rheotaxis::explain::FileKind;
use rheotaxis::scenario::{Outline, ScenarioError, UnplacedFault, Version, read, version_first};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::registry::Registry;
use world::seeds::Stream;

/// The half width that an interval of a share must be narrower than to say anything.
const WIDEST: f64 = 0.5;

/// Arms that may be drawn: those of a seed run side by side.
const MOST_ARMS: u64 = 10_000;

/// Campaign files, for `rheotaxis explain`.
pub const FILE: FileKind =
    FileKind::new::<CampaignSpec>("campaign", "A campaign file, which `rheotaxis campaign plan` reads.");

/// A campaign: one scenario, several arms, many seeds.
#[derive(Clone, Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CampaignSpec {
    /// Version of campaign files; the first field of every file.
    pub version: Version,
    /// What is compared, in one line.
    pub title: String,
    /// Scenario: a file relative to the campaign's, or the name of one that comes with the program.
    pub base: String,
    /// How many seeds, or which.
    #[serde(deserialize_with = "number_or_form")]
    pub seeds: Seeds,
    /// Stop earlier, once every success share is known precisely enough.
    #[serde(default)]
    pub until: Option<Until>,
    /// The things compared, at least one.
    #[serde(default)]
    pub arms: Vec<Arm>,
    /// Further arms, drawn at random and called `draw 1`, `draw 2`, ...
    #[serde(default)]
    pub drawn_arms: Option<RandomDraws>,
    /// Values that are drawn anew for every seed, from the seed and the key. An arm may set what depends on them: in
    /// its values, `{PATH}` is the value that was drawn for this path, and `{0.5 PATH}` half of it.
    #[serde(default)]
    pub draw: Vec<Draw>,
    /// The conditions under which they are compared.
    #[serde(default)]
    pub conditions: Conditions,
}

/// When enough is known to stop.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Until {
    /// Largest half width of the 95 % interval of any arm's success share under any condition.
    #[schemars(extend("exclusiveMinimum" = 0.0, "exclusiveMaximum" = WIDEST))]
    pub half_width: f64,
}

/// One of the things compared: the scenario with some values changed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Arm {
    /// Its name in tables, unlike those of other arms.
    pub name: String,
    /// Changes: a path in the scenario and the new value in RON.
    #[serde(default)]
    pub set: Vec<(String, String)>,
}

impl Arm {
    /// What it sets, `path=value` joined by `; `.
    pub fn describe(&self) -> String {
        let set: Vec<String> = self.set.iter().map(|(p, v)| format!("{p}={v}")).collect();
        if set.is_empty() { "as it is".to_string() } else { set.join("; ") }
    }
}

/// Conditions, the same for every arm.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub enum Conditions {
    /// Only the scenario as it is.
    #[default]
    Single,
    /// Every combination of these values; the last path changes fastest.
    Grid(Vec<(String, Vec<String>)>),
    /// Drawn at random.
    Random(RandomDraws),
}

/// Conditions or arms drawn at random.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RandomDraws {
    /// Number of them.
    #[schemars(extend("minimum" = 1, "maximum" = MOST))]
    pub n: u64,
    /// Seed of the random values; 1 by default.
    #[serde(default)]
    pub seed: Option<u64>,
    /// Which values vary, and how: a path in the scenario and a distribution.
    pub draw: Vec<(String, Distribution)>,
}

impl CampaignSpec {
    /// Reads a campaign from its text; errors call it `name`.
    ///
    /// # Errors
    /// If it is not a campaign, with the place.
    pub fn parse(name: &str, text: &str) -> Result<Self, ScenarioError> {
        version_first(name, text, &Outline::scan(text))?;
        let mut spec: Self = read(&Registry::default(), name, text, Self::check)?;
        if let Some(drawn) = &spec.drawn_arms {
            spec.arms.extend((0..drawn.n).map(|k| Arm { name: drawn_name(k), set: drawn.set("arm", k) }));
        }
        Ok(spec)
    }

    /// Number of runs.
    pub fn n_runs(&self) -> u64 {
        self.n_conditions() * self.seeds.count() * self.n_arms()
    }

    /// Number of arms.
    pub fn n_arms(&self) -> u64 {
        self.arms.len() as u64
    }

    /// Number of conditions; at most 2^64 - 1.
    pub fn n_conditions(&self) -> u64 {
        match &self.conditions {
            Conditions::Single => 1,
            Conditions::Grid(axes) => {
                (axes.iter()).fold(1, |n: u64, (_, values)| n.saturating_mul(values.len() as u64))
            }
            Conditions::Random(random) => random.n,
        }
    }

    fn check(&self) -> Vec<UnplacedFault> {
        let mut found = Vec::new();
        let mut wrong = |path: &str, problem: String| found.push(UnplacedFault::error(path, problem));
        if let Some((field, problem)) = self.seeds.fault() {
            wrong("seeds", format!("{field} {problem}"));
        }
        if let Some(until) = &self.until
            && !(until.half_width > 0.0 && until.half_width < WIDEST)
        {
            let got = until.half_width;
            wrong("until.half_width", format!("must be above 0 and below {WIDEST}, got {got}"));
        }
        if self.arms.is_empty() && self.drawn_arms.is_none() {
            wrong("arms", "there must be at least one arm".to_string());
        }
        for (i, arm) in self.arms.iter().enumerate() {
            if arm.name.is_empty() {
                wrong(&format!("arms[{i}].name"), "must not be empty".to_string());
            }
            if self.arms[..i].iter().any(|a| a.name == arm.name) {
                let name = &arm.name;
                wrong(&format!("arms[{i}].name"), format!("\"{name}\" is taken by another arm"));
            }
        }
        let varied: Vec<&String> = match &self.conditions {
            Conditions::Single => Vec::new(),
            Conditions::Grid(axes) => {
                for (i, (_, values)) in axes.iter().enumerate() {
                    if values.is_empty() {
                        wrong(&format!("conditions[{i}]"), "there must be at least one value".to_string());
                    }
                }
                axes.iter().map(|(path, _)| path).collect()
            }
            Conditions::Random(random) => {
                random.check("conditions", MOST, &mut wrong);
                random.paths().collect()
            }
        };
        if let Some(drawn) = &self.drawn_arms {
            drawn.check("drawn_arms", MOST_ARMS, &mut wrong);
            for (i, arm) in
                self.arms.iter().enumerate().filter(|(_, arm)| (0..drawn.n).any(|k| arm.name == drawn_name(k)))
            {
                wrong(&format!("arms[{i}].name"), format!("\"{}\" is taken by an arm of `drawn_arms`", arm.name));
            }
            for path in drawn.paths().filter(|path| varied.contains(path)) {
                wrong("drawn_arms.draw", format!("`{path}` is set by the conditions too"));
            }
        }
        for (i, draw) in self.draw.iter().enumerate() {
            let at = format!("draw[{i}]");
            if let Some(problem) = draw.of.fault() {
                wrong(&at, problem);
            }
            if varied.contains(&&draw.path) {
                wrong(&at, format!("`{}` is set by the conditions too", draw.path));
            }
            if let Some(astray) = draw.arms.iter().find(|name| !self.arms.iter().any(|arm| arm.name == **name)) {
                wrong(&at, format!("there is no arm `{astray}`"));
            }
        }
        for (i, arm) in self.arms.iter().enumerate() {
            for (path, _) in &arm.set {
                if varied.contains(&path) {
                    wrong(&format!("arms[{i}].set"), format!("`{path}` is set by the conditions too"));
                }
            }
        }
        let n_arms = (self.arms.len() as u64).saturating_add(self.drawn_arms.as_ref().map_or(0, |drawn| drawn.n));
        let runs = (self.n_conditions()).checked_mul(self.seeds.count()).and_then(|n| n.checked_mul(n_arms));
        if runs.is_none_or(|n| n > MOST) {
            wrong("seeds", format!("the campaign has more than {MOST} runs (arms x conditions x seeds)"));
        }
        found
    }
}

/// The name of the k-th of the arms that are drawn.
fn drawn_name(k: u64) -> String {
    format!("draw {}", k + 1)
}

impl RandomDraws {
    /// The paths that vary.
    fn paths(&self) -> impl Iterator<Item = &String> {
        self.draw.iter().map(|(path, _)| path)
    }

    /// The paths and values of the `k`-th condition or arm, as `what` says.
    pub(super) fn set(&self, what: &str, k: u64) -> Vec<(String, String)> {
        let drawn = |(path, from): &(String, Distribution)| {
            let u = Stream::new(self.seed.unwrap_or(1), &format!("{what} {k}"), path).uniform();
            (path.clone(), from.value(u, |v| v.to_string()))
        };
        self.draw.iter().map(drawn).collect()
    }

    fn check(&self, field: &str, most: u64, wrong: &mut impl FnMut(&str, String)) {
        if !(1..=most).contains(&self.n) {
            wrong(&format!("{field}.n"), format!("must be from 1 to {most}, got {}", self.n));
        }
        for (i, (_, from)) in self.draw.iter().enumerate() {
            if let Some(problem) = from.fault() {
                wrong(&format!("{field}.draw[{i}]"), problem);
            }
        }
    }
}

#[cfg(test)]
mod tests;
