//! Versions of scenario files: which ones this program reads, and what they call differently.
//!
//! Version 2 calls the field of the head that names the paper `citation`; version 1 called it `source`, which is too
//! easily taken for `sources`. Nothing else differs. In memory every scenario is one of the newest version.

use super::fault::{Fault, ScenarioError, UnplacedFault};
use super::outline::{Node, Outline};
use super::reader::Renamed;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// The newest version of scenario files.
pub const VERSION: u32 = 2;

/// The oldest version that this program still reads.
pub const OLDEST: u32 = 1;

/// The version of a scenario: whatever the file says, what is read is of the newest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "u32", into = "u32")]
#[schemars(extend("const" = VERSION))]
pub struct Version(u32);

impl TryFrom<u32> for Version {
    type Error = String;
    fn try_from(v: u32) -> Result<Self, String> {
        if (OLDEST..=VERSION).contains(&v) { Ok(Self(VERSION)) } else { Err(unknown(v)) }
    }
}

impl From<Version> for u32 {
    fn from(v: Version) -> u32 {
        v.0
    }
}

fn unknown(got: impl std::fmt::Display) -> String {
    format!("this program reads versions {OLDEST} and {VERSION}, got {got}")
}

/// Checks the version before anything else, because a file of another version may differ in everything. Returns the
/// name that this version gives to the citation.
pub(super) fn version_first(name: &str, text: &str, outline: &Outline) -> Result<Renamed, ScenarioError> {
    let first = outline
        .nodes
        .iter()
        .filter(|n| !n.path.is_empty() && !n.path.contains(['.', '[']))
        .min_by_key(|n| n.whole.start);
    let version = first.filter(|n| n.path == "version");
    let number: Option<u32> = version.and_then(|n| text[n.value.clone()].parse().ok());
    // A file that is cut off gets its mistakes of form first.
    if outline.open.is_empty()
        && let Some(first) = first
        && !number.is_some_and(|v| (OLDEST..=VERSION).contains(&v))
    {
        let found = not_read(text, first);
        return Err(Box::new(Fault::new(name, text, first.whole.clone(), found)).into());
    }
    Ok(citation(number.unwrap_or(VERSION)))
}

fn not_read(text: &str, first: &Node) -> UnplacedFault {
    if first.path == "version" {
        let hint = "use the program that wrote the file, or start from `rheotaxis init`";
        UnplacedFault::error("version", unknown(&text[first.value.clone()])).hint(hint)
    } else {
        let problem = format!("the first field must be `version: {VERSION}`");
        UnplacedFault::error("version", problem).hint(format!("the file begins with `{}`", first.path))
    }
}

/// What a version calls the citation, and what it says of the other version's name.
fn citation(version: u32) -> Renamed {
    let field = "citation";
    if version < 2 {
        Renamed {
            field,
            here: "source",
            elsewhere: "citation",
            problem: "version 1 calls this field `source`".to_string(),
            hint: format!("write `version: {VERSION}` in the first line of the scenario"),
        }
    } else {
        Renamed {
            field,
            here: "citation",
            elsewhere: "source",
            problem: "from version 2 on this field is called `citation`".to_string(),
            hint: "write `citation:` in place of `source:`".to_string(),
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::scenario::{Fault, Scenario, ScenarioError, parse};

    /// A file of version 1, as the program wrote them before version 2.
    const OLD: &str = include_str!("version_1.ron");

    fn new() -> String {
        OLD.replace("version: 1", "version: 2").replace("    source: ", "    citation: ")
    }

    fn read(text: &str) -> Scenario {
        parse("old", text).unwrap_or_else(|e| panic!("{:?}", e.lines()))
    }

    /// What is said of a text, with hints.
    fn told(text: &str) -> Vec<(String, String)> {
        let one = |f: &Fault| (f.line(), f.help.clone().unwrap_or_default());
        match parse("old.ron", text) {
            Ok(_) => Vec::new(),
            Err(ScenarioError::Text(fault)) => vec![one(&fault)],
            Err(ScenarioError::Many { faults, .. }) => faults.iter().map(one).collect(),
            Err(other) => panic!("{other}"),
        }
    }

    fn lines(text: &str) -> Vec<String> {
        told(text).into_iter().map(|(line, _)| line).collect()
    }

    #[test]
    fn a_file_of_version_1_is_read_as_one_of_version_2() {
        assert_eq!(read(OLD), read(&new()));
        assert!(read(OLD).citation.starts_with("Pang 2009"));
        assert_eq!(u32::from(read(OLD).version), super::VERSION);
    }

    #[test]
    fn each_version_refuses_the_name_of_the_other() {
        let mixed = OLD.replace("version: 1", "version: 2");
        assert_eq!(
            told(&mixed),
            [(
                "old.ron:5:5: source: from version 2 on this field is called `citation`".to_string(),
                "write `citation:` in place of `source:`".to_string()
            )]
        );
        let mixed = new().replace("version: 2", "version: 1");
        assert_eq!(
            told(&mixed),
            [(
                "old.ron:5:5: citation: version 1 calls this field `source`".to_string(),
                "write `version: 2` in the first line of the scenario".to_string()
            )]
        );
    }

    #[test]
    fn other_mistakes_are_told_beside_a_wrong_name() {
        let mixed = OLD.replace("version: 1", "version: 2").replace("limit_s: 1800", "limit_s: -1800");
        let said = lines(&mixed);
        assert_eq!(said.len(), 2, "{said:?}");
        assert!(said[0].contains("called `citation`"), "{said:?}");
        assert!(said[1].contains("time.limit_s: must be > 0"), "{said:?}");
    }

    #[test]
    fn both_names_in_one_file_are_one_mistake() {
        let both = new().replace("    area: (", "    source: \"x\",\n    area: (");
        let said = lines(&both);
        assert_eq!(said.len(), 1, "{said:?}");
        assert!(said[0].contains("called `citation`"), "{said:?}");
    }

    #[test]
    fn messages_use_the_names_of_the_file_s_version() {
        let lacking = |text: &str, line: &str| {
            let line = text.lines().find(|l| l.trim_start().starts_with(line));
            told(&text.replace(line.expect("it is there"), ""))
        };
        let (old, hint) = lacking(OLD, "source:").remove(0);
        assert!(old.ends_with("the field `source` is missing"), "{old}");
        assert!(hint.starts_with("add `source: ...`"), "{hint}");
        let (new_one, _) = lacking(&new(), "citation:").remove(0);
        assert!(new_one.ends_with("the field `citation` is missing"), "{new_one}");

        let (_, hint) = told(&new().replace("    title:", "    titel:")).remove(0);
        assert!(hint.contains("title, citation, area"), "{hint}");
        let (_, hint) = told(&OLD.replace("    title:", "    titel:")).remove(0);
        assert!(hint.contains("title, source, area"), "{hint}");

        let twice = OLD.replace("    area: (", "    source: \"x\",\n    area: (");
        assert_eq!(lines(&twice), ["old.ron:7:5: the field `source` is given twice"]);
    }

    #[test]
    fn versions_that_are_not_read_are_told_before_all_else() {
        let said = lines(&OLD.replace("version: 1", "version: 3").replace("title", "titel"));
        assert_eq!(said, ["old.ron:3:5: version: this program reads versions 1 and 2, got 3"]);
    }
}
