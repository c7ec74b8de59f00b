//! One seed for each run; from it, one stream of random numbers for each pair (entity, purpose).
//!
//! A keyed hash (BLAKE3) of the seed and the two names gives the key of a stream. So adding a sensor does not change the
//! numbers of the others, and nobody can work out one stream from the numbers of another. Seeds are public: whoever
//! knows one can make all streams of its runs. A contest that must prevent this gives its runs a secret key beside the
//! seed ([`Key::secret`]); without one only independence is promised.

use crate::bits::{Reader, Unreadable, Writer};
use crate::math;
use rand::{Rng, RngExt, SeedableRng};
use serde::{Deserialize, Serialize};
use std::fmt;

/// Under these texts BLAKE3 makes the key of a run from a secret text, and the mark by which the text is recognised.
const OF_A_RUN: &str = "rheotaxis 2026-11 the streams of a run";
const OF_A_MARK: &str = "rheotaxis 2026-11 the mark of a key";

/// The seed of a run: a public number and, if the run has one, a secret key. Where it is written, only the number is.
#[derive(Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(from = "u64", into = "u64")]
pub struct Seed {
    number: u64,
    key: Key,
}

/// The secret of a run, made from a text that only its owner knows.
#[derive(Clone, Copy, PartialEq, Eq)]
pub struct Key {
    bytes: [u8; 32],
    /// `None` without a secret.
    mark: Option<[u8; 8]>,
}

impl Key {
    /// The key of all runs without a secret.
    pub fn public() -> Self {
        Self { bytes: blake3::derive_key(OF_A_RUN, b""), mark: None }
    }

    /// The key that a secret text gives. A short or common text can be guessed: take 20 random characters or more.
    pub fn secret(text: &str) -> Self {
        let mark = blake3::derive_key(OF_A_MARK, text.as_bytes());
        Self { bytes: blake3::derive_key(OF_A_RUN, text.as_bytes()), mark: mark.first_chunk().copied() }
    }

    /// What may be written of a secret key, to tell runs under different keys apart; `None` of the public one.
    pub fn mark(&self) -> Option<String> {
        let digits = |mark: [u8; 8]| format!("{:016x}", u64::from_be_bytes(mark));
        self.mark.map(digits)
    }

    /// The seed of a number under this key.
    pub fn seed(self, number: u64) -> Seed {
        Seed { number, key: self }
    }
}

impl fmt::Debug for Key {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self.mark() {
            Some(mark) => write!(f, "Key({mark})"),
            None => write!(f, "Key(public)"),
        }
    }
}

impl Seed {
    /// The number.
    pub fn number(self) -> u64 {
        self.number
    }

    /// The key.
    pub fn key(self) -> Key {
        self.key
    }

    /// The number and, where there is a secret, the mark of its key, in words.
    pub fn describe(self) -> String {
        match self.key.mark() {
            Some(mark) => format!("{} under the key {mark}", self.number),
            None => self.number.to_string(),
        }
    }

    /// The hash of the seed and the names of an entity and a purpose.
    fn hash(self, entity: &str, purpose: &str) -> [u8; 32] {
        let mut hash = blake3::Hasher::new_keyed(&self.key.bytes);
        hash.update(&self.number.to_le_bytes());
        // With its length, so that no two pairs of names are one text.
        for name in [entity, purpose] {
            hash.update(&(name.len() as u64).to_le_bytes());
            hash.update(name.as_bytes());
        }
        *hash.finalize().as_bytes()
    }
}

impl Default for Seed {
    fn default() -> Self {
        Self::from(0)
    }
}

impl From<u64> for Seed {
    fn from(number: u64) -> Self {
        Key::public().seed(number)
    }
}

impl From<Seed> for u64 {
    fn from(seed: Seed) -> Self {
        seed.number
    }
}

impl fmt::Debug for Seed {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "Seed({}, {:?})", self.number, self.key)
    }
}

impl fmt::Display for Seed {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "{}", self.number)
    }
}

/// A portable random stream (ChaCha8). Its user holds it.
#[derive(Clone, Debug)]
pub struct Stream {
    rng: rand_chacha::ChaCha8Rng,
    spare: Option<f64>,
}

impl Stream {
    /// The stream of `entity` for `purpose` under the run's `seed`.
    pub fn new(seed: impl Into<Seed>, entity: &str, purpose: &str) -> Self {
        Self { rng: rand_chacha::ChaCha8Rng::from_seed(seed.into().hash(entity, purpose)), spare: None }
    }

    /// Uniform in [0, 1).
    pub fn uniform(&mut self) -> f64 {
        self.rng.random::<f64>()
    }

