//! Reads a recording back as far as a run can be made again from it.
//!
//! A recording that broke off is read up to its last whole chunk.

use ::mcap::read::{ChunkFlattener, Options};
use ::mcap::records::Record;
use rheotaxis::control::{Consultation, read_consultation};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use world::files;

/// Longest recording that is read, bytes.
const LONGEST: u64 = 4 << 30;
/// Last part of the topics with what searchers outside the program answered.
pub const CONTROL: &str = "control";

/// What a recording says of its run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Recorded {
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
    pub told: Vec<Consultation>,
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
pub fn read_recording(path: &Path) -> Result<Recorded, ReadError> {
    let bytes = files::read(path, LONGEST).map_err(|e| ReadError::File {
        path: path.to_owned(),
        why: e.to_string(),
    })?;
    let content = |why: String| ReadError::Content {
        path: path.to_owned(),
        why,
    };
    recorded(&bytes).map_err(content)
}

fn recorded(bytes: &[u8]) -> Result<Recorded, String> {
    let records = ChunkFlattener::new_with_options(bytes, Options::IgnoreEndMagic.into());
    let mut run = Recorded::default();
    let mut asked: BTreeSet<u16> = BTreeSet::new();
    let mut seed = None;
    for record in records.map_err(|e| e.to_string())? {
        // What follows a break is lost.
        let Ok(record) = record else {
            break;
        };
        match record {
            Record::Channel(channel) if channel.topic.ends_with(&format!("/{CONTROL}")) => {
                asked.insert(channel.id);
            }
            Record::Message { header, data } if asked.contains(&header.channel_id) => {
                let told = cdr_text(&data).ok_or("an answer in it is not text")?;
                run.told.push(read_consultation(told)?);
            }
            Record::Metadata(about) => match about.name.as_str() {
                "run" => {
                    let field = |name: &str| about.metadata.get(name).cloned();
                    run.scenario_name = field("scenario").unwrap_or_default();
                    run.version = field("version").unwrap_or_default();
                    seed = field("seed").and_then(|text| text.parse().ok());
                }
                "result" => run.result = result(&about.metadata),
                _ => {}
            },
            Record::Attachment { header, data, .. } if header.name == "scenario.ron" => {
                run.scenario_text = String::from_utf8(data.into_owned())
                    .map_err(|_| "its scenario is not UTF-8 text")?;
            }
            _ => {}
        }
    }
    run.seed = seed.ok_or("it names no seed")?;
    if run.scenario_text.is_empty() {
        return Err("it holds no scenario".to_string());
    }
    Ok(run)
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
