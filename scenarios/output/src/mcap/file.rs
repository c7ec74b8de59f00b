//! An MCAP file of ROS 2 messages, written under a temporary name and renamed when it is complete.
//!
//! *Source*: MCAP specification (mcap.dev/spec), profile `ros2`, message encoding `cdr`, schema
//! encoding `ros2msg`. Topics of other crates: message encoding `json`, schema encoding `jsonschema`.
//! *Parameters*: [`FLUSH_NS`]: chunks are closed at least this often in simulated time.
//! *Deviations*: none. A crash leaves the temporary file with every closed chunk; `mcap recover` restores its index.

use crate::ros::MessageKind;
use ::mcap::records::{MessageHeader, Metadata};
use ::mcap::{Attachment, Compression, McapError, WriteOptions, Writer};
use serde_json::Value;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::error::Error;
use std::io::{self, BufWriter};
use std::path::{Path, PathBuf};
use world::files::Output;

/// Longest simulated time that a crash can lose, ns: then a chunk is closed and passed to the system.
pub const FLUSH_NS: u64 = 5_000_000_000;

/// Why a recording failed; what was written before stays under the temporary name.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// The file cannot be made.
    #[error("cannot create the recording {}: {source}", path.display())]
    Create {
        /// The file.
        path: PathBuf,
        /// The system's message.
        source: io::Error,
    },
    /// Writing failed, most often a full disk.
    #[error("cannot write to the recording {}: {}; what was written so far stays there", path.display(), why(source))]
    Write {
        /// The file.
        path: PathBuf,
        /// What was wrong.
        source: McapError,
    },
    /// It is complete but cannot be given its name.
    #[error("cannot rename the recording {} to {}: {source}", from.display(), to.display())]
    Rename {
        /// The temporary name.
        from: PathBuf,
        /// The name it should get.
        to: PathBuf,
        /// The system's message.
        source: io::Error,
    },
}

/// What was wrong, with the system's message behind it.
fn why(error: &McapError) -> String {
    match error.source() {
        Some(cause) => format!("{error}: {cause}"),
        None => error.to_string(),
    }
}

struct Channel {
    id: u16,
    sequence: u32,
}

/// The file being written.
pub struct McapFile {
    writer: Writer<BufWriter<Output>>,
    temporary: PathBuf,
    channels: BTreeMap<String, Channel>,
    flushed_ns: u64,
}

impl McapFile {
    /// Begins the recording that will become `path`, under a temporary name.
    ///
    /// # Errors
    /// If the file cannot be made or written, or if `path` exists and is not a regular file.
    pub fn create(path: &Path, library: &str) -> Result<Self, RecordError> {
        let file = Output::create_kept(path).map_err(|e| RecordError::Create { path: e.path, source: e.source })?;
        let temporary = file.temporary().to_owned();
        let writer = WriteOptions::new()
            .profile("ros2")
            .library(library)
            .compression(Some(Compression::Lz4))
            .create(BufWriter::new(file))
            .map_err(|source| RecordError::Write { path: temporary.clone(), source })?;
        Ok(Self { writer, temporary, channels: BTreeMap::new(), flushed_ns: 0 })
    }

    /// The temporary path, until the file is complete.
    pub fn temporary(&self) -> &Path {
        &self.temporary
    }

    fn failed(&self) -> impl Fn(McapError) -> RecordError + use<> {
        let path = self.temporary.clone();
        move |source| RecordError::Write { path: path.clone(), source }
    }

