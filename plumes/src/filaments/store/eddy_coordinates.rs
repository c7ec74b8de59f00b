//! Where filaments are in the patterns of small eddies.
//!
//! *Source*: see `flow::eddies::small`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: a coordinate is the filament's place when the pattern began, moved on by the small eddies alone: that
//! is where the water that is now at the filament would be if only they had moved it. A filament that is released later
//! takes it from the water that passes the source. Kicks by what is smaller than the finest octave do not change it.

use super::rows::Rows;
use crate::flow::eddies::{Life, Small};
use nalgebra::Vector3;
use world::bits::{Reader, Unreadable, Writer};
use world::fields::Flow;

/// Coordinates in the patterns of the filaments of a store, one row a filament.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct EddyCoordinates {
    patterns: usize,
    /// East, north, up, m.
    at: Rows<[f32; 3]>,
    /// The number of the pattern in which each coordinate is.
    number: Rows<u32>,
    /// The same of the water at the source at a time, and its velocity without the small eddies, m/s.
    source: Vec<[f32; 3]>,
    source_number: Vec<u32>,
    since_s: f64,
    source_m_s: [f32; 3],
}

/// No pattern has this number.
const NONE: u32 = u32::MAX;

impl EddyCoordinates {
    pub(crate) fn new(small: &Small) -> Self {
        let patterns = small.patterns();
        Self {
            patterns,
            at: Rows::default(),
            number: Rows::default(),
            source: vec![[0.0; 3]; patterns],
            source_number: vec![NONE; patterns],
            since_s: 0.0,
            source_m_s: [0.0; 3],
        }
    }

    /// Adds the newest filament, released at a time.
    pub(crate) fn push(&mut self, born_s: f64) {
        let passed = (born_s - self.since_s) as f32;
        let u = self.source_m_s;
        let at = |p: &[f32; 3]| std::array::from_fn(|d| p[d] - passed * u[d]);
        self.at.extend(self.source.iter().map(at));
        self.number.extend(self.source_number.iter().copied());
    }

    /// Removes rows by their sorted places.
    pub(crate) fn remove(&mut self, gone: &[usize]) {
        self.at.remove(gone, self.patterns);
        self.number.remove(gone, self.patterns);
    }

    /// A filament has moved upwards through the water, m.
    pub(crate) fn lift(&mut self, n: usize, way_m: f32) {
        for at in self.present_row(n) {
            at[2] += way_m;
        }
    }

    /// The row of a filament.
    #[inline(always)]
    pub(crate) fn present_row(&mut self, n: usize) -> &mut [[f32; 3]] {
        &mut self.at[n * self.patterns..(n + 1) * self.patterns]
    }

    /// Lets every filament begin where it is, as if all patterns began now.
    #[cfg(test)]
    pub(crate) fn begin(&mut self) {
        self.number.fill(NONE);
    }

    /// Writes all of it.
    pub(crate) fn keep(&self, to: &mut Writer) {
        let Self { patterns: _, at, number, source, source_number, since_s, source_m_s } = self;
        to.write_list(at.as_flattened());
        to.write_list(number);
        to.write_list(source.as_flattened());
        to.write_list(source_number);
        to.word(*since_s);
        to.write_list(source_m_s);
    }

    /// Reads what [`Self::keep`] wrote of so many filaments.
    pub(crate) fn recall(&mut self, n: usize, from: &mut Reader<'_>) -> Result<(), Unreadable> {
        let places = |flat: Vec<f32>| -> Vec<[f32; 3]> { flat.chunks_exact(3).map(|p| [p[0], p[1], p[2]]).collect() };
        self.at = places(from.exactly(3 * n * self.patterns)?).into();
        self.number = from.exactly(n * self.patterns)?.into();
        self.source = places(from.exactly(3 * self.patterns)?);
        self.source_number = from.exactly(self.patterns)?;
        self.since_s = from.word()?;
        let u: Vec<f32> = from.exactly(3)?;
        self.source_m_s = [u[0], u[1], u[2]];
        Ok(())
    }

    /// Brings the coordinates of the water at the source to a time.
    pub(crate) fn pass_source(
        &mut self,
        small: &Small,
        flow: &dyn Flow,
        (p_W, local): (Vector3<f64>, [f32; 3]),
        t_s: f64,
    ) {
        let u = flow.velocity(&p_W, t_s).map(|v| v as f32);
        let passed = (t_s - self.since_s) as f32;
        for ((at, number), life) in (self.source.iter_mut().zip(&mut self.source_number)).zip(small.lives(t_s)) {
            if *number == life.number {
                for d in 0..3 {
                    at[d] -= passed * u[d];
                }
            } else {
                *number = life.number;
                *at = std::array::from_fn(|d| local[d] - life.age_s * u[d]);
            }
        }
        (self.since_s, self.source_m_s) = (t_s, u.into());
    }

    /// The row of a filament at a place, begun anew for the patterns that have begun meanwhile.
    pub(crate) fn row(&mut self, n: usize, place: [f32; 3], lives: &[Life]) -> &mut [[f32; 3]] {
        let range = n * self.patterns..(n + 1) * self.patterns;
        let row = &mut self.at[range.clone()];
        for ((at, number), life) in row.iter_mut().zip(&mut self.number[range]).zip(lives) {
            if *number != life.number {
                (*at, *number) = (place, life.number);
            }
        }
        row
    }
}
