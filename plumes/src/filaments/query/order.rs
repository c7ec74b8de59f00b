//! An order of the members of a group in which every sixteen are neighbours in the water.
//!
//! *Source*: k-d tree, Bentley 1975, Commun. ACM 18, 509, of which only the order of its leaves is kept.
//!
//! *Parameters*: none.
//!
//! *Deviations*: members are halved along their longest side, in units of the kernel's reach, so that all leaves but
//! the last are full. They are halved by where their step ends, so that the order holds for all of the step.

use super::boxes::{EMPTY, Ends, wider};
use super::packet::PACKET;

/// Members of a group by number, of those at `ends` (m, along the three axes), felt as far as `reach` (m).
pub(crate) fn order(ends: [&[f32]; 3], reach: [f32; 3]) -> Vec<u16> {
    let mut members: Vec<u32> = (0..ends[0].len() as u32).collect();
    let side = |d: usize| (ends[d].iter()).fold(EMPTY[d], |all, x| wider(all, [*x, *x]));
    let sides = [side(0), side(1), side(2)];
    halve(&mut members, &ends, &reach.map(|reach| 1.0 / reach), sides);
    members.into_iter().map(|m| m as u16).collect()
}

/// Bits of a member's number in a group.
const NUMBER: u32 = 10;

/// Halves members that lie between these `sides`. Halves are only cut where they were halved, because to find their own
/// sides takes as long as all the rest.
fn halve(members: &mut [u32], ends: &[&[f32]; 3], weight: &[f32; 3], sides: Ends) {
    let n = members.len();
    if n <= PACKET {
        return;
    }
    let long = |d: usize| (sides[d][1] - sides[d][0]) * weight[d];
    let mut d = 0;
    for other in 1..3 {
        if long(other) > long(d) {
            d = other;
        }
    }
    // Coordinate in 22 bits, number in 10 bits: plain numbers without ties are fast to select from.
    let [lo, hi] = sides[d];
    let scale = if hi > lo { 4_194_300.0 / (hi - lo) } else { 0.0 };
    for m in &mut *members {
        // Where two differ by less than the unit, one may lie just beyond the side.
        let key = ((ends[d][*m as usize] - lo) * scale).min(4_194_300.0);
        *m |= (key as u32) << NUMBER;
    }
    let half = n.div_ceil(PACKET) / 2 * PACKET;
    members.select_nth_unstable(half);
    for m in &mut *members {
        *m &= (1 << NUMBER) - 1;
    }
    let cut = ends[d][members[half] as usize];
    let (low, high) = members.split_at_mut(half);
    let (mut below, mut above) = (sides, sides);
    (below[d][1], above[d][0]) = (cut, cut);
    halve(low, ends, weight, below);
    halve(high, ends, weight, above);
}

#[cfg(test)]
mod tests {
    use super::super::run_bounds::GROUP;
    use super::*;

    #[test]
    fn every_member_has_one_place_and_packets_are_small() {
        const { assert!(GROUP <= 1 << NUMBER) };
        let mut r = world::seeds::Stream::new(5, "test", "order");
        for n in [0, 1, 8, 9, 100, 1000, GROUP] {
            let mut axis = || (0..n).map(|_| r.uniform() as f32).collect::<Vec<f32>>();
            let ends = [axis(), axis(), axis()];
            let order = order(ends.each_ref().map(|e| &e[..]), [1.0; 3]);
            let mut all = order.clone();
            all.sort_unstable();
            assert!(all.into_iter().map(usize::from).eq(0..n));
            let wide = |d: usize, some: &[u16]| {
                let on = some.iter().map(|m| ends[d][usize::from(*m)]);
                let [lo, hi] = on.fold(EMPTY[d], |all, x| wider(all, [x, x]));
                f64::from(hi - lo)
            };
            let volume = |some: &[u16]| (0..3).map(|d| wide(d, some)).product::<f64>();
            let packets: Vec<f64> = order.chunks(PACKET).map(volume).collect();
            let mean = packets.iter().sum::<f64>() / packets.len() as f64;
            assert!(n < 1000 || mean < 0.02, "{mean}");
        }
    }

    #[test]
    fn what_is_no_number_and_what_is_at_one_place_has_a_place_too() {
        for x in [f32::NAN, 2.0] {
            let ends = [x; 100];
            let mut all = order([&ends; 3], [1.0; 3]);
            all.sort_unstable();
            assert!(all.into_iter().eq(0..100));
        }
    }
}