    /// The next 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.rng.next_u64()
    }

    /// Standard normal (Box–Muller over portable functions, both values used).
    pub fn normal(&mut self) -> f64 {
        if let Some(z) = self.spare.take() {
            return z;
        }
        let radius = (-2.0 * math::ln(1.0 - self.uniform())).sqrt();
        let (s, c) = math::sin_cos(std::f64::consts::TAU * self.uniform());
        self.spare = Some(radius * s);
        radius * c
    }

    /// Exponential waiting time for events of the given rate, s for a rate in 1/s.
    pub fn exponential(&mut self, rate: f64) -> f64 {
        -math::ln(1.0 - self.uniform()) / rate
    }

    /// Writes how far the stream has been used. That tells nothing of its seed.
    pub fn keep(&self, to: &mut Writer) {
        let Self { rng, spare } = self;
        to.word(rng.get_word_pos());
        to.maybe(*spare);
    }

    /// Goes to where another stream of the same seed and names was kept.
    ///
    /// # Errors
    /// If the bytes end.
    pub fn recall(&mut self, from: &mut Reader<'_>) -> Result<(), Unreadable> {
        let (position, spare) = (from.word()?, from.maybe()?);
        self.rng.set_word_pos(position);
        self.spare = spare;
        Ok(())
    }
}

/// A number for a counter-based generator, or a colour: it depends on the seed and the two names, and on nothing else.
pub fn key(seed: impl Into<Seed>, entity: &str, purpose: &str) -> u64 {
    let [a, b, c, d, e, f, g, h, ..] = seed.into().hash(entity, purpose);
    u64::from_le_bytes([a, b, c, d, e, f, g, h])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_are_repeatable_and_apart() {
        let first = |entity: &str, purpose: &str| Stream::new(7, entity, purpose).bits();
        assert_eq!(first("auv0", "lbl"), first("auv0", "lbl"));
        assert_ne!(first("auv0", "lbl"), first("auv0", "dvl"));
        assert_ne!(first("auv0", "lbl"), first("auv1", "lbl"));
        // The same letters, divided in another way.
        assert_ne!(first("auv0", "lbl"), first("auv0l", "bl"));
        assert_ne!(key(7, "auv0", "lbl"), key(8, "auv0", "lbl"));
    }

    #[test]
    fn a_secret_key_gives_other_numbers_and_is_never_shown() {
        let secret = Key::secret("correct horse battery staple");
        let [open, keyed] = [Seed::from(7), secret.seed(7)];
        assert_ne!(key(open, "auv0", "lbl"), key(keyed, "auv0", "lbl"));
        assert_ne!(open, keyed);
        assert_eq!((open.key().mark(), keyed.number()), (None, 7));
        assert_ne!(secret.mark(), Key::secret("another").mark());
        let shown = format!("{keyed:?} {keyed} {}", serde_json::to_string(&keyed).unwrap());
        let bytes: String = secret.bytes.iter().map(|b| format!("{b:02x}")).collect();
        assert!(!shown.contains(&bytes[..16]) && !shown.contains("horse"), "{shown}");
    }

    /// Known answer, so that a change of the hash, of its texts or of the generator cannot go unseen.
    #[test]
    fn the_numbers_of_a_seed_stay() {
        let mut stream = Stream::new(1, "auv0", "lbl");
        assert_eq!(
            [key(1, "auv0", "lbl"), stream.bits(), stream.bits()],
            [13124532052829722062, 12648757074421929392, 4532425916095895845]
        );
    }

    #[test]
    fn a_stream_goes_on_where_it_was_kept() {
        // Up to the middle of a block of the generator, with and without a normal to spare.
        for draws in [0, 1, 7, 40] {
            let mut stream = Stream::new(1, "auv0", "lbl");
            for _ in 0..draws {
                stream.normal();
            }
            let mut kept = Writer::default();
            stream.keep(&mut kept);
            let mut fresh = Stream::new(1, "auv0", "lbl");
            fresh.recall(&mut Reader::new(&kept.into_bytes())).unwrap();
            let next = |s: &mut Stream| (s.normal().to_bits(), s.normal().to_bits(), s.bits());
            assert_eq!(next(&mut fresh), next(&mut stream), "{draws}");
        }
    }

    #[test]
    fn normals_have_unit_variance() {
        let mut s = Stream::new(1, "test", "normal");
        let n = 100_000;
        let (mut m, mut v) = (0.0, 0.0);
        for _ in 0..n {
            let z = s.normal();
            m += z;
            v += z * z;
        }
        // 5 standard errors: 5/√n for the mean, 5·√(2/n) for the variance.
        assert!((m / n as f64).abs() < 0.016);
        assert!((v / n as f64 - 1.0).abs() < 0.0224);
    }
}
