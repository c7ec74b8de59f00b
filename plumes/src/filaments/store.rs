//! The filaments of one source: arrays in the order of release. Their mass is accounted in f64.
//!
//! *Source*: a structure of arrays, which vector instructions need; nothing from the papers.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none. A filament that leaves the domain is removed in the sweep that moves the others. The order is
//! kept, so the oldest are always first. The arrays grow as needed: no filament is dropped to save memory.

use super::size::Size;

/// Arrays of one source's filaments, oldest first.
#[derive(Clone, Debug)]
pub(super) struct Store {
    /// East, north, up, m.
    pub(super) x: Vec<f32>,
    pub(super) y: Vec<f32>,
    pub(super) z: Vec<f32>,
    /// Height of the bed under each filament, m (negative).
    pub(super) bed: Vec<f32>,
    /// Number in the order of release; it is the counter of the filament's noise.
    pub(super) number: Vec<u32>,
    /// Time of release, s.
    pub(super) born_s: Vec<f64>,
    /// Growth law.
    pub(super) size: Size,
    /// Mass of each filament, kg.
    pub(super) filament_kg: f64,
    /// Number of filaments ever released.
    pub(super) released: u64,
    /// Number of filaments that have left the domain.
    pub(super) left: u64,
}

impl Store {
    pub(super) fn new(size: Size, filament_kg: f64) -> Self {
        Self {
            x: Vec::new(),
            y: Vec::new(),
            z: Vec::new(),
            bed: Vec::new(),
            number: Vec::new(),
            born_s: Vec::new(),
            size,
            filament_kg,
            released: 0,
            left: 0,
        }
    }

    pub(super) fn len(&self) -> usize {
        self.x.len()
    }

    /// Adds the newest filament.
    pub(super) fn push(&mut self, p: [f32; 3], bed: f32, born_s: f64) {
        self.x.push(p[0]);
        self.y.push(p[1]);
        self.z.push(p[2]);
        self.bed.push(bed);
        self.number.push(self.released as u32);
        self.born_s.push(born_s);
        self.released += 1;
    }

    /// In the two arrays that the drift does not write, moves the entries `from..from + n` down to `to`.
    pub(super) fn shift_labels(&mut self, from: usize, to: usize, n: usize) {
        self.number.copy_within(from..from + n, to);
        self.born_s.copy_within(from..from + n, to);
    }

    /// Keeps the first `n` entries; the others were moved down or have left.
    pub(super) fn truncate(&mut self, n: usize) {
        self.left += (self.len() - n) as u64;
        self.x.truncate(n);
        self.y.truncate(n);
        self.z.truncate(n);
        self.bed.truncate(n);
        self.number.truncate(n);
        self.born_s.truncate(n);
    }
}
