//! A group of filaments at one time, for many questions about that time: sixteen neighbours in the water form a packet,
//! and the boxes around all of these are looked at together.
//!
//! *Source*: boxes side by side as for rays in Dammertz, Hanika & Keller 2008, Comput. Graph. Forum 27, 1225; the order
//! is that of `order`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: a box holds all points at which one of its members is felt at that time. In a plume of 10⁴ filaments,
//! 89 are felt at a point near one; the boxes of five groups are looked at, and leave 21 packets of some 300. Packets of
//! eight would leave four fifths of as many filaments, with twice as many boxes.

use super::boxes::{BOXES, Boxes, EMPTY, set, wider};
use super::contribution::{GroupQuery, PresentMembers, reach};
use super::image::NearWall;
use super::moving_packet::MovingPacket;
use super::packet::{PACKET, Packet, Whole};
use super::run_bounds::GROUP;
use crate::simd::dispatch::InstructionSet;

/// Words that tell of each packet of a group whether it is hit.
const WORDS: usize = GROUP / PACKET / BOXES;

/// A group at a time.
#[derive(Clone, Debug)]
pub(crate) struct Batch {
    boxes: [Boxes; WORDS],
    packets: Vec<Packet>,
    /// Those that feel a wall and are in no packet, with the numbers of the packets that they would be in.
    walled: Vec<(usize, NearWall)>,
}

impl Batch {
    /// The members of a group in an order, of which those that are released last come last.
    pub(crate) fn new(asked: &GroupQuery, order: &[u16]) -> Self {
        let mut ends = [EMPTY; WORDS * BOXES];
        let (mut packets, mut walled) = (Vec::with_capacity(order.len().div_ceil(PACKET)), Vec::new());
        let (mut moving, mut present) = (MovingPacket::default(), PresentMembers::default());
        for (nth, members) in order.chunks(PACKET).enumerate() {
            moving.take(asked.s, asked.q.lookup, asked.from, members);
            present.fill(&moving, asked);
            let Packet { x, y, z, h, v, count, .. } = &present.packet;
            for n in 0..*count {
                let (p, reach) = ([x[n], y[n], z[n]], reach(asked.q, [h[n], v[n]]));
                for (d, ends) in ends[nth].iter_mut().enumerate() {
                    *ends = wider(*ends, [p[d] - reach[d], p[d] + reach[d]]);
                }
            }
            present.seal(asked);
            walled.extend(present.walled.drain(..).map(|felt| (nth, felt)));
            packets.push(present.packet.clone());
        }
        let boxes = |word: usize| Boxes::new(ends.into_iter().skip(word * BOXES));
        Self { boxes: std::array::from_fn(boxes), packets, walled }
    }

    /// The sum of their contributions at a point, in quanta. Those that feel a wall need to know what is `asked`.
    pub(crate) fn contribution<'a>(
        &self,
        path: InstructionSet,
        p: [f32; 3],
        asked: impl FnOnce() -> GroupQuery<'a>,
    ) -> i64 {
        let (mut hits, mut total) = ([0; WORDS], Whole::default());
        path.run(
            #[inline(always)]
            || sum(self, p, &mut hits, &mut total),
        );
        let total = total.sum();
        if self.walled.is_empty() || hits == [0; WORDS] {
            return total;
        }
        let asked = asked();
        let hit = |nth: usize| hits[nth / BOXES] >> (nth % BOXES) & 1 == 1;
        let walled = self.walled.iter().filter(|(nth, _)| hit(*nth));
        total + walled.map(|(_, felt)| asked.in_quanta(felt)).sum::<i64>()
    }
}

/// The sum of the packets that are hit, and which these are: their boxes hold the point.
#[inline(always)]
fn sum(batch: &Batch, p: [f32; 3], hits: &mut [u32; WORDS], total: &mut Whole) {
    for ((boxes, packets), hits) in batch.boxes.iter().zip(batch.packets.chunks(BOXES)).zip(hits) {
        *hits = boxes.held(p);
        for hit in set(*hits) {
            packets[hit].add(p, total);
        }
    }
}
