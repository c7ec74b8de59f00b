//! A seal at the beginning of a block: a hash of all its bytes, checked before anything in the file is used.
//!
//! A reader of Parquet goes to the positions that the footer names, so it skips what stands between the mark at the
//! beginning of the file and the first column. The seal stands there: [`MARK`] and 32 hexadecimal digits.

use std::io::{Read, Seek, SeekFrom};
use world::digest::Digest;

/// Beginning of a seal.
const MARK: &[u8] = b"rheotaxis sealed ";
const DIGITS: usize = 32;
/// Position of the seal: behind Parquet's own mark.
const AT: usize = 4;

/// Space for a seal, to be written before everything else.
pub(super) fn room() -> Vec<u8> {
    [MARK, &[b'0'; DIGITS]].concat()
}

/// Puts the seal into its space.
pub(super) fn close(bytes: &mut [u8]) {
    let digits = AT + MARK.len();
    assert_eq!(bytes.get(AT..digits), Some(MARK), "the table was begun without room for its seal: write it first");
    let mut digest = Digest::default();
    digest.bytes(&bytes[..digits]);
    digest.bytes(&bytes[digits + DIGITS..]);
    bytes[digits..digits + DIGITS].copy_from_slice(digest.hex().as_bytes());
}

/// Reads a file in small pieces and compares it with its seal. Returns what is wrong, if anything.
///
/// # Errors
/// If it cannot be read.
pub(super) fn look(file: &mut (impl Read + Seek)) -> std::io::Result<Result<(), String>> {
    file.seek(SeekFrom::Start(0))?;
    let mut head = Vec::new();
    let digits = AT + MARK.len();
    file.take((digits + DIGITS) as u64).read_to_end(&mut head)?;
    if head.len() < digits + DIGITS || head[AT..digits] != *MARK {
        return Ok(Err("it does not begin as a block does".to_string()));
    }
    let mut digest = Digest::default();
    digest.bytes(&head[..digits]);
    let mut piece = vec![0; 1 << 16];
    loop {
        match file.read(&mut piece)? {
            0 => break,
            n => digest.bytes(&piece[..n]),
        }
    }
    let whole = digest.hex().as_bytes() == &head[digits..];
    Ok(if whole { Ok(()) } else { Err("its bytes are not those that were written (wrong hash)".to_string()) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Cursor;

    #[test]
    fn every_changed_or_missing_byte_breaks_it() {
        let mut bytes = [b"PAR1", room().as_slice(), b"columns and footer"].concat();
        close(&mut bytes);
        let of = |bytes: &[u8]| look(&mut Cursor::new(bytes)).unwrap();
        assert_eq!(of(&bytes), Ok(()));
        for k in 0..bytes.len() {
            let mut turned = bytes.clone();
            turned[k] ^= 1;
            assert!(of(&turned).is_err(), "byte {k}");
            assert!(of(&bytes[..k]).is_err(), "cut at {k}");
        }
        let said = of(b"PAR1 and something else altogether, longer than a seal").unwrap_err();
        assert!(said.contains("does not begin"), "{said}");
    }
}
