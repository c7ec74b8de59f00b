//! Reads a recording back as far as a run can be made again from it.
//!
//! A recording that broke off is read up to its last whole chunk. One that is damaged is refused: all checksums are
//! checked, and no length in it is believed before.

use ::mcap::records::{Record, op};
use ::mcap::sans_io::{LinearReadEvent, LinearReader, LinearReaderOptions};
use ::mcap::{MAGIC, McapError, parse_record};
use rheotaxis::control::{Exchange, read_consultation};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use world::files;

/// Longest recording that is read, bytes.
const LONGEST: u64 = 4 << 30;
/// Longest record or unpacked chunk of a recording, bytes: far above that of any picture.
const LONGEST_RECORD: usize = 256 << 20;
/// How often as long as its file a record can be, unpacked: LZ4 packs a byte into no less than a 255th.
const MOST_PACKED: usize = 256;
const DAMAGED: &str = "it is damaged, and what it says cannot be relied on; copy it anew from where it was made";
/// Last part of the topics with what searchers outside the program answered.
pub const CONTROL: &str = "control";

/// What a recording says of its run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RecordedRun {
    /// Name of the scenario.
    pub scenario_name: String,
    /// The scenario as written (RON).
    pub scenario_text: String,
    /// The seed's number.
    pub seed: u64,
    /// Version of the program.
    pub version: String,
    /// Digest and ticks of the run; `None` if the recording broke off.
    pub result: Option<(String, u64)>,
    /// What searchers outside the program were asked and answered.
    pub exchanges: Vec<Exchange>,
}

/// Why a recording cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file.
    #[error("cannot read {}: {why}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The system's message.
        why: String,
    },
    /// Its content.
    #[error("{} is no recording of a run: {why}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        why: String,
    },
}

/// Reads a recording.
///
/// # Errors
/// If the file cannot be read, or lacks what a run is made from.
pub fn read_recording(path: &Path) -> Result<RecordedRun, ReadError> {
    let bytes =
        files::read(path, LONGEST).map_err(|e| ReadError::File { path: path.to_owned(), why: e.to_string() })?;
    let content = |why: String| ReadError::Content { path: path.to_owned(), why };
    recorded(&bytes).map_err(content)
}

fn recorded(bytes: &[u8]) -> Result<RecordedRun, String> {
    let mut reading = Reading::default();
    each(bytes, |opcode, data| reading.take(opcode, data))?;
    let mut run = reading.run;
    run.seed = reading.seed.ok_or("it names no seed")?;
    if run.scenario_text.is_empty() {
        return Err("it holds no scenario".to_string());
    }
    Ok(run)
}

/// Hands out all records of a recording, those in chunks included, up to its end or to where it broke off: their kind
/// and their content. What has a checksum in a chunk is checked before, the rest at the end.
fn each(bytes: &[u8], mut take: impl FnMut(u8, &[u8]) -> Result<(), String>) -> Result<(), String> {
    let longest = MOST_PACKED.saturating_mul(bytes.len()).min(LONGEST_RECORD);
    let options = LinearReaderOptions::default()
        .with_skip_end_magic(true)
        .with_prevalidate_chunk_crcs(true)
        .with_validate_data_section_crc(true)
        .with_record_length_limit(longest);
    let mut reader = LinearReader::new_with_options(options);
    let mut left = bytes;
    loop {
        let need = match reader.next_event() {
            Some(Ok(LinearReadEvent::ReadRequest(need))) => need,
            Some(Ok(LinearReadEvent::Record { data, opcode })) => {
                take(opcode, data)?;
                continue;
            }
            // What follows a break is lost. In a file with its proper end, nothing is.
            Some(Err(McapError::UnexpectedEof)) if !bytes.ends_with(MAGIC) => return Ok(()),
            Some(Err(McapError::BadMagic)) => return Err(McapError::BadMagic.to_string()),
            Some(Err(e)) => return Err(format!("{DAMAGED}: {e}")),
            None => return Ok(()),
        };
        let (now, later) = left.split_at(need.min(left.len()));
        reader.insert(now.len()).copy_from_slice(now);
        reader.notify_read(now.len());
        left = later;
    }
}

/// What has been read.
#[derive(Default)]
struct Reading {
    run: RecordedRun,
    asked: BTreeSet<u16>,
    seed: Option<u64>,
}

impl Reading {
    fn take(&mut self, opcode: u8, data: &[u8]) -> Result<(), String> {
        if !matches!(opcode, op::CHANNEL | op::MESSAGE | op::METADATA | op::ATTACHMENT) {
            return Ok(());
        }
        if !is_whole(opcode, data) {
            return Err(DAMAGED.to_string());
        }
        let run = &mut self.run;
        match parse_record(opcode, data).map_err(|e| format!("{DAMAGED}: {e}"))? {
            Record::Channel(channel) if channel.topic.ends_with(&format!("/{CONTROL}")) => {
                self.asked.insert(channel.id);
            }
            Record::Message { header, data } if self.asked.contains(&header.channel_id) => {
                let told = cdr_text(&data).ok_or("an answer in it is not text")?;
                run.exchanges.push(read_consultation(told)?);
            }
            Record::Metadata(about) => match about.name.as_str() {
                "run" => {
                    let field = |name: &str| about.metadata.get(name).cloned();
                    run.scenario_name = field("scenario").unwrap_or_default();
                    run.version = field("version").unwrap_or_default();
                    self.seed = field("seed").and_then(|text| text.parse().ok());
                }
                "result" => run.result = result(&about.metadata),
                _ => {}
            },
            Record::Attachment { header, data, .. } if header.name == "scenario.ron" => {
                run.scenario_text =
                    String::from_utf8(data.into_owned()).map_err(|_| "its scenario is not UTF-8 text")?;
            }
            _ => {}
        }
        Ok(())
    }
}

