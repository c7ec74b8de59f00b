//! The filaments of a leaf on their way through a step: where they are at a moment, over which bed, and how large.
//!
//! *Source*: none; see `bands` for the way and `size` for the size.
//!
//! *Parameters*: none.
//!
//! *Deviations*: on the straight way over a bed that is not straight, a filament is raised to the bed.

use super::bands::{Moment, Span};
use super::leaf::{LEAF, Leaf};
use super::lookup::Lookup;
use super::rise::widened;
use super::size::Size;
use super::store::Store;
use crate::path::Path;

/// Up to [`LEAF`] filaments in the order of release, with both ends of the step that they take.
#[derive(Clone, Debug)]
pub(super) struct Moving {
    start: [[f32; LEAF]; 3],
    end: [[f32; LEAF]; 3],
    born_s: [f64; LEAF],
    /// Variance by which each is wider for its own entrainment, m², of a buoyant release.
    grown_m2: Option<[f32; LEAF]>,
    count: usize,
}

impl Moving {
    /// Members of a group that begins at `from`.
    pub(super) fn new(s: &Store, from: usize, members: &[u16]) -> Self {
        let mut this = Self {
            start: [[0.0; LEAF]; 3],
            end: [[0.0; LEAF]; 3],
            born_s: [f64::NEG_INFINITY; LEAF],
            grown_m2: s.rise.as_ref().map(|_| [0.0; LEAF]),
            count: members.len(),
        };
        for (l, m) in members.iter().enumerate() {
            let i = from + usize::from(*m);
            for (d, (start, end)) in s.start.iter().zip([&s.x, &s.y, &s.z]).enumerate() {
                (this.start[d][l], this.end[d][l]) = (start[i], end[i]);
            }
            this.born_s[l] = s.born_s[i];
            if let (Some(grown), Some(rise)) = (&mut this.grown_m2, &s.rise) {
                grown[l] = rise.grown_m2[i];
            }
        }
        this
    }

    /// Those that are released at a moment, not [sealed](Leaf::seal) yet.
    pub(super) fn leaf(&self, path: Path, lookup: &Lookup, size: &Size, moment: &Moment) -> Leaf {
        let mut leaf = Leaf::new();
        let Moment { span, now_s, part } = *moment;
        let mut parts = [part; LEAF];
        let mut count = self.count;
        // The newest filaments come last.
        for l in (0..self.count).rev() {
            let from_s = self.born_s[l];
            if from_s <= span.from_s {
                break;
            } else if from_s <= now_s {
                parts[l] = Span { from_s, ..span }.part(now_s);
            } else {
                count = l;
            }
        }
        leaf.count = count;
        let way = Way {
            moving: self,
            parts,
            lookup,
            size,
            now_s,
        };
        match path {
            Path::Portable => fill(&way, &mut leaf),
            // SAFETY: this variant is only made after the feature was detected.
            #[cfg(target_arch = "x86_64")]
            Path::Avx2 => unsafe { fill_avx2(&way, &mut leaf) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            Path::Avx512 => unsafe { fill_avx512(&way, &mut leaf) },
        }
        leaf
    }
}

/// What the places, beds and sizes at a moment follow from.
struct Way<'a> {
    moving: &'a Moving,
    /// The part of its way that each filament has gone.
    parts: [f32; LEAF],
    lookup: &'a Lookup,
    size: &'a Size,
    now_s: f64,
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn fill_avx2(way: &Way, leaf: &mut Leaf) {
    fill(way, leaf);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl")]
fn fill_avx512(way: &Way, leaf: &mut Leaf) {
    fill(way, leaf);
}

/// Places, beds and sizes. Empty places are those of a filament at the origin.
#[inline(always)]
#[expect(
    clippy::needless_range_loop,
    reason = "one index into many arrays is what becomes vector code"
)]
fn fill(way: &Way, leaf: &mut Leaf) {
    let Way {
        moving: m,
        parts,
        lookup,
        size,
        now_s,
    } = way;
    for (d, to) in [&mut leaf.x, &mut leaf.y, &mut leaf.z]
        .into_iter()
        .enumerate()
    {
        for l in 0..LEAF {
            let (start, end) = (m.start[d][l], m.end[d][l]);
            let on = start + parts[l] * (end - start);
            to[l] = if parts[l] < 1.0 { on } else { end };
        }
    }
    let mut at = [super::lookup::Column::default(); LEAF];
    for l in 0..LEAF {
        at[l] = lookup.column(leaf.x[l], leaf.y[l]);
    }
    for l in 0..LEAF {
        leaf.bed[l] = lookup.bed(at[l]);
    }
    for l in 0..LEAF {
        let (z, bed) = (leaf.z[l], leaf.bed[l]);
        leaf.z[l] = if z > bed { z } else { bed };
    }
    for l in 0..LEAF {
        leaf.h[l] = size.horizontal(now_s - m.born_s[l]);
    }
    if let Some(grown) = &m.grown_m2 {
        for l in 0..LEAF {
            leaf.h[l] = widened(leaf.h[l], grown[l]);
        }
    }
    for l in 0..LEAF {
        leaf.v[l] = size.vertical(leaf.h[l], leaf.bed[l]);
    }
}
