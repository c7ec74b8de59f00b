//! The folder in which a command leaves its files. A list in the folder names them. The command's next run removes the
//! listed files first, so that the folder never mixes files of two runs.

use super::input::read_text;
use super::output::{Output, OutputError};
use std::collections::BTreeSet;
use std::fs;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

/// Endings of the files that a command leaves. A list that names a file with another ending is not ours.
const ENDINGS: [&str; 8] = ["csv", "html", "json", "mcap", "md", "png", "svg", "tmp"];
/// Longest list read, bytes.
const LONGEST: u64 = 16 << 20;

/// A folder with its list. Clones share the list.
#[derive(Clone, Debug)]
pub struct Folder {
    dir: PathBuf,
    removed: Arc<[String]>,
    list: Arc<Mutex<List>>,
}

#[derive(Debug)]
struct List {
    file: Output,
    names: BTreeSet<String>,
}

impl Folder {
    /// Removes the files that an earlier run of `command` listed in an existing folder, and begins a new list,
    /// `<command>-files.txt`.
    ///
    /// # Errors
    /// If the list cannot be read or made, or if a file cannot be removed.
    pub fn begin(dir: &Path, command: &str) -> Result<Self, OutputError> {
        let path = dir.join(format!("{command}-files.txt"));
        let removed = remove_listed(dir, &path)?;
        let mut file = Output::create(&path)?;
        let head = format!(
            "# What `rheotaxis {command}` left in this folder; the next time it writes here it removes these first.\n"
        );
        (file.write_all(head.as_bytes())).map_err(|e| file.failed(e))?;
        file.place()?;
        let names = BTreeSet::new();
        let list = Arc::new(Mutex::new(List { file, names }));
        Ok(Self {
            dir: dir.to_owned(),
            removed: removed.into(),
            list,
        })
    }

    /// Names of the files of an earlier run that were removed.
    #[must_use]
    pub fn removed(&self) -> &[String] {
        &self.removed
    }

    /// The folder.
    #[must_use]
    pub fn dir(&self) -> &Path {
        &self.dir
    }

    /// Enters a file into the list before it is written, and returns its path.
    ///
    /// # Errors
    /// If the list cannot be written.
    pub fn file(&self, name: &str) -> Result<PathBuf, OutputError> {
        let mut list = self.list.lock().expect("nobody panics with the list");
        if list.names.insert(name.to_string()) {
            let line = format!("{name}\n");
            let written = list.file.write_all(line.as_bytes());
            written.map_err(|e| list.file.failed(e))?;
        }
        Ok(self.dir.join(name))
    }
}

/// Removes the listed files that are regular files directly in that folder.
fn remove_listed(dir: &Path, list: &Path) -> Result<Vec<String>, OutputError> {
    let text = match read_text(list, LONGEST) {
        Ok(text) => text,
        Err(e) if e.kind() == ErrorKind::NotFound => return Ok(Vec::new()),
        Err(e) => return Err(OutputError::new(list, e)),
    };
    let mut removed = Vec::new();
    for name in text.lines().filter(|l| !l.starts_with('#')) {
        let plain = Path::new(name).file_name().is_some_and(|n| n == name);
        let ending = Path::new(name).extension().unwrap_or_default();
        if !plain || !ENDINGS.iter().any(|e| ending == *e) {
            continue;
        }
        let path = dir.join(name);
        if fs::symlink_metadata(&path).is_ok_and(|there| there.is_file()) {
            fs::remove_file(&path).map_err(|e| OutputError::new(&path, e))?;
            removed.push(name.to_string());
        }
    }
    Ok(removed)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(dir: &Path) -> BTreeSet<String> {
        let name = |e: std::io::Result<fs::DirEntry>| e.unwrap().file_name().into_string().unwrap();
        fs::read_dir(dir).unwrap().map(name).collect()
    }

    #[test]
    fn the_next_run_removes_what_the_one_before_left_and_nothing_else() {
        let dir = tempfile::tempdir().unwrap();
        let folder = Folder::begin(dir.path(), "run").unwrap();
        assert!(folder.removed().is_empty());
        for name in ["map.svg", "picture-a-0.png", "never-written.csv"] {
            let path = folder.file(name).unwrap();
            if name != "never-written.csv" {
                fs::write(path, "ours").unwrap();
            }
        }
        fs::write(dir.path().join("notes.csv"), "not ours").unwrap();
        // As if killed: the list on the disk agrees with the files.
        std::mem::forget(folder);
        let other = Folder::begin(dir.path(), "segment").unwrap();
        assert!(other.removed().is_empty(), "another command's files");
        let folder = Folder::begin(dir.path(), "run").unwrap();
        assert_eq!(folder.removed(), ["map.svg", "picture-a-0.png"]);
        folder.file("map.svg").unwrap();
        let left = ["notes.csv", "run-files.txt", "segment-files.txt"];
        assert_eq!(names(dir.path()), left.map(String::from).into());
        let folder = Folder::begin(dir.path(), "run").unwrap();
        assert!(folder.removed().is_empty());
    }

    #[test]
    fn a_list_from_elsewhere_removes_only_plain_files_of_our_kinds_in_the_folder() {
        let dir = tempfile::tempdir().unwrap();
        let out = dir.path().join("out");
        fs::create_dir_all(out.join("folder.csv")).unwrap();
        let outside = dir.path().join("outside.csv");
        for path in [
            &outside,
            &out.join("thesis.tex"),
            &out.join("run-files.txt"),
        ] {
            fs::write(path, "not ours").unwrap();
        }
        let lines = format!(
            "../outside.csv\n{}\nthesis.tex\nfolder.csv\nrun-files.txt\n..\n\n/\n",
            outside.display()
        );
        fs::write(out.join("run-files.txt"), lines).unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink(&outside, out.join("link.csv")).unwrap();
        let folder = Folder::begin(&out, "run").unwrap();
        assert_eq!(folder.removed(), Vec::<String>::new());
        assert!(outside.exists() && out.join("thesis.tex").exists());
    }
}
