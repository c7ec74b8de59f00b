//! Reading. Only regular files are read, and only up to a stated size.

use std::fs::{self, File, FileType};
use std::io::{self, ErrorKind, Read};
use std::path::Path;

use crate::encoding;

/// What a special file is, in words; `None` for a regular file.
pub(super) fn special(kind: FileType) -> Option<&'static str> {
    if kind.is_file() {
        return None;
    }
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if kind.is_fifo() {
            return Some("a pipe");
        }
        if kind.is_socket() {
            return Some("a socket");
        }
        if kind.is_char_device() || kind.is_block_device() {
            return Some("a device");
        }
    }
    Some(if kind.is_dir() { "a folder" } else { "no regular file" })
}

/// Whether a special file (no regular file) stands at this path. Such a file is not ours, so it must not be replaced.
pub fn is_special(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|m| special(m.file_type()).is_some())
}

/// Opens a regular file, or the regular file that a link leads to. A pipe could block a reader for ever, and a device
/// may never end.
///
/// # Errors
/// The system's error; for a special file, what it is.
pub fn open(path: &Path) -> io::Result<File> {
    if let Some(what) = special(fs::metadata(path)?.file_type()) {
        let problem = format!("it is {what}, not a file");
        return Err(io::Error::new(ErrorKind::InvalidInput, problem));
    }
    File::open(path)
}

/// Reads a regular file of at most `most` bytes.
///
/// # Errors
/// As [`open`]; also if the file is longer.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    open(path)?.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        let problem = format!("it is longer than {} MiB", most.div_ceil(1 << 20));
        return Err(io::Error::new(ErrorKind::FileTooLarge, problem));
    }
    Ok(bytes)
}

/// Reads a text file in UTF-8 of at most `most` bytes, without the mark of its encoding.
///
/// # Errors
/// As [`read`]; also if the text is not UTF-8, with the line.
pub fn read_text(path: &Path, most: u64) -> io::Result<String> {
    encoding::text(&read(path, most)?).map_err(|why| io::Error::new(ErrorKind::InvalidData, why))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::process::Command;

    #[test]
    fn no_more_is_read_than_is_said() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("a");
        fs::write(&path, "abc\n\u{e9}").unwrap();
        assert_eq!(read(&path, 6).unwrap().len(), 6);
        assert_eq!(read(&path, 5).unwrap_err().kind(), ErrorKind::FileTooLarge);
        assert_eq!(read_text(&path, 6).unwrap(), "abc\né");
        fs::write(&path, "\u{feff}abc").unwrap();
        assert_eq!(read_text(&path, 6).unwrap(), "abc");
        fs::write(&path, b"\xff\xfea\0").unwrap();
        let said = read_text(&path, 6).unwrap_err().to_string();
        assert!(said.ends_with("save it as UTF-8"), "{said}");
        fs::write(&path, b"abc\n\xff").unwrap();
        let said = read_text(&path, 6).unwrap_err().to_string();
        assert_eq!(said, "it is not UTF-8 text: line 2, byte 4");
    }

    #[cfg(unix)]
    #[test]
    fn what_is_no_file_is_named_and_not_waited_for() {
        let dir = tempfile::tempdir().unwrap();
        let pipe = dir.path().join("pipe");
        assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
        let said = |path: &Path| read(path, 9).unwrap_err().to_string();
        assert_eq!(said(&pipe), "it is a pipe, not a file");
        assert_eq!(said(Path::new("/dev/zero")), "it is a device, not a file");
        assert_eq!(said(dir.path()), "it is a folder, not a file");
        let link = dir.path().join("link");
        std::os::unix::fs::symlink(&pipe, &link).unwrap();
        assert_eq!(said(&link), "it is a pipe, not a file");
    }
}
