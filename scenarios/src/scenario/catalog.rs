//! The scenarios that come with the program, word for word.

/// A scenario that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Template {
    /// Its name: the file's without its ending.
    pub name: &'static str,
    /// The file.
    pub text: &'static str,
}

macro_rules! catalog {
    ($($name:literal),* $(,)?) => {
        &[$(Template { name: $name, text: include_str!(concat!("../../catalog/", $name, ".ron")) }),*]
    };
}

/// All of them, in the order of lists.
pub const CATALOG: &[Template] = catalog![
    "duck_st",
    "flume_crab",
    "uniform_channel",
    "remus_turning_circle",
    "remus_zigzag",
    "remus_dive",
];

/// The one of that name.
#[must_use]
pub fn template(name: &str) -> Option<&'static Template> {
    CATALOG.iter().find(|t| t.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::parse;
    use std::path::Path;

    #[test]
    fn holds_every_file_of_the_folder() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("catalog");
        let mut files: Vec<String> = std::fs::read_dir(folder)
            .unwrap()
            .map(|f| f.unwrap().file_name().into_string().unwrap())
            .filter_map(|f| f.strip_suffix(".ron").map(str::to_string))
            .collect();
        let mut names: Vec<&str> = CATALOG.iter().map(|t| t.name).collect();
        files.sort();
        names.sort_unstable();
        assert_eq!(files, names);
    }

    #[test]
    fn every_scenario_reads_and_checks_without_a_warning() {
        for t in CATALOG {
            let scenario = parse(t.name, t.text).unwrap_or_else(|e| panic!("{:?}", e.lines()));
            assert_eq!(
                crate::scenario::check(&scenario, Path::new("")),
                [],
                "{}",
                t.name
            );
            assert!(
                !scenario.title.is_empty() && !scenario.source.is_empty(),
                "{}",
                t.name
            );
        }
    }
}