/// Whether all lengths in a record stay within it. The parser of records makes room for what a length says, and panics
/// at an attachment that is too short.
fn is_whole(opcode: u8, data: &[u8]) -> bool {
    let mut left = data;
    let read = match opcode {
        op::CHANNEL => skip(&mut left, 4)
            .and_then(|()| text(&mut left))
            .and_then(|()| text(&mut left))
            .and_then(|()| table(&mut left)),
        op::METADATA => text(&mut left).and_then(|()| table(&mut left)),
        op::ATTACHMENT => skip(&mut left, 16)
            .and_then(|()| text(&mut left))
            .and_then(|()| text(&mut left))
            .and_then(|()| {
                let (length, rest) = left.split_first_chunk()?;
                left = rest;
                skip(&mut left, u64::from_le_bytes(*length))
            })
            // Its checksum.
            .and_then(|()| skip(&mut left, 4)),
        _ => Some(()),
    };
    read.is_some()
}

fn skip(left: &mut &[u8], bytes: u64) -> Option<()> {
    *left = left.get(usize::try_from(bytes).ok()?..)?;
    Some(())
}

/// Skips a text with its length.
fn text(left: &mut &[u8]) -> Option<()> {
    let (length, rest) = left.split_first_chunk()?;
    *left = rest;
    skip(left, u32::from_le_bytes(*length).into())
}

/// Skips a table of texts with its length.
fn table(left: &mut &[u8]) -> Option<()> {
    let (length, rest) = left.split_first_chunk()?;
    let mut pairs = rest.get(..u32::from_le_bytes(*length) as usize)?;
    while !pairs.is_empty() {
        text(&mut pairs)?;
        text(&mut pairs)?;
    }
    Some(())
}

fn result(fields: &BTreeMap<String, String>) -> Option<(String, u64)> {
    let steps = fields.get("steps")?.parse().ok()?;
    Some((fields.get("digest")?.clone(), steps))
}

/// The text of a `std_msgs/msg/String` in little-endian CDR.
fn cdr_text(message: &[u8]) -> Option<&str> {
    let (length, text) = message.get(4..)?.split_first_chunk::<4>()?;
    let length = u32::from_le_bytes(*length) as usize;
    // The length counts a zero at the end.
    std::str::from_utf8(text.get(..length.checked_sub(1)?)?).ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mcap::McapFile;
    use crate::ros::{MessageKind, clock};

    /// A short recording with all that is read back from one, but for answers from outside.
    fn recording() -> Vec<u8> {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("run.mcap");
        let mut f = McapFile::create(&path, "test").unwrap();
        let about = [("seed", "7"), ("scenario", "pond"), ("version", "0.2.0")];
        f.metadata("run", &about).unwrap();
        f.attach("scenario.ron", "text/plain", b"(version: 2)").unwrap();
        for t in 0..20 {
            f.write("/clock", MessageKind::Clock, t, &clock(t)).unwrap();
        }
        f.metadata("result", &[("digest", "5eed"), ("steps", "20")]).unwrap();
        f.finish().unwrap();
        std::fs::read(path).unwrap()
    }

    #[test]
    fn no_damage_passes_for_a_run_and_none_panics() {
        let good = recording();
        let whole = recorded(&good).expect("a whole one");
        assert_eq!((whole.seed, whole.scenario_text.len()), (7, 12));
        assert_eq!(whole.result, Some(("5eed".to_string(), 20)));
        for at in 0..good.len() {
            // Cut there, it is what a crash leaves: refused, or read as far as it goes.
            if let Ok(read) = recorded(&good[..at]) {
                assert_eq!(read.scenario_text, whole.scenario_text, "cut at {at}");
                assert!(read.result.is_none() || read.result == whole.result);
            }
            for flip in [1 << (at % 8), 0x80, 0xff] {
                let mut bad = good.clone();
                bad[at] ^= flip;
                // What is behind the data says nothing of the run.
                match recorded(&bad) {
                    Ok(read) => assert_eq!(read, whole, "byte {at} ^ {flip:#x}"),
                    Err(why) => assert!(!why.is_empty()),
                }
                // Damaged and cut: no panic, whatever it says.
                let _ = recorded(&bad[..(at + 40).min(bad.len())]);
            }
        }
    }

    #[test]
    fn lengths_beyond_the_record_are_not_believed() {
        assert!(!is_whole(op::ATTACHMENT, &[0; 19]));
        // The name of a table, as long as can be said.
        assert!(!is_whole(op::METADATA, &[0xff, 0xff, 0xff, 0xff, 1, 2]));
        assert!(!is_whole(op::CHANNEL, &[0, 0, 0, 0, 1, 0, 0, 0, 65, 9, 9]));
        let said = recorded(b"hello, hello").expect_err("no recording");
        assert!(said.contains("agic"), "{said}");
    }
}
