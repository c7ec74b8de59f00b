//! Digest of a run: two runs with the same digest went through the same states, bit by bit. Beside it, the
//! fingerprint of bytes that nobody can find other bytes for.

use bevy_ecs::prelude::Resource;
use xxhash_rust::xxh3::Xxh3;

/// Running digest of every number of the state, in the order of the tick.
#[derive(Resource, Clone)]
pub struct Digest(
    // Apart, because a world of entities sets aside the room of many for each of its resources.
    Box<WordHash>,
);

#[derive(Clone)]
struct WordHash {
    hash: Xxh3,
    /// Bytes that are to be hashed together, because hashing few of them costs more than the drift.
    waiting: [u8; WAITING],
    used: usize,
}

const WAITING: usize = 1024;

impl Default for Digest {
    fn default() -> Self {
        Self(Box::new(WordHash { hash: Xxh3::new(), waiting: [0; WAITING], used: 0 }))
    }
}

impl Digest {
    /// Adds a number by its bits: less than [`Self::f64s`] for a few that come one by one.
    #[inline]
    pub fn f64(&mut self, value: f64) {
        let bytes = value.to_bits().to_le_bytes();
        let hashed = &mut *self.0;
        if hashed.used + bytes.len() > WAITING {
            hashed.hash_waiting();
        }
        hashed.waiting[hashed.used..hashed.used + bytes.len()].copy_from_slice(&bytes);
        hashed.used += bytes.len();
    }

    /// Adds numbers by their bits.
    pub fn f64s(&mut self, values: &[f64]) {
        self.0.add_words(values, |v| v.to_bits().to_le_bytes());
    }

    /// Adds single-precision numbers by their bits.
    pub fn f32s(&mut self, values: &[f32]) {
        self.0.add_words(values, |v| v.to_bits().to_le_bytes());
    }

    /// Adds text and its length.
    pub fn text(&mut self, s: &str) {
        self.bytes(&(s.len() as u64).to_le_bytes());
        self.bytes(s.as_bytes());
    }

    /// Adds bytes as they are; how they are divided into calls makes no difference.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.0.hash_waiting();
        self.0.hash.update(bytes);
    }

    /// The digest so far, 32 hexadecimal digits.
    pub fn hex(&self) -> String {
        let mut all = self.0.hash.clone();
        all.update(&self.0.waiting[..self.0.used]);
        format!("{:032x}", all.digest128())
    }
}

impl WordHash {
    fn hash_waiting(&mut self) {
        self.hash.update(&self.waiting[..self.used]);
        self.used = 0;
    }

    /// Adds words in little-endian order on every machine.
    fn add_words<T: Copy, const N: usize>(&mut self, values: &[T], bytes: impl Fn(T) -> [u8; N]) {
        for chunk in values.chunks(WAITING / N) {
            let size = chunk.len() * N;
            if self.used + size > WAITING {
                self.hash_waiting();
            }
            let places = self.waiting[self.used..self.used + size].chunks_exact_mut(N);
            for (place, v) in places.zip(chunk) {
                place.copy_from_slice(&bytes(*v));
            }
            self.used += size;
        }
    }
}

/// Running fingerprint of bytes (BLAKE3): whoever knows it cannot find other bytes that have the same one.
#[derive(Clone, Debug, Default)]
pub struct Fingerprint(blake3::Hasher);

impl Fingerprint {
    /// Adds bytes as they are; how they are divided into calls makes no difference.
    pub fn bytes(&mut self, bytes: &[u8]) {
        self.0.update(bytes);
    }

    /// Adds bytes and their length, so that what comes next cannot be taken for a part of them.
    pub fn part(&mut self, bytes: &[u8]) {
        self.0.update(&(bytes.len() as u64).to_le_bytes());
        self.0.update(bytes);
    }

    /// Adds all that can be read.
    ///
    /// # Errors
    /// If reading fails.
    pub fn read(&mut self, from: impl std::io::Read) -> std::io::Result<()> {
        self.0.update_reader(from).map(drop)
    }

    /// The fingerprint so far.
    pub fn finish(&self) -> [u8; 32] {
        *self.0.finalize().as_bytes()
    }

    /// A fingerprint as 64 hexadecimal digits.
    pub fn hex(finished: &[u8; 32]) -> String {
        blake3::Hash::from_bytes(*finished).to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_of_a_fingerprint_have_ends() {
        let of = |parts: &[&str]| {
            let mut all = Fingerprint::default();
            parts.iter().for_each(|p| all.part(p.as_bytes()));
            all.finish()
        };
        assert_ne!(of(&["ab", "c"]), of(&["a", "bc"]));
        let [mut read, mut given] = [(); 2].map(|()| Fingerprint::default());
        read.read(&b"abc"[..]).unwrap();
        given.bytes(b"a");
        given.bytes(b"bc");
        assert_eq!(read.finish(), given.finish());
        // BLAKE3's published answer for no input.
        let none = Fingerprint::hex(&Fingerprint::default().finish());
        assert!(none.starts_with("af1349b9f5f9a1a6a0404dea36dcc949"), "{none}");
    }

    #[test]
    fn cutting_the_input_does_not_matter_but_every_bit_does() {
        let values: Vec<f64> = (0..1000).map(f64::from).collect();
        let (mut whole, mut parts, mut other) = (Digest::default(), Digest::default(), Digest::default());
        whole.f64s(&values);
        values.chunks(7).for_each(|c| parts.f64s(c));
        assert_eq!(whole.hex(), parts.hex());
        // Reading it on the way changes nothing, and neither do bytes in between.
        let mut mixed = Digest::default();
        for (n, v) in values.iter().enumerate() {
            match n % 5 {
                0 => mixed.bytes(&v.to_le_bytes()),
                1 => mixed.f64s(&[*v]),
                // Also where the room for those that wait is used up.
                _ if n > 500 => mixed.f64(*v),
                _ => mixed.f32s(&[v.to_bits() as u32, (v.to_bits() >> 32) as u32].map(f32::from_bits)),
            }
            let _ = mixed.hex();
        }
        assert_eq!(whole.hex(), mixed.hex());
        let mut changed = values.clone();
        changed[999] = f64::from_bits(changed[999].to_bits() ^ 1);
        other.f64s(&changed);
        assert_ne!(whole.hex(), other.hex());
    }
}
