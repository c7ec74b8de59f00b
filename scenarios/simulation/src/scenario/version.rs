//! The version of files that this program reads.

use super::fault::{Fault, ScenarioError, UnplacedFault};
use super::reader::outline::{Node, Outline};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The version of scenario and campaign files.
pub const VERSION: u32 = 2;

/// How files of version 1 become files of version 2.
const OLD: &str = "rheotaxis 0.1.0 is the last release that reads version 1. In version 2, `source:` at the head of a \
    scenario is `citation:`; `seed: S, seeds: N` of a campaign is `seeds: Hashed(seed: S, count: N)`";

/// The version of a scenario.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "u32", into = "u32")]
#[schemars(extend("const" = VERSION))]
pub struct Version;

impl TryFrom<u32> for Version {
    type Error = String;
    fn try_from(v: u32) -> Result<Self, String> {
        if v == VERSION { Ok(Self) } else { Err(unknown(v)) }
    }
}

impl From<Version> for u32 {
    fn from(_: Version) -> u32 {
        VERSION
    }
}

fn unknown(got: impl std::fmt::Display) -> String {
    format!("this program reads version {VERSION}, got {got}")
}

/// Checks the version before anything else, because a file of another version may differ in everything.
///
/// # Errors
/// If the first field is not the version, or if the version is another. A file that is cut off gets its mistakes of
/// form first.
pub fn version_first(name: &str, text: &str, outline: &Outline) -> Result<(), ScenarioError> {
    let top = outline.nodes.iter().filter(|n| !n.path.is_empty() && !n.path.contains(['.', '[']));
    let Some(first) = top.min_by_key(|n| n.whole.start).filter(|_| outline.whole) else {
        return Ok(());
    };
    let number = text[first.value.clone()].parse();
    if first.path == "version" && number == Ok(VERSION) {
        return Ok(());
    }
    let found = not_read(text, first, number.ok());
    Err(Box::new(Fault::new(name, text, first.whole.clone(), found)).into())
}

fn not_read(text: &str, first: &Node, number: Option<u32>) -> UnplacedFault {
    if first.path != "version" {
        let problem = format!("the first field must be `version: {VERSION}`");
        return UnplacedFault::error("version", problem).hint(format!("the file begins with `{}`", first.path));
    }
    let found = UnplacedFault::error("version", unknown(&text[first.value.clone()]));
    found.hint(match number {
        Some(1) => OLD,
        _ => "use the program that wrote the file, or start from `rheotaxis init`",
    })
}

#[cfg(test)]
mod tests {
    use crate::scenario::{ScenarioError, parse, template};

    /// Which other versions there are, `tests/golden/bad_input` says.
    #[test]
    fn an_older_version_is_told_before_all_else_with_what_has_changed() {
        let text = template("duck_st").expect("in the catalogue").text.replace("title", "titel");
        let line = 1 + text.lines().position(|l| l.trim_start().starts_with("version:")).expect("it has one");
        let Err(ScenarioError::Text(fault)) = parse("old.ron", &text.replace("version: 2", "version: 1")) else {
            panic!("one mistake");
        };
        assert_eq!(fault.line(), format!("old.ron:{line}:5: version: this program reads version 2, got 1"));
        assert!(fault.help.as_ref().is_some_and(|help| help.contains("is `citation:`")), "{fault:?}");
    }
}
