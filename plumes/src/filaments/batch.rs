//! A group of filaments at one time, for many questions about that time: sixteen neighbours in the water form a small
//! packet, and the boxes around all of these are looked at together.
//!
//! *Source*: boxes side by side as for rays in Dammertz, Hanika & Keller 2008, Comput. Graph. Forum 27, 1225; the order
//! is that of `order`.
//!
//! *Parameters*: 16 filaments in a small packet.
//!
//! *Deviations*: a box holds all points at which one of its members is felt at that time. In a plume of 10⁴ filaments,
//! 89 are felt at a point near one; the boxes of five groups are looked at, and leave 21 packets of some 300. Packets of
//! eight would leave four fifths of as many filaments, with twice as many boxes. A mirror image at the surface or at the
//! bed is worked out only if one of a packet may be felt. Below the bed, where no water is, a scan may leave out images
//! that a batch does not.

use super::boxes::{BOXES, Boxes, EMPTY, set, wider};
use super::contribution::GroupQuery;
use super::group::GROUP;
use super::image::NearWall;
use super::moving_packet::MovingPacket;
use super::packet::{CUT_SIGMAS, LANES, PACKET_64, Packet64, Whole, felt_by};
use crate::simd::dispatch::InstructionSet;

/// Filaments in a small packet.
pub(super) const PACKET_16: usize = 16;

/// Small packets in a packet of 64.
const SMALL_IN_64: usize = PACKET_64 / PACKET_16;

/// Words that tell of each small packet of a group whether it is hit.
const WORDS: usize = GROUP / PACKET_16 / BOXES;

/// A group at a time.
#[derive(Clone, Debug)]
pub(super) struct Batch {
    boxes: [Boxes; WORDS],
    packets16: Vec<Packet16>,
    /// Those that feel a wall, with the small packets in which their places have no mass.
    walled: Vec<(usize, NearWall)>,
}

/// Filaments as in a [sealed](Packet64::seal) packet; no vector of them lies across two lines of the processor's cache.
#[derive(Clone, Debug)]
#[repr(align(64))]
struct Packet16 {
    p: [[f32; PACKET_16]; 3],
    bed: [f32; PACKET_16],
    h: [f32; PACKET_16],
    v: [f32; PACKET_16],
    peak: [f32; PACKET_16],
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
        let (mut packets16, mut walled) = (Vec::with_capacity(order.len() / PACKET_16 + 2), Vec::new());
        let (mut moving, mut packet) = (MovingPacket::default(), Packet64::default());
        let open = asked.spot.room.is_open();
        for members in order.chunks(PACKET_64) {
            moving.take(asked.s, asked.q.lookup, asked.from, members);
            moving.fill(asked.q.path, &asked.s.size, &asked.moment, &mut packet);
            let mut images = [Images::NONE; SMALL_IN_64];
            let mut walls = [false; PACKET_64];
            for (n, wall) in walls.iter_mut().enumerate().take(packet.count) {
                let (of, nth) = (n / PACKET_16, packets16.len() + n / PACKET_16);
                let (p, sizes) = ([packet.x[n], packet.y[n], packet.z[n]], [packet.h[n], packet.v[n]]);
                let reach = asked.reach_of(sizes);
                for (d, ends) in ends[nth].iter_mut().enumerate() {
                    *ends = wider(*ends, [p[d] - reach[d], p[d] + reach[d]]);
                }
                images[of].add(p[2], packet.bed[n], sizes[1]);
                if !open && let Some(felt) = asked.walled(p, sizes) {
                    walled.push((nth, felt));
                    *wall = true;
                }
            }
            packet.seal(asked.q.path, asked.s.filament_kg * asked.quanta);
            for (of, images) in images.into_iter().enumerate() {
                packets16.push(Packet16::new(&packet, &walls, of * PACKET_16, images));
            }
        }
        let boxes = |word: usize| Boxes::new(ends.into_iter().skip(word * BOXES));
        Self { boxes: std::array::from_fn(boxes), packets16, walled }
    }

    /// The sum of their contributions at a point, in quanta. Those that feel a wall need to know what is `asked`.
    pub(super) fn contribution<'a>(
        &self,
        path: InstructionSet,
        p: [f32; 3],
        asked: impl FnOnce() -> GroupQuery<'a>,
    ) -> i64 {
        let mut hits = [0; WORDS];
        let total = path.run(
            #[inline(always)]
            || sum(self, p, &mut hits),
        );
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
    /// Those in a packet from a place on, without those that feel walls.
    fn new(packet: &Packet64, walls: &[bool; PACKET_64], from: usize, images: Images) -> Self {
        let of = |all: &[f32; PACKET_64]| std::array::from_fn(|l| all[from + l]);
        Self {
            p: [of(&packet.x), of(&packet.y), of(&packet.z)],
            bed: of(&packet.bed),
            h: of(&packet.h),
            v: of(&packet.v),
            peak: std::array::from_fn(|l| {
                let n = from + l;
                let here = n < packet.count && !walls[n];
                if here { packet.peak[n] } else { 0.0 }
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
        let mut felt = [0.0; PACKET_16];
        for (l, felt) in felt.iter_mut().enumerate() {
            let at = [self.p[0][l], self.p[1][l], self.p[2][l], self.bed[l]];
            let size = [self.h[l], self.v[l], self.peak[l]];
            *felt = felt_by::<SURFACE, BED, AGAIN>(at, size, p);
        }
        for from in (0..PACKET_16).step_by(LANES) {
            total.add(&felt, from);
        }
    }
}

/// The sum of the small packets that are hit, and which these are: their boxes hold the point.
#[inline(always)]
fn sum(batch: &Batch, p: [f32; 3], hits: &mut [u32; WORDS]) -> i64 {
    let mut total = Whole::default();
    let packets16 = batch.packets16.chunks(BOXES);
    for ((boxes, packets16), hits) in batch.boxes.iter().zip(packets16).zip(hits) {
        *hits = boxes.held(p);
        for hit in set(*hits) {
            packets16[hit].add(p, &mut total);
        }
    }
    total.sum()
}
