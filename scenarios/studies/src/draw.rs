//! Values of a scenario that are drawn anew for every seed.

use crate::distribution::Distribution;
use rheotaxis::scenario::{Loaded, set_value};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::borrow::Cow;
use world::seeds::{Seed, Stream};

/// A value of the scenario that differs from seed to seed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Draw {
    /// Arms in which it is drawn; all if none is named.
    #[serde(default)]
    pub arms: Vec<String>,
    /// Its path in the scenario.
    pub path: String,
    /// From what it is drawn.
    pub of: Distribution,
}

/// The scenario of an arm for a seed: with its values drawn.
///
/// # Errors
/// The path and what is wrong with it.
pub(crate) fn drawn<'a>(draws: &[Draw], arm: &str, loaded: &'a Loaded, seed: Seed) -> Result<Cow<'a, Loaded>, String> {
    changed(draws, arm, loaded, &|path| number(seed, path))
}

/// Checks that the arms of draws are there and that every value that can be drawn is legal.
///
/// # Errors
/// The path and what is wrong with it.
pub(crate) fn check(draws: &[Draw], arms: &[(String, Loaded)]) -> Result<(), String> {
    for d in draws {
        if let Some(fault) = d.of.fault() {
            return Err(format!("draw `{}`: {fault}", d.path));
        }
        let known = |name: &String| arms.iter().any(|(arm, _)| arm == name);
        if let Some(astray) = d.arms.iter().find(|name| !known(name)) {
            return Err(format!("draw `{}`: the row has no arm `{astray}`", d.path));
        }
    }
    for (arm, loaded) in arms {
        for d in draws.iter().filter(|d| d.in_arm(arm)) {
            for u in d.of.extremes() {
                let number = |path: &str| if path == d.path { u } else { 0.5 };
                let all = changed(draws, arm, loaded, &number)?;
                let said = all.check();
                said.map_err(|e| format!("draw `{}`: {e}", d.path))?;
            }
        }
    }
    Ok(())
}

/// The number of a path for a seed, uniform from 0 to 1.
pub(crate) fn number(seed: Seed, path: &str) -> f64 {
    Stream::new(seed, path, "draw").uniform()
}

impl Draw {
    /// The value at a number from 0 to 1, in RON; numbers with six decimals.
    pub(crate) fn value(&self, number: f64) -> String {
        self.of.value(number, |v| format!("{v:.6}"))
    }

    /// Whether it is drawn in an arm.
    pub(crate) fn in_arm(&self, arm: &str) -> bool {
        self.arms.is_empty() || self.arms.iter().any(|a| a == arm)
    }
}

fn changed<'a>(
    draws: &[Draw],
    arm: &str,
    loaded: &'a Loaded,
    number: &dyn Fn(&str) -> f64,
) -> Result<Cow<'a, Loaded>, String> {
    let mut text = loaded.text();
    for d in draws.iter().filter(|d| d.in_arm(arm)) {
        let value = d.value(number(&d.path));
        let said = |problem| format!("draw `{}`: {problem}", d.path);
        text = Cow::Owned(set_value(&text, &d.path, &value).map_err(said)?);
    }
    let Cow::Owned(text) = text else {
        return Ok(Cow::Borrowed(loaded));
    };
    loaded.with_text(&loaded.path, text).map(Cow::Owned).map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use rheotaxis::scenario::load;
    use std::path::Path;

    fn channel() -> Loaded {
        load(Path::new("uniform_channel")).expect("in the catalogue")
    }

    fn draw(path: &str, of: Distribution) -> Draw {
        Draw { arms: Vec::new(), path: path.to_string(), of }
    }

    #[test]
    fn a_seed_draws_its_own_values_and_the_same_ones_again() {
        let loaded = channel();
        let draws = [draw("optics.clarity.visibility_m", Distribution::LogUniform(3.0, 6.0))];
        let of = |seed: u64| {
            let got = drawn(&draws, "a", &loaded, Seed::from(seed)).unwrap();
            got.scenario.optics.clarity.visibility_m.get()
        };
        let all: Vec<f64> = (1..50).map(of).collect();
        assert!(all.iter().all(|v| (3.0..=6.0).contains(v)), "{all:?}");
        // Evenly in the logarithm, the middle is 4.24.
        let below = all.iter().filter(|v| **v < 18f64.sqrt()).count();
        assert!((12..37).contains(&below), "{below}");
        assert_eq!(of(7), of(7));
        assert_ne!(of(7), of(8));
    }

    #[test]
    fn a_draw_of_other_arms_changes_nothing() {
        let loaded = channel();
        let mut one = draw("time.limit_s", Distribution::Uniform(10.0, 20.0));
        one.arms = vec!["murky".to_string()];
        let same = drawn(&[one.clone()], "clear", &loaded, Seed::from(1)).unwrap();
        assert!(matches!(same, Cow::Borrowed(_)));
        let other = drawn(&[one], "murky", &loaded, Seed::from(1)).unwrap();
        assert!(other.scenario.time.limit_s.get() < 20.0);
    }

    #[test]
    fn what_could_be_drawn_and_is_not_legal_is_told() {
        let arms = [("a".to_string(), channel())];
        let visibility = "optics.clarity.visibility_m";
        for (path, of, told) in [
            (visibility, Distribution::LogUniform(0.0, 2.0), "needs two positive numbers"),
            (visibility, Distribution::Uniform(3.0, 2.0), "needs two finite numbers"),
            (visibility, Distribution::Choice(Vec::new()), "at least one value"),
            (visibility, Distribution::LogUniform(2.0, 1e4), "visibility_m"),
            ("robots[7].id", Distribution::Choice(vec!["\"b\"".to_string()]), "robots[7].id"),
        ] {
            let said = check(&[draw(path, of)], &arms).unwrap_err();
            assert!(said.contains(told), "{said}");
        }
        let other = Draw { arms: vec!["murky".to_string()], ..draw("time.limit_s", Distribution::Uniform(10.0, 20.0)) };
        let said = check(&[other], &arms).unwrap_err();
        assert_eq!(said, "draw `time.limit_s`: the row has no arm `murky`");
    }
}
