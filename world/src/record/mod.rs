//! What remains of a run: the digest of its whole state sequence, and the recording.

mod digest;

pub use digest::Digest;
