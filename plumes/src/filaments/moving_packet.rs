//! The filaments of a packet on their way through a step: where they are at a moment, over which bed, and how large.
//!
//! See `bands` for the way and `size` for the size.
//!
//! The way is straight, so where it would cut a bend of the bed, it follows the bed.

use super::bands::{Moment, Span};
use super::lookup::Lookup;
use super::packet::{LANES, PACKET_64, Packet64, eights};
use super::rise::widened;
use super::size::Size;
use super::store::Store;
use crate::flow::ground::NearGround;
use crate::simd::dispatch::InstructionSet;

/// Up to [`PACKET_64`] filaments in the order of release, with both ends of the step that they take.
#[derive(Clone, Debug)]
pub(super) struct MovingPacket {
    /// East, north, up.
    start: [[f32; PACKET_64]; 3],
    end: [[f32; PACKET_64]; 3],
    born_s: [f64; PACKET_64],
    /// Variance by which each is wider for its own entrainment, m², of a buoyant release.
    grown_m2: Option<[f32; PACKET_64]>,
    ground: NearGround,
    count: usize,
}

impl Default for MovingPacket {
    fn default() -> Self {
        Self {
            start: [[0.0; PACKET_64]; 3],
            end: [[0.0; PACKET_64]; 3],
            born_s: [f64::NEG_INFINITY; PACKET_64],
            grown_m2: None,
            ground: NearGround::default(),
            count: 0,
        }
    }
}

impl MovingPacket {
    /// Becomes these members of a group that begins at `from`. What is left in other places does not count.
    pub(super) fn take(&mut self, s: &Store, lookup: &Lookup, from: usize, members: &[u16]) {
        self.count = members.len();
        let at = |m: &u16| from + usize::from(*m);
        let ends = [&s.x, &s.y, &s.z];
        for (to, of) in self.start.iter_mut().zip(&s.start) {
            gather(to, of, members.iter().map(at));
        }
        for (to, of) in self.end.iter_mut().zip(ends) {
            gather(to, of, members.iter().map(at));
        }
        gather(&mut self.born_s, &s.born_s, members.iter().map(at));
        if let Some(rise) = &s.rise {
            let grown = self.grown_m2.get_or_insert([0.0; PACKET_64]);
            gather(grown, &rise.grown_m2, members.iter().map(at));
        }
        self.ground = lookup.ground;
    }

    /// The part of its way that each has gone at a moment, and how many are released.
    fn parts(&self, moment: &Moment) -> ([f32; PACKET_64], usize) {
        let Moment { span, now_s, part } = *moment;
        let mut parts = [part; PACKET_64];
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
        (parts, count)
    }

    /// Puts those that are released at a moment into a packet, not [sealed](Packet64::seal) yet.
    pub(super) fn fill(&self, path: InstructionSet, size: &Size, moment: &Moment, packet: &mut Packet64) {
        let (parts, count) = self.parts(moment);
        packet.count = count;
        let way = MotionInputs { moving: self, parts, size, now_s: moment.now_s };
        path.run(
            #[inline(always)]
            || fill(&way, packet),
        );
    }
}

fn gather<T: Copy>(to: &mut [T; PACKET_64], of: &[T], members: impl Iterator<Item = usize>) {
    for (to, m) in to.iter_mut().zip(members) {
        *to = of[m];
    }
}

/// What the places, beds and sizes at a moment follow from.
struct MotionInputs<'a> {
    moving: &'a MovingPacket,
    /// The part of its way that each filament has gone.
    parts: [f32; PACKET_64],
    size: &'a Size,
    now_s: f64,
}

/// A coordinate when a part of the way is gone.
#[inline(always)]
pub(super) fn on_way(start: f32, end: f32, part: f32) -> f32 {
    let on = start + part * (end - start);
    if part < 1.0 { on } else { end }
}

/// Places, beds and sizes, eight at a time; what is in empty places does not count.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "one index into many arrays is what becomes vector code")]
fn fill(way: &MotionInputs, packet: &mut Packet64) {
    let MotionInputs { moving: m, parts, size, now_s } = way;
    for from in eights(packet.count) {
        let places = [&mut packet.x, &mut packet.y, &mut packet.z];
        for (d, to) in places.into_iter().enumerate() {
            for l in from..from + LANES {
                to[l] = on_way(m.start[d][l], m.end[d][l], parts[l]);
            }
        }
        for l in from..from + LANES {
            packet.bed[l] = m.ground.z(packet.x[l], packet.y[l]);
        }
        for l in from..from + LANES {
            let (z, bed) = (packet.z[l], packet.bed[l]);
            packet.z[l] = if z > bed { z } else { bed };
        }
        for l in from..from + LANES {
            packet.h[l] = size.horizontal(now_s - m.born_s[l]);
        }
        if let Some(grown) = &m.grown_m2 {
            for l in from..from + LANES {
                packet.h[l] = widened(packet.h[l], grown[l]);
            }
        }
        for l in from..from + LANES {
            packet.v[l] = size.vertical(packet.h[l], packet.bed[l]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::ground::Ground;
    use crate::release::ReleaseSpec;
    use nalgebra::Vector2;
    use world::terrain::Terrain;

    /// A packet on its way from one place to another, the last filaments released within the step.
    fn moving() -> MovingPacket {
        let mut new = MovingPacket {
            ground: Ground::new(&Terrain::Level { depth_m: 5.0 }).near(Vector2::zeros()),
            count: 30,
            ..MovingPacket::default()
        };
        for l in 0..30 {
            let a = l as f32;
            new.start = add(new.start, l, [400.0 + 0.3 * a, -200.0 - 0.2 * a, -3.0]);
            new.end = add(new.end, l, [403.0 + 0.25 * a, -202.0, -3.5]);
            new.born_s[l] = if l < 27 { -60.0 + f64::from(l as u16) } else { 1.0 + 0.5 * (l - 27) as f64 };
        }
        new
    }

    fn add(mut to: [[f32; PACKET_64]; 3], l: usize, p: [f32; 3]) -> [[f32; PACKET_64]; 3] {
        for (axis, v) in to.iter_mut().zip(p) {
            axis[l] = v;
        }
        to
    }

    #[test]
    fn all_that_are_released_are_on_their_ways() {
        let (moving, size) = (moving(), Size::new(&ReleaseSpec::default()));
        let (from_s, to_s) = (0.0, 4.0);
        let span = Span { from_s, to_s };
        for (now_s, released) in [(0.0, 27), (1.2, 28), (2.5, 30), (4.0, 30)] {
            let part = span.part(now_s);
            let moment = Moment { span, now_s, part };
            for path in InstructionSet::all() {
                let mut packet = Packet64::default();
                moving.fill(path, &size, &moment, &mut packet);
                assert_eq!(packet.count, released, "{path:?} at {now_s}");
                for l in 0..released {
                    let from_s = moving.born_s[l].max(0.0);
                    let part = Span { from_s, to_s }.part(now_s);
                    let on = |d: usize| on_way(moving.start[d][l], moving.end[d][l], part);
                    assert_eq!([packet.x[l], packet.y[l], packet.z[l]], [on(0), on(1), on(2)]);
                    assert_eq!(packet.h[l], size.horizontal(now_s - moving.born_s[l]));
                }
            }
        }
    }
}
