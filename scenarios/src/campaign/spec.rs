//! What a campaign file says.

use crate::scenario::{Fault, Found, Outline, ScenarioError, explain};
use ron::extensions::Extensions;
use serde::{Deserialize, Serialize};

/// Version of the campaign files this program reads.
const VERSION: u32 = 1;

/// A campaign: one scenario, several arms, many seeds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CampaignSpec {
    /// Version of the file.
    pub version: u32,
    /// What is compared, in a line.
    pub title: String,
    /// Scenario: a file, relative to the campaign's, or the name of one that comes with the program.
    pub base: String,
    /// Seed that all runs' seeds are made from.
    #[serde(default = "one")]
    pub seed: u64,
    /// Seeds for each condition; every arm runs with each of them.
    pub seeds: u64,
    /// Stop before that, once every success share is known well enough.
    #[serde(default)]
    pub until: Option<Until>,
    /// What is compared.
    pub arms: Vec<Arm>,
    /// Circumstances in which it is compared.
    #[serde(default)]
    pub conditions: Conditions,
}

/// When enough is known.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Until {
    /// Greatest half width of the 95 % interval of any arm's success share under any condition, 0 to 0.5.
    pub half_width: f64,
}

fn one() -> u64 {
    1
}

/// One of the things compared: the scenario with some values changed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Arm {
    /// Its name in tables.
    pub name: String,
    /// Changes: path in the scenario and the new value as RON.
    #[serde(default)]
    pub set: Vec<(String, String)>,
}

/// Circumstances, the same for every arm.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Conditions {
    /// The scenario as it is.
    #[default]
    Single,
    /// Every combination of these values, the last path changing fastest.
    Grid(Vec<(String, Vec<String>)>),
    /// Drawn at random.
    Random(RandomConditions),
}

/// Conditions drawn at random.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RandomConditions {
    /// How many conditions.
    pub n: u64,
    /// Which values vary, and how.
    pub draw: Vec<(String, Draw)>,
}

/// The distribution of a value.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Draw {
    /// Uniform between two numbers.
    Uniform(f64, f64),
    /// Its logarithm uniform between those of two positive numbers.
    LogUniform(f64, f64),
    /// One of these values, each as likely.
    Choice(Vec<String>),
}

impl CampaignSpec {
    /// Reads a campaign from its text; errors call it `name`.
    ///
    /// # Errors
    /// If it is not a campaign, with the place.
    pub fn parse(name: &str, text: &str) -> Result<Self, ScenarioError> {
        let reader = ron::Options::default().with_default_extension(
            Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES,
        );
        let spec: Self = reader.from_str(text).map_err(|e| explain(name, text, &e))?;
        let outline = Outline::of(text);
        let mut faults: Vec<Fault> = (spec.check().into_iter())
            .map(|found| Fault::located(name, text, &outline, found))
            .collect();
        match faults.len() {
            0 => Ok(spec),
            1 => Err(Box::new(faults.remove(0)).into()),
            _ => Err(ScenarioError::Many {
                path: name.to_string(),
                faults,
            }),
        }
    }

    /// Number of conditions.
    #[must_use]
    pub fn n_conditions(&self) -> u64 {
        match &self.conditions {
            Conditions::Single => 1,
            Conditions::Grid(axes) => axes.iter().map(|(_, values)| values.len() as u64).product(),
            Conditions::Random(random) => random.n,
        }
    }

