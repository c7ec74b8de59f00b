//! The scenarios that come with the program, compiled in as text.

use std::path::{Path, PathBuf};
use world::digest::Digest;
use world::files::{self, OutputError};

/// A scenario that comes with the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Template {
    /// Its name: the file's name without its ending.
    pub name: &'static str,
    /// The text of the file.
    pub text: &'static str,
    /// The files that it refers to, with their paths relative to it.
    pub files: &'static [(&'static str, &'static [u8])],
}

impl Template {
    /// Writes the files it refers to into a temporary folder and returns that folder, or an empty path if there are
    /// none.
    ///
    /// # Errors
    /// If they cannot be written.
    pub fn unpack(&self) -> Result<PathBuf, OutputError> {
        if self.files.is_empty() {
            return Ok(PathBuf::new());
        }
        let mut digest = Digest::default();
        self.files.iter().for_each(|(path, bytes)| {
            digest.text(path);
            digest.text(&String::from_utf8_lossy(bytes));
        });
        // The folder is named after its content, so that another version of the program uses another one.
        let folder = std::env::temp_dir().join(format!("rheotaxis-{}", digest.hex()));
        for (path, bytes) in self.files {
            let to = folder.join(path);
            if !holds(&to, bytes) {
                make_parent(&to)?;
                files::write(&to, bytes)?;
            }
        }
        Ok(folder)
    }

    /// Writes the files it refers to into a folder, unless they are there already.
    ///
    /// # Errors
    /// If one cannot be written, or another file stands in its place.
    pub fn write_files(&self, folder: &Path) -> Result<(), OutputError> {
        for (path, bytes) in self.files {
            let to = folder.join(path);
            if !holds(&to, bytes) {
                make_parent(&to)?;
                files::write_new(&to, bytes)?;
            }
        }
        Ok(())
    }
}

fn holds(path: &Path, bytes: &[u8]) -> bool {
    files::read(path, bytes.len() as u64).is_ok_and(|there| there == bytes)
}

fn make_parent(path: &Path) -> Result<(), OutputError> {
    let parent = path.parent().unwrap_or(Path::new(""));
    files::make_folder(parent).map_err(|e| OutputError::new(parent, e))
}

macro_rules! catalog {
    ($($name:literal $(with $file:literal)*),* $(,)?) => {
        &[$(Template {
            name: $name,
            text: include_str!(concat!("../../catalog/", $name, ".ron")),
            files: &[$(($file, include_bytes!(concat!("../../catalog/", $file)))),*],
        }),*]
    };
}

/// All scenarios, in the order in which they are listed.
pub const CATALOG: &[Template] = catalog![
    "duck_st",
    "dalian_bay",
    "duck_external",
    "duck_mt",
    "san_clemente",
    "moth_plus",
    "duck_survey",
    "eyes_over_source",
    "moth_eyes",
    "inspect_places",
    "flume_crab",
    "flume_crab_paper",
    "flume_external",
    "uniform_channel",
    "remus_turning_circle",
    "remus_zigzag",
    "remus_dive",
    "wp_laminar",
    "wp_turbulent",
    "wp_dead_end",
    "block_in_channel",
    "four_maps",
    "harbour_3d",
    "reef_mesh" with "meshes/reef.obj",
    "mound" with "meshes/mound.asc",
    "t13_siz",
    "lauv_bay",
    "bluerov_harbour",
    "surface_lake",
    "glider_shelf",
];

/// The scenario of that name.
pub fn template(name: &str) -> Option<&'static Template> {
    CATALOG.iter().find(|t| t.name == name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::parse;

    #[test]
    fn holds_every_file_of_the_folder() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../catalog");
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
            assert_eq!(crate::scenario::check(&scenario, &t.unpack().unwrap()), [], "{}", t.name);
            assert!(!scenario.title.is_empty() && !scenario.citation.is_empty(), "{}", t.name);
        }
    }
}
