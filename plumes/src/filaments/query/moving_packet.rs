//! The filaments of a packet on their way through a step: where they are at a moment, over which bed, and how large.
//!
//! See `bands` for the way and `size` for the size.
//!
//! The way is straight, so where it would cut a bend of the bed, it follows the bed.

use super::packet::{PACKET, Packet};
use crate::filaments::store::arrays::Store;
use crate::filaments::store::bands::{Moment, on_way};
use crate::filaments::store::rise::widened;
use crate::filaments::store::size::Size;
use crate::filaments::water::lookup::Lookup;
use crate::flow::ground::NearGround;
use crate::simd::dispatch::InstructionSet;

/// Up to [`PACKET`] filaments, of which those released last come last, with both ends of the step that they take.
#[derive(Clone, Debug)]
pub(crate) struct MovingPacket {
    /// East, north, up.
    start: [[f32; PACKET]; 3],
    end: [[f32; PACKET]; 3],
    born_s: [f64; PACKET],
    /// Variance by which each is wider for its own entrainment, m², of a buoyant release.
    grown_m2: Option<[f32; PACKET]>,
    ground: NearGround,
    count: usize,
}

impl Default for MovingPacket {
    fn default() -> Self {
        Self {
            start: [[0.0; PACKET]; 3],
            end: [[0.0; PACKET]; 3],
            born_s: [f64::NEG_INFINITY; PACKET],
            grown_m2: None,
            ground: NearGround::default(),
            count: 0,
        }
    }
}

impl MovingPacket {
    /// Becomes these members of a group that begins at `from`. What is left in other places does not count.
    pub(crate) fn take(&mut self, s: &Store, lookup: &Lookup, from: usize, members: &[u16]) {
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
            let grown = self.grown_m2.get_or_insert([0.0; PACKET]);
            gather(grown, &rise.grown_m2, members.iter().map(at));
        }
        self.ground = lookup.ground;
    }

    /// Puts those that are released at a moment into a packet, not [sealed](Packet::seal) yet.
    pub(crate) fn fill(&self, path: InstructionSet, size: &Size, moment: &Moment, packet: &mut Packet) {
        let mut parts = [1.0; PACKET];
        // The newest filaments come last.
        let gone = self.born_s[..self.count].iter().map_while(|born| moment.part_gone(*born));
        packet.count = parts.iter_mut().zip(gone).map(|(part, gone)| *part = gone).count();
        path.run(
            #[inline(always)]
            || fill(self, &parts, size, moment.now_s, packet),
        );
    }
}

fn gather<T: Copy>(to: &mut [T; PACKET], of: &[T], members: impl Iterator<Item = usize>) {
    for (to, m) in to.iter_mut().zip(members) {
        *to = of[m];
    }
}

/// Places, beds and sizes; what is in empty places does not count.
#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "one index into many arrays is what becomes vector code")]
fn fill(m: &MovingPacket, parts: &[f32; PACKET], size: &Size, now_s: f64, packet: &mut Packet) {
    let places = [&mut packet.x, &mut packet.y, &mut packet.z];
    for (d, to) in places.into_iter().enumerate() {
        for l in 0..PACKET {
            to[l] = on_way(m.start[d][l], m.end[d][l], parts[l]);
        }
    }
    for l in 0..PACKET {
        packet.bed[l] = m.ground.z(packet.x[l], packet.y[l]);
    }
    for l in 0..PACKET {
        let (z, bed) = (packet.z[l], packet.bed[l]);
        packet.z[l] = if z > bed { z } else { bed };
    }
    for l in 0..PACKET {
        packet.h[l] = size.horizontal(now_s - m.born_s[l]);
    }
    if let Some(grown) = &m.grown_m2 {
        for l in 0..PACKET {
            packet.h[l] = widened(packet.h[l], grown[l]);
        }
    }
    for l in 0..PACKET {
        packet.v[l] = size.vertical(packet.h[l], packet.bed[l]);
    }
}
