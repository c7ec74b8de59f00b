//! A group of filaments at one time, for many questions about that time: sixteen neighbours in the water form a
//! leaflet, and the boxes around all leaflets are looked at together.
//!
//! *Source*: boxes side by side as for rays in Dammertz, Hanika & Keller 2008, Comput. Graph. Forum 27, 1225; the order
//! is that of `order`.
//!
//! *Parameters*: 16 filaments in a leaflet.
//!
//! *Deviations*: a box holds all points at which one of its members is felt at that time. In a plume of 10⁴ filaments,
//! 89 are felt at a point near one; the boxes of five groups are looked at, and leave 21 leaflets of some 300. Leaflets
//! of eight would leave four fifths of as many filaments, with twice as many boxes. A mirror image at the surface or at
//! the bed is worked out only if one of a leaflet may be felt. Below the bed, where no water is, a scan may leave out
//! images that a crowd does not.

use super::boxes::{BOXES, Boxes, EMPTY, set, wider};
use super::contribution::GroupQuery;
use super::group::GROUP;
use super::image::NearWall;
use super::moving_packet::MovingPacket;
use super::packet::{CUT_SIGMAS, LANES, LEAF, Packet64, Whole, felt_by};
use crate::simd::dispatch::InstructionSet;
use crate::simd::movemask::{self, Movemask};

/// Filaments in a leaflet.
pub(super) const LEAFLET: usize = 16;

/// Leaflets in a leaf.
const PER_LEAF: usize = LEAF / LEAFLET;

/// Words that tell of each leaflet of a group whether it is hit.
const WORDS: usize = GROUP / LEAFLET / BOXES;

/// A group at a time.
#[derive(Clone, Debug)]
pub(super) struct Batch {
    boxes: [Boxes; WORDS],
    leaflets: Vec<Packet16>,
    /// Those that feel a wall, with the leaflets in which their places have no mass.
    walled: Vec<(usize, NearWall)>,
}

/// Filaments as in a [sealed](Packet64::seal) leaf; no vector of them lies across two lines of the processor's cache.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Packet16 {
    p: [[f32; LEAFLET]; 3],
    bed: [f32; LEAFLET],
    h: [f32; LEAFLET],
    v: [f32; LEAFLET],
    peak: [f32; LEAFLET],
    images: Images,
}

/// Where images of filaments at surface and bed may be felt.
#[derive(Clone, Copy, Debug)]
struct Images {
    /// Those at the surface: not deeper than this, m.
    surface: f32,
    /// Those at the bed: not higher than this, m.
    bed: f32,
    /// Greatest vertical reach, m; highest bed, m.
    reach: f32,
    highest_bed: f32,
}

impl Batch {
    /// The members of a group in an order, of which those that are released last come last.
    pub(super) fn new(asked: &GroupQuery, order: &[u16]) -> Self {
        let mut ends = [EMPTY; WORDS * BOXES];
        let (mut leaflets, mut walled) = (Vec::with_capacity(order.len() / LEAFLET + 2), Vec::new());
        let (mut moving, mut leaf) = (MovingPacket::default(), Packet64::default());
        let open = asked.spot.room.is_open();
        for members in order.chunks(LEAF) {
            moving.take(asked.s, asked.q.lookup, asked.from, members);
            moving.fill(asked.q.path, &asked.s.size, &asked.moment, &mut leaf);
            let mut images = [Images::NONE; PER_LEAF];
            let mut walls = [false; LEAF];
            for (n, wall) in walls.iter_mut().enumerate().take(leaf.count) {
                let (of, nth) = (n / LEAFLET, leaflets.len() + n / LEAFLET);
                let (p, sizes) = ([leaf.x[n], leaf.y[n], leaf.z[n]], [leaf.h[n], leaf.v[n]]);
                let reach = asked.reach_of(sizes);
                for (d, ends) in ends[nth].iter_mut().enumerate() {
                    *ends = wider(*ends, [p[d] - reach[d], p[d] + reach[d]]);
                }
                images[of].add(p[2], leaf.bed[n], sizes[1]);
                if !open && let Some(felt) = asked.walled(p, sizes) {
                    walled.push((nth, felt));
                    *wall = true;
                }
            }
            leaf.seal(asked.q.path, asked.s.filament_kg * asked.quanta);
            for (of, images) in images.into_iter().enumerate() {
                leaflets.push(Packet16::new(&leaf, &walls, of * LEAFLET, images));
            }
        }
        let boxes = |word: usize| Boxes::new(ends.into_iter().skip(word * BOXES));
        Self { boxes: std::array::from_fn(boxes), leaflets, walled }
    }