    fn check(&self) -> Vec<Found> {
        let mut found = Vec::new();
        let mut wrong = |path: &str, problem: String| found.push(Found::error(path, problem));
        if self.version != VERSION {
            let got = self.version;
            wrong(
                "version",
                format!("this program reads version {VERSION}, got {got}"),
            );
        }
        if self.seeds == 0 {
            wrong("seeds", "must be at least 1, got 0".to_string());
        }
        if let Some(until) = &self.until
            && !(until.half_width > 0.0 && until.half_width < 0.5)
        {
            let got = until.half_width;
            wrong(
                "until.half_width",
                format!("must be above 0 and below 0.5, got {got}"),
            );
        }
        if self.arms.is_empty() {
            wrong("arms", "there must be at least one arm".to_string());
        }
        for (i, arm) in self.arms.iter().enumerate() {
            if arm.name.is_empty() {
                wrong(&format!("arms[{i}].name"), "must not be empty".to_string());
            }
            if self.arms[..i].iter().any(|a| a.name == arm.name) {
                let name = &arm.name;
                wrong(
                    &format!("arms[{i}].name"),
                    format!("\"{name}\" is taken by another arm"),
                );
            }
        }
        let varied: Vec<&String> = match &self.conditions {
            Conditions::Single => Vec::new(),
            Conditions::Grid(axes) => {
                for (i, (_, values)) in axes.iter().enumerate() {
                    if values.is_empty() {
                        wrong(
                            &format!("conditions[{i}]"),
                            "there must be at least one value".to_string(),
                        );
                    }
                }
                axes.iter().map(|(path, _)| path).collect()
            }
            Conditions::Random(random) => {
                if random.n == 0 {
                    wrong("conditions.n", "must be at least 1, got 0".to_string());
                }
                for (i, (_, draw)) in random.draw.iter().enumerate() {
                    if let Err(problem) = draw.check() {
                        wrong(&format!("conditions.draw[{i}]"), problem);
                    }
                }
                random.draw.iter().map(|(path, _)| path).collect()
            }
        };
        for (i, arm) in self.arms.iter().enumerate() {
            for (path, _) in &arm.set {
                if varied.contains(&path) {
                    wrong(
                        &format!("arms[{i}].set"),
                        format!("`{path}` is set by the conditions too"),
                    );
                }
            }
        }
        let runs = (self.n_conditions())
            .checked_mul(self.seeds)
            .and_then(|n| n.checked_mul(self.arms.len() as u64));
        if runs.is_none_or(|n| n > 1 << 40) {
            wrong("seeds", "the campaign has more than 2^40 runs".to_string());
        }
        found
    }
}

impl Draw {
    fn check(&self) -> Result<(), String> {
        match self {
            Draw::Uniform(a, b) if !(a.is_finite() && b.is_finite() && a < b) => Err(format!(
                "needs two finite numbers, the smaller first, got {a}, {b}"
            )),
            Draw::LogUniform(a, b) if !(*a > 0.0 && b.is_finite() && a < b) => Err(format!(
                "needs two positive numbers, the smaller first, got {a}, {b}"
            )),
            Draw::Choice(values) if values.is_empty() => {
                Err("there must be at least one value".to_string())
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn faults(text: &str) -> Vec<String> {
        CampaignSpec::parse("c.ron", text).unwrap_err().lines()
    }

    #[test]
    fn mistakes_are_located() {
        let good =
            "(version: 1, title: \"t\", base: \"duck_st\", seeds: 3,\n arms: [(name: \"a\")])";
        assert_eq!(
            CampaignSpec::parse("c.ron", good).unwrap().n_conditions(),
            1
        );
        assert_eq!(
            faults(&good.replace("seeds: 3", "seeds: 0")),
            ["c.ron:1:43: seeds: must be at least 1, got 0"]
        );
        let wide = good.replace("seeds: 3", "seeds: 3, until: (half_width: 0.5)");
        assert_eq!(
            faults(&wide),
            ["c.ron:1:61: until.half_width: must be above 0 and below 0.5, got 0.5"]
        );
        let twins = good.replace("(name: \"a\")", "(name: \"a\"), (name: \"a\")");
        assert_eq!(
            faults(&twins),
            ["c.ron:2:23: arms[1].name: \"a\" is taken by another arm"]
        );
        let said = faults(&good.replace("seeds", "seed_s"));
        assert!(said[0].contains("there is no field `seed_s`"), "{said:?}");
    }

    #[test]
    fn an_arm_cannot_set_what_the_conditions_vary() {
        let text = "(version: 1, title: \"t\", base: \"b\", seeds: 1, arms: [(name: \"a\", set: [(\"x\", \"1\")])], \
            conditions: Random(n: 2, draw: [(\"x\", Uniform(0, 1))]))";
        let said = faults(text);
        assert!(
            said[0].contains("`x` is set by the conditions too"),
            "{said:?}"
        );
    }
}
