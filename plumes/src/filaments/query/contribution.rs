//! What a group of filaments contributes at a point, in whole quanta.
//!
//! *Source*: none. Sums of whole numbers do not depend on their order (as in reproducible summation, Demmel & Nguyen
//! 2015, IEEE Trans. Comput. 64, 2060). So a group may be searched in any way, with the same bits.
//!
//! *Parameters*: none.
//!
//! *Deviations*: a contribution is rounded to a quantum. It is 2⁻³⁰ of the peak of the group's largest filament or less,
//! unless the smallest is more than 2¹⁸ times as strong; then it is 2⁻⁴⁸ of the peak of that one.

use super::image::{NearWall, QueryPoint};
use super::moving_packet::MovingPacket;
use super::packet::{CUT_SIGMAS, MOST, Packet, peak};
use super::question::Question;
use crate::filaments::store::arrays::Store;
use crate::filaments::store::bands::Moment;

/// A question to one group.
#[derive(Clone, Copy)]
pub(crate) struct GroupQuery<'a> {
    pub(crate) p: [f32; 3],
    pub(crate) spot: &'a QueryPoint<'a>,
    pub(crate) q: &'a Question<'a>,
    pub(crate) s: &'a Store,
    pub(crate) moment: Moment,
    /// The first member.
    pub(crate) from: usize,
    /// Farthest along each axis from which a member is felt, m; in the plane, the same in all directions.
    pub(crate) reach: [f32; 3],
    /// Quanta in a kg/m³.
    pub(crate) quanta: f64,
}

/// Filaments at a time, and those that feel a wall and are therefore not in the packet.
#[derive(Clone, Debug, Default)]
pub(crate) struct PresentMembers {
    pub(crate) packet: Packet,
    pub(crate) walled: Vec<NearWall>,
}

/// The filament that contributes most at a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Strongest {
    /// Its contribution, up to a factor that is the same for all of a store.
    pub(crate) weight: f32,
    /// Its place in the store.
    pub(crate) member: usize,
    /// From its middle to the point: east, north, up, m.
    pub(crate) away_m: [f32; 3],
}

/// Quanta in the peak of the largest filament, if the smallest allows it.
const FINE: f64 = 1_073_741_824.0;

/// Quanta in a kg/m³ for filaments of `kg` between these sizes (horizontal and vertical, m): a power of two.
pub(crate) fn quanta(kg: f64, smallest: [f32; 2], largest: [f32; 2]) -> f64 {
    let [strongest, weakest] = [smallest, largest].map(|size| peak(kg, size.map(f64::from)));
    let fine = (FINE / weakest).min(f64::from(MOST) / strongest);
    // Its mantissa is that of one.
    f64::from_bits(fine.to_bits() & !((1 << 52) - 1))
}

/// Farthest along each axis from which a filament of these sizes (horizontal and vertical, m) is felt, m.
pub(crate) fn reach(q: &Question, sizes: [f32; 2]) -> [f32; 3] {
    let [flat, high] = sizes.map(|size| CUT_SIGMAS * 1.000_1 * size);
    // The kernel of a filament near a wall ends at its cut along each of two horizontal axes.
    let flat = if q.room.is_open() { flat } else { std::f32::consts::SQRT_2 * flat };
    // A filament is mirrored at the bed below it, which over a slope may be higher than the point.
    [flat, flat, high + 2.0 * q.room.steepest as f32 * flat]
}

impl GroupQuery<'_> {
    /// A filament of these sizes (m), if it feels a wall.
    pub(crate) fn walled(&self, p: [f32; 3], sizes: [f32; 2]) -> Option<NearWall> {
        let QueryPoint { room, lookup, .. } = self.spot;
        NearWall::new(room, lookup, p, sizes, self.s.filament_kg)
    }

    /// The contribution of a filament that feels a wall.
    pub(crate) fn in_quanta(&self, felt: &NearWall) -> i64 {
        (felt.add(self.spot) * self.quanta).round() as i64
    }
}

impl PresentMembers {
    /// Becomes those of a packet on its way that are released at the present time, not sealed yet.
    pub(crate) fn fill(&mut self, moving: &MovingPacket, asked: &GroupQuery) {
        moving.fill(asked.q.path, &asked.s.size, &asked.moment, &mut self.packet);
    }

    /// Takes those that feel a wall out of the packet, and seals it.
    pub(crate) fn seal(&mut self, asked: &GroupQuery) {
        let Self { packet, walled } = self;
        walled.clear();
        if !asked.spot.room.is_open() {
            packet.retain(|p, sizes| {
                let felt = asked.walled(p, sizes);
                let free = felt.is_none();
                walled.extend(felt);
                free
            });
        }
        packet.seal(asked.q.path, asked.s.filament_kg * asked.quanta);
    }

    /// Its contribution, in quanta.
    pub(crate) fn felt(&self, asked: &GroupQuery) -> i64 {
        let walled = self.walled.iter();
        let walled = walled.map(|felt| asked.in_quanta(felt));
        self.packet.concentration(asked.q.path, asked.p) + walled.sum::<i64>()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quanta_are_fine_enough_for_the_weakest_and_not_too_many_for_the_strongest() {
        for (smallest, largest) in [(0.03_f32, 0.5_f32), (0.03, 6.0), (1e-4, 2.0), (1.0, 1.0)] {
            let per = quanta(5e-6, [smallest; 2], [largest, largest.min(0.5)]);
            assert_eq!(per.to_bits() << 12, 0, "a power of two");
            let weak = peak(5e-6, [f64::from(largest), f64::from(largest.min(0.5))]) * per;
            let strong = peak(5e-6, [f64::from(smallest); 2]) * per;
            assert!(strong <= f64::from(MOST) && weak >= 2_f64.powi(6), "{weak} {strong}");
            assert!(weak >= 2_f64.powi(29) || strong >= 2_f64.powi(47));
        }
    }
}
