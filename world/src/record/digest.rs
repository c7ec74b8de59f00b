//! Digest of the state sequence: two runs with the same digest went through the same states, bit by bit.

use bevy_ecs::prelude::Resource;
use xxhash_rust::xxh3::Xxh3;

/// Running digest over every number that makes up the state, in the order of the tick.
#[derive(Resource, Clone)]
pub struct Digest {
    hash: Xxh3,
}

impl Default for Digest {
    fn default() -> Self {
        Self { hash: Xxh3::new() }
    }
}

impl Digest {
    /// Takes in numbers by their bits.
    pub fn f64s(&mut self, values: &[f64]) {
        for v in values {
            self.hash.update(&v.to_bits().to_le_bytes());
        }
    }

    /// Takes in single-precision numbers by their bits.
    pub fn f32s(&mut self, values: &[f32]) {
        for v in values {
            self.hash.update(&v.to_bits().to_le_bytes());
        }
    }

    /// Takes in text, with its length.
    pub fn text(&mut self, s: &str) {
        self.hash.update(&(s.len() as u64).to_le_bytes());
        self.hash.update(s.as_bytes());
    }

    /// The digest so far, 32 hexadecimal digits.
    #[must_use]
    pub fn hex(&self) -> String {
        format!("{:032x}", self.hash.digest128())
    }
}