    /// Writes one CDR message at a simulated time; a topic keeps its first message type.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write(&mut self, topic: &str, kind: MessageKind, t_ns: u64, cdr: &[u8]) -> Result<(), RecordError> {
        let form = |file: &mut Self| {
            let schema = kind.schema();
            file.add_channel(topic, kind.name(), ["ros2msg", "cdr"], schema.as_bytes())
        };
        self.write_as(topic, form, t_ns, cdr)
    }

    /// Writes one JSON message at a simulated time; `schema` is the JSON Schema of the topic.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn write_json(
        &mut self,
        topic: &str,
        name: &str,
        schema: impl FnOnce() -> Value,
        t_ns: u64,
        value: &Value,
    ) -> Result<(), RecordError> {
        let form = |file: &mut Self| {
            let schema = schema().to_string();
            file.add_channel(topic, name, ["jsonschema", "json"], schema.as_bytes())
        };
        self.write_as(topic, form, t_ns, value.to_string().as_bytes())
    }

    /// Adds a channel; its encodings are those of the schema and of the messages.
    fn add_channel(
        &mut self,
        topic: &str,
        schema_name: &str,
        [schema_encoding, encoding]: [&str; 2],
        schema: &[u8],
    ) -> Result<(), RecordError> {
        let failed = self.failed();
        let schema = (self.writer).add_schema(schema_name, schema_encoding, schema).map_err(&failed)?;
        let id = (self.writer).add_channel(schema, topic, encoding, &BTreeMap::new()).map_err(&failed)?;
        let channel = Channel { id, sequence: 0 };
        self.channels.insert(topic.to_owned(), channel);
        Ok(())
    }

    fn write_as(
        &mut self,
        topic: &str,
        add: impl FnOnce(&mut Self) -> Result<(), RecordError>,
        t_ns: u64,
        data: &[u8],
    ) -> Result<(), RecordError> {
        let failed = self.failed();
        if t_ns >= self.flushed_ns + FLUSH_NS {
            self.flushed_ns = t_ns;
            self.writer.flush().map_err(&failed)?;
        }
        if !self.channels.contains_key(topic) {
            add(self)?;
        }
        let channel = self.channels.get_mut(topic).expect("the channel was added just above");
        let header =
            MessageHeader { channel_id: channel.id, sequence: channel.sequence, log_time: t_ns, publish_time: t_ns };
        channel.sequence = channel.sequence.wrapping_add(1);
        self.writer.write_to_known_channel(&header, data).map_err(&failed)
    }

    /// Adds a named table of texts.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn metadata(&mut self, name: &str, entries: &[(&str, &str)]) -> Result<(), RecordError> {
        let metadata = Metadata {
            name: name.to_owned(),
            metadata: entries.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect(),
        };
        let failed = self.failed();
        self.writer.write_metadata(&metadata).map_err(failed)
    }

    /// Attaches a file.
    ///
    /// # Errors
    /// If the file cannot be written.
    pub fn attach(&mut self, name: &str, media_type: &str, data: &[u8]) -> Result<(), RecordError> {
        let attachment = Attachment {
            log_time: 0,
            create_time: 0,
            name: name.to_owned(),
            media_type: media_type.to_owned(),
            data: Cow::Borrowed(data),
        };
        let failed = self.failed();
        self.writer.attach(&attachment).map_err(failed)
    }

    /// Closes the file and gives it its name.
    ///
    /// # Errors
    /// If the file cannot be written or renamed.
    pub fn finish(mut self) -> Result<PathBuf, RecordError> {
        let failed = self.failed();
        self.writer.finish().map_err(&failed)?;
        let file = self.writer.into_inner();
        let file = (file.into_inner()).map_err(|e| failed(McapError::Io(e.into_error())))?;
        file.finish().map_err(|e| RecordError::Rename { from: self.temporary, to: e.path, source: e.source })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ros::{clock, float64};
    use std::fs;

    /// A recording in a folder of its own, and its path.
    fn begun() -> (tempfile::TempDir, std::path::PathBuf, McapFile) {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("run.mcap");
        let file = McapFile::create(&path, "test").unwrap();
        (dir, path, file)
    }

    fn messages(bytes: &[u8]) -> Vec<(String, u64)> {
        ::mcap::MessageStream::new_with_options(bytes, ::mcap::read::Options::IgnoreEndMagic.into())
            .unwrap()
            .map_while(Result::ok)
            .map(|m| (m.channel.topic.clone(), m.log_time))
            .collect()
    }

    #[test]
    fn whole_file_gets_its_name_and_keeps_everything() {
        let (_dir, path, mut f) = begun();
        f.metadata("run", &[("seed", "7")]).unwrap();
        f.attach("scenario.ron", "text/plain", b"()").unwrap();
        for k in 0..3u64 {
            let t = k * FLUSH_NS;
            f.write("/clock", MessageKind::Clock, t, &clock(t)).unwrap();
            f.write("/a/chemical", MessageKind::Float64, t, &float64(0.5)).unwrap();
        }
        assert!(!path.exists());
        let temporary = f.temporary().to_owned();
        assert_eq!(f.finish().unwrap(), path);
        let bytes = fs::read(&path).unwrap();
        assert_eq!(messages(&bytes).len(), 6);
        let summary = ::mcap::Summary::read(&bytes).unwrap().unwrap();
        assert_eq!(summary.attachment_indexes[0].name, "scenario.ron");
        assert_eq!(summary.metadata_indexes[0].name, "run");
        assert_eq!(summary.channels.len(), 2);
        assert!(!temporary.exists());
    }

    #[test]
    fn json_has_a_channel_of_its_own_form() {
        let (_dir, path, mut f) = begun();
        let (schema, value) = (serde_json::json!({"type": "object"}), serde_json::json!({"m": 2}));
        for t in [0, 1] {
            f.write_json("/own/depth", "depth", || schema.clone(), t, &value).unwrap();
        }
        f.finish().unwrap();
        let bytes = fs::read(&path).unwrap();
        let messages: Vec<_> = (::mcap::MessageStream::new(&bytes).unwrap()).map(Result::unwrap).collect();
        assert_eq!(messages.len(), 2);
        let (channel, schema) = (&messages[1].channel, messages[1].channel.schema.as_ref());
        let schema = schema.unwrap();
        let said = (channel.message_encoding.as_str(), schema.encoding.as_str());
        assert_eq!(said, ("json", "jsonschema"));
        assert_eq!((schema.name.as_str(), &*messages[1].data), ("depth", &b"{\"m\":2}"[..]));
    }

    #[test]
    fn crash_costs_at_most_the_last_chunk() {
        let (_dir, path, mut f) = begun();
        for k in 0..=20u64 {
            let t = k * FLUSH_NS / 4;
            f.write("/clock", MessageKind::Clock, t, &clock(t)).unwrap();
        }
        let temporary = f.temporary().to_owned();
        // Neither finish nor drop runs, as after a kill.
        std::mem::forget(f);
        assert!(!path.exists());
        let bytes = fs::read(temporary).unwrap();
        let last = messages(&bytes).last().unwrap().1;
        assert!(last + FLUSH_NS >= 5 * FLUSH_NS, "last message at {last} ns");
    }

    #[test]
    fn missing_folder_is_named() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("no/run.mcap");
        let said = McapFile::create(&path, "test").err().unwrap().to_string();
        assert!(said.contains("no/run.mcap"), "{said}");
    }

    #[cfg(unix)]
    #[test]
    fn a_device_in_its_place_is_refused() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().join("run.mcap");
        std::os::unix::fs::symlink("/dev/full", &path).unwrap();
        let said = McapFile::create(&path, "test").err().unwrap().to_string();
        assert!(said.contains("a link to a device"), "{said}");
        assert_eq!(fs::read_dir(dir.path()).unwrap().count(), 1);
    }
}