    /// The sum of their contributions at a point, in quanta. Those that feel a wall need to know what is `asked`.
    pub(super) fn contribution<'a>(
        &self,
        path: InstructionSet,
        p: [f32; 3],
        asked: impl FnOnce() -> GroupQuery<'a>,
    ) -> i64 {
        let mut hits = [0; WORDS];
        let total = match path {
            // SAFETY: these instructions are part of every machine of the target.
            InstructionSet::Portable => unsafe { sum::<movemask::Portable>(self, p, &mut hits) },
            // SAFETY: this variant is only made after the feature was detected.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx2 => unsafe { sum_avx2(self, p, &mut hits) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            InstructionSet::Avx512 => unsafe { sum_avx512(self, p, &mut hits) },
        };
        if self.walled.is_empty() || hits == [0; WORDS] {
            return total;
        }
        let asked = asked();
        let hit = |nth: usize| hits[nth / BOXES] >> (nth % BOXES) & 1 == 1;
        let walled = self.walled.iter().filter(|(nth, _)| hit(*nth));
        total + walled.map(|(_, felt)| asked.in_quanta(felt)).sum::<i64>()
    }
}

impl Images {
    /// Of no filament.
    const NONE: Self = Self { surface: f32::MIN, bed: f32::MIN, reach: 0.0, highest_bed: f32::MIN };

    /// Adds those of a filament at a height over a bed, of a vertical size, m.
    fn add(&mut self, z: f32, bed: f32, size: f32) {
        let (reach, more) = (CUT_SIGMAS * size, CUT_SIGMAS * 1.000_1 * size);
        self.surface = self.surface.max(z + more);
        self.bed = self.bed.max(2.0 * bed - z + more);
        self.reach = self.reach.max(reach);
        self.highest_bed = self.highest_bed.max(bed);
    }
}

impl Packet16 {
    /// Those in a leaf from a place on, without those that feel walls.
    fn new(leaf: &Packet64, walls: &[bool; LEAF], from: usize, images: Images) -> Self {
        let of = |all: &[f32; LEAF]| std::array::from_fn(|l| all[from + l]);
        Self {
            p: [of(&leaf.x), of(&leaf.y), of(&leaf.z)],
            bed: of(&leaf.bed),
            h: of(&leaf.h),
            v: of(&leaf.v),
            peak: std::array::from_fn(|l| {
                let n = from + l;
                let here = n < leaf.count && !walls[n];
                if here { leaf.peak[n] } else { 0.0 }
            }),
            images,
        }
    }

    /// Adds what they contribute at a point.
    #[inline(always)]
    fn add(&self, p: [f32; 3], total: &mut Whole) {
        let Images { surface, bed, reach, highest_bed } = self.images;
        match (reach > -highest_bed, -p[2] <= surface, p[2] <= bed) {
            (true, ..) => self.add_with::<true, true, true>(p, total),
            (_, true, true) => self.add_with::<true, true, false>(p, total),
            (_, true, false) => self.add_with::<true, false, false>(p, total),
            (_, false, true) => self.add_with::<false, true, false>(p, total),
            _ => self.add_with::<false, false, false>(p, total),
        }
    }

    #[inline(always)]
    fn add_with<const SURFACE: bool, const BED: bool, const AGAIN: bool>(&self, p: [f32; 3], total: &mut Whole) {
        let mut felt = [0.0; LEAFLET];
        for (l, felt) in felt.iter_mut().enumerate() {
            let at = [self.p[0][l], self.p[1][l], self.p[2][l], self.bed[l]];
            let size = [self.h[l], self.v[l], self.peak[l]];
            *felt = felt_by::<SURFACE, BED, AGAIN>(at, size, p);
        }
        for from in (0..LEAFLET).step_by(LANES) {
            total.add(&felt, from);
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn sum_avx2(crowd: &Batch, p: [f32; 3], hits: &mut [u32; WORDS]) -> i64 {
    // SAFETY: the marks need AVX2, which is this function's.
    unsafe { sum::<movemask::Avx2>(crowd, p, hits) }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl")]
fn sum_avx512(crowd: &Batch, p: [f32; 3], hits: &mut [u32; WORDS]) -> i64 {
    // SAFETY: the marks need AVX-512, which is this function's.
    unsafe { sum::<movemask::Avx512>(crowd, p, hits) }
}

/// The sum of the leaflets that are hit, and which these are: their boxes hold the point.
///
/// # Safety
/// The machine must have the instructions of `M`.
#[inline(always)]
unsafe fn sum<M: Movemask>(crowd: &Batch, p: [f32; 3], hits: &mut [u32; WORDS]) -> i64 {
    let mut total = Whole::default();
    let leaflets = crowd.leaflets.chunks(BOXES);
    for ((boxes, leaflets), hits) in crowd.boxes.iter().zip(leaflets).zip(hits) {
        // SAFETY: as the caller promises.
        *hits = unsafe { boxes.held::<M>(p) };
        for hit in set(*hits) {
            leaflets[hit].add(p, &mut total);
        }
    }
    total.sum()
}
