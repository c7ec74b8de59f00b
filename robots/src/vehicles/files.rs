//! The files that describe a vehicle or a gantry: its URDF and the meshes beside it.
//!
//! This crate opens no file itself, so that no searcher can read the scenario. Whoever builds a vehicle hands over
//! [`Files`]; the simulation's reads the folder of the scenario file. [`InMemory`] holds the files in memory.

use super::folder::VehicleFile;
use crate::error::{RobotError, ensure};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use world::encoding;
use world::registry::{ReadError, Registry};

/// Gives the content of a file by its name. Names are relative to the scenario file, or absolute.
pub trait Files {
    /// Path of a file for messages.
    fn path(&self, name: &Path) -> PathBuf;

    /// Content of a file of at most `most_bytes`.
    ///
    /// # Errors
    /// Why it cannot be read, without its path.
    fn bytes(&self, name: &Path, most_bytes: u64) -> Result<Vec<u8>, String>;

    /// Text of a file of at most `most_bytes`.
    ///
    /// # Errors
    /// Why it cannot be read, without its path; if it is not UTF-8, with the line.
    fn text(&self, name: &Path, most_bytes: u64) -> Result<String, String> {
        encoding::text(&self.bytes(name, most_bytes)?)
    }

    /// Reads the text of a `vehicle.ron`; errors call it `path`.
    ///
    /// # Errors
    /// Its first mistake. The simulation's files tell all of them, with their places.
    fn vehicle(&self, path: &str, text: &str) -> Result<VehicleFile, RobotError> {
        let wrong = |e: ReadError| RobotError::File { path: path.into(), problem: e.message };
        Registry::default().read(text).map_err(wrong)
    }
}

/// Files held in memory, by name. A built-in vehicle needs none: use the default.
#[derive(Clone, Debug, Default)]
pub struct InMemory(pub BTreeMap<PathBuf, Vec<u8>>);

impl InMemory {
    /// The same with one more file.
    #[must_use]
    pub fn with(mut self, name: &str, content: &[u8]) -> Self {
        self.0.insert(name.into(), content.into());
        self
    }
}

impl Files for InMemory {
    fn path(&self, name: &Path) -> PathBuf {
        name.into()
    }

    fn bytes(&self, name: &Path, most_bytes: u64) -> Result<Vec<u8>, String> {
        let bytes = self.0.get(name).ok_or("there is no such file")?;
        ensure(bytes.len() as u64 <= most_bytes, || format!("it is longer than {most_bytes} bytes"))?;
        Ok(bytes.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn files_in_memory_are_found_by_name_and_within_their_length() {
        let files = InMemory::default().with("a.urdf", b"text").with("b", b"\xff");
        let a = Path::new("a.urdf");
        assert_eq!(files.text(a, 4), Ok("text".into()));
        assert_eq!(files.text(a, 3), Err("it is longer than 3 bytes".into()));
        assert_eq!(files.bytes(Path::new("c"), 9), Err("there is no such file".into()));
        let error = files.text(Path::new("b"), 9).unwrap_err();
        assert!(error.starts_with("it is not UTF-8 text: "), "{error}");
    }
}
