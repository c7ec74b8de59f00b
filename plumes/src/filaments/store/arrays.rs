//! The filaments of one source: arrays in the order of release. Their mass is accounted in f64.
//!
//! *Source*: a structure of arrays, which vector instructions need; nothing from the papers.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none. A filament that leaves the domain is removed in the sweep that moves the others. The order is
//! kept, so the oldest are always first, and each band of steps is a range. The arrays grow as needed: no filament is
//! dropped to save memory.

use super::bands::{Bands, MOST, Moment, Scales, Span, on_way};
use super::eddy_coordinates::EddyCoordinates;
use super::rise::Rise;
use super::size::Size;
use super::structure::Structure;
use std::ops::Range;

/// Arrays of one source's filaments, oldest first.
#[derive(Clone, Debug)]
pub(crate) struct Store {
    /// East, north, up at the end of the step that each filament takes, m.
    pub(crate) x: Vec<f32>,
    pub(crate) y: Vec<f32>,
    pub(crate) z: Vec<f32>,
    /// The same at the start of the step, or at its release if that was later.
    pub(crate) start: [Vec<f32>; 3],
    /// Height of the bed under each filament at the end of its step, m (negative).
    pub(crate) bed: Vec<f32>,
    /// Number in the order of release; it is the counter of the filament's noise.
    pub(crate) number: Vec<u32>,
    /// Time of release, s.
    pub(crate) born_s: Vec<f64>,
    /// The first filament of each band.
    pub(crate) first: [usize; MOST],
    /// Age from which a filament may be in each band, s.
    pub(crate) least_age_s: [f64; MOST],
    /// Time up to which eddies between walls have carried the filaments, s.
    pub(crate) carried_s: f64,
    /// What lets them rise, if they are buoyant.
    pub(crate) rise: Option<Rise>,
    /// Where they are in the patterns of small eddies, if there are any.
    pub(crate) labels: Option<EddyCoordinates>,
    /// What they hold that is finer than they are, if they have it.
    pub(crate) structure: Option<Structure>,
    /// Growth law.
    pub(crate) size: Size,
    /// Mass of each filament, kg.
    pub(crate) filament_kg: f64,
    /// Number of filaments ever released.
    pub(crate) released: u64,
    /// Number of filaments that have left the domain.
    pub(crate) left: u64,
}

impl Store {
    pub(crate) fn new(size: Size, filament_kg: f64) -> Self {
        Self {
            x: Vec::new(),
            y: Vec::new(),
            z: Vec::new(),
            start: Default::default(),
            bed: Vec::new(),
            number: Vec::new(),
            born_s: Vec::new(),
            first: [0; MOST],
            least_age_s: [f64::NEG_INFINITY; MOST],
            carried_s: 0.0,
            rise: None,
            labels: None,
            structure: None,
            size,
            filament_kg,
            released: 0,
            left: 0,
        }
    }

    /// Number of filaments, with those that are released before their band's step ends.
    pub(crate) fn len(&self) -> usize {
        self.x.len()
    }

    /// Number of filaments that are released after a time, s; they are the last ones.
    pub(crate) fn unborn(&self, now_s: f64) -> usize {
        self.born_s.iter().rev().take_while(|b| **b > now_s).count()
    }

    /// Adds the newest filament.
    pub(crate) fn push(&mut self, p: [f32; 3], bed: f32, born_s: f64) {
        self.x.push(p[0]);
        self.y.push(p[1]);
        self.z.push(p[2]);
        for (start, p) in self.start.iter_mut().zip(p) {
            start.push(p);
        }
        self.bed.push(bed);
        self.number.push(self.released as u32);
        self.born_s.push(born_s);
        if let Some(rise) = &mut self.rise {
            rise.push();
        }
        if let Some(labels) = &mut self.labels {
            labels.push(born_s);
        }
        self.released += 1;
    }

    /// The filaments of a band.
    pub(crate) fn band(&self, band: usize, bands: &Bands) -> Range<usize> {
        let end = if band < bands.last() { self.first[band + 1] } else { self.len() };
        self.first[band]..end
    }

    /// Puts all filaments into one band; they must have reached `t_s`. Their steps start where they are.
    pub(crate) fn join(&mut self, t_s: f64) {
        for (start, p) in self.start.iter_mut().zip([&self.x, &self.y, &self.z]) {
            start.clone_from(p);
        }
        self.carried_s = t_s;
        self.first = [0; MOST];
        self.least_age_s = [f64::NEG_INFINITY; MOST];
    }

    /// Takes the water's scales, by which the bands of the next longest step are chosen.
    pub(crate) fn scaled(&mut self, bands: &Bands, scales: &Scales) {
        for band in 0..bands.last() {
            self.least_age_s[band] = scales.age_s(&self.size, bands.step_s(band));
        }
        self.least_age_s[bands.last()] = f64::NEG_INFINITY;
    }

    /// Divides the filaments whose steps start now among the bands whose steps start now.
    pub(crate) fn divide(&mut self, bands: &Bands) {
        let t_s = bands.next_s();
        for band in bands.due()..bands.last() {
            let from = self.first[band];
            let least_s = self.least_age_s[band];
            let old = self.born_s[from..].partition_point(|born| t_s - born >= least_s);
            self.first[band + 1] = from + old;
        }
    }

    /// Where a filament is at a moment of its band's step: east, north, up, m. `None` if it is not released yet.
    pub(crate) fn place(&self, n: usize, moment: &Moment) -> Option<[f32; 3]> {
        let part = moment.part_gone(self.born_s[n])?;
        let ends = [&self.x, &self.y, &self.z];
        Some([0, 1, 2].map(|d| on_way(self.start[d][n], ends[d][n], part)))
    }

    /// How long each filament of a range moves within a step, or from its release on, s.
    pub(crate) fn steps_s(&self, range: Range<usize>, span: Span) -> impl Iterator<Item = f32> {
        self.born_s[range].iter().map(move |born| (span.to_s - born.max(span.from_s)) as f32)
    }

    /// The band of a filament.
    pub(crate) fn band_of(&self, n: usize, bands: &Bands) -> usize {
        (1..=bands.last()).rev().find(|b| n >= self.first[*b]).unwrap_or(0)
    }

    /// The arrays of f32: ends and beds, then starts.
    fn numbers_mut(&mut self) -> [&mut Vec<f32>; 7] {
        let [sx, sy, sz] = &mut self.start;
        let (x, y, z, bed) = (&mut self.x, &mut self.y, &mut self.z, &mut self.bed);
        [x, y, z, bed, sx, sy, sz]
    }

    /// Moves the entries of `from` down to `to`, in all arrays.
    pub(crate) fn shift(&mut self, from: Range<usize>, to: usize) {
        if from.start == to {
            return;
        }
        for v in self.numbers_mut() {
            v.copy_within(from.clone(), to);
        }
        self.number.copy_within(from.clone(), to);
        self.born_s.copy_within(from, to);
    }

    /// Forgets what is kept beside the arrays of filaments at sorted places that are being removed.
    pub(crate) fn forget(&mut self, gone: &[usize]) {
        if let Some(rise) = &mut self.rise {
            rise.remove(gone);
        }
        if let Some(labels) = &mut self.labels {
            labels.remove(gone);
        }
    }

    /// Keeps the first `n` entries; the others were moved down or have left.
    pub(crate) fn truncate(&mut self, n: usize) {
        self.left += (self.len() - n) as u64;
        for v in self.numbers_mut() {
            v.truncate(n);
        }
        self.number.truncate(n);
        self.born_s.truncate(n);
    }
}
