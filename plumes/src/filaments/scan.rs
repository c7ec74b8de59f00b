//! Finds the members of a group near a point by looking at every one.
//!
//! *Source*: none. Vector code looks at sixteen filaments in some twenty instructions, while a tree must be made anew
//! after each of their steps, and its leaves at each time. So a tree pays only where many ask about one time.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

use super::felt::{Asked, Present};
use super::group::GROUP;
use super::leaf::LEAF;
use super::moving::{Moving, on_way};
use crate::path::Path;

const LANES: usize = 16;

/// Coordinates of the members at the start and at the end of their step.
type Ways<'a> = [[&'a [f32]; 2]; 3];

/// Which members may contribute.
struct Near {
    members: [u16; GROUP],
    count: usize,
}

/// The sum of the contributions of a group of `n`, in quanta.
pub(super) fn felt(asked: &Asked, n: usize) -> i64 {
    let Asked {
        s, from, moment, ..
    } = asked;
    // Those that are released within the step come last, each on a way of its own. Few of them are not near.
    let born_s = &s.born_s[*from..from + n];
    let late = (born_s.iter().rev()).take_while(|b| **b > moment.span.from_s);
    let on_time = n - late.count();
    let range = *from..from + on_time;
    let way = |d: usize| [&s.start[d], [&s.x, &s.y, &s.z][d]].map(|v| &v[range.clone()]);
    let ways = [way(0), way(1), way(2)];
    let mut near = Near {
        members: [0; GROUP],
        count: 0,
    };
    match asked.q.path {
        Path::Portable => look(asked, ways, &mut near),
        // SAFETY: this variant is only made after the feature was detected.
        #[cfg(target_arch = "x86_64")]
        Path::Avx2 => unsafe { look_avx2(asked, ways, &mut near) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Path::Avx512 => unsafe { look_avx512(asked, ways, &mut near) },
    }
    for m in on_time..n {
        near.members[near.count] = m as u16;
        near.count += 1;
    }
    let mut total = 0;
    for some in near.members[..near.count].chunks(LEAF) {
        let moving = Moving::new(s, asked.q.lookup, *from, some);
        total += Present::of(&moving, asked).felt(asked);
    }
    total
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn look_avx2(asked: &Asked, ways: Ways, near: &mut Near) {
    look(asked, ways, near);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512bw,avx512dq,avx512vl")]
fn look_avx512(asked: &Asked, ways: Ways, near: &mut Near) {
    look(asked, ways, near);
}

/// Notes the members within reach.
#[inline(always)]
fn look(asked: &Asked, ways: Ways, near: &mut Near) {
    let parts = ways.map(|ends| ends.map(|end| end.as_chunks::<LANES>()));
    for n in 0..parts[0][0].0.len() {
        let ends = parts.map(|ends| ends.map(|(full, _)| &full[n]));
        let found = within(asked, ends);
        near.note(n * LANES, found);
    }
    let rest = parts[0][0].1.len();
    if rest > 0 {
        let mut ends = [[[0.0; LANES]; 2]; 3];
        for (to, from) in ends.iter_mut().flatten().zip(parts.iter().flatten()) {
            to[..rest].copy_from_slice(from.1);
        }
        let found = within(asked, ends.each_ref().map(|e| e.each_ref()));
        near.note(ways[0][0].len() - rest, found & ((1 << rest) - 1));
    }
}

/// One bit for each that is within reach.
#[inline(always)]
fn within(asked: &Asked, ends: [[&[f32; LANES]; 2]; 3]) -> u32 {
    let (p, part) = (asked.p, asked.moment.part);
    let flat = asked.flat_reach();
    let mut inside = [0_u32; LANES];
    for l in 0..LANES {
        let away = |d: usize| p[d] - on_way(ends[d][0][l], ends[d][1][l], part);
        let (dx, dy, dz) = (away(0), away(1), away(2));
        let near = (dx * dx + dy * dy <= flat * flat) & (dz.abs() <= asked.reach[2]);
        inside[l] = u32::from(near) << l;
    }
    inside.into_iter().fold(0, |all, one| all | one)
}

impl Near {
    fn note(&mut self, from: usize, mut found: u32) {
        while found != 0 {
            self.members[self.count] = from as u16 + found.trailing_zeros() as u16;
            self.count += 1;
            found &= found - 1;
        }
    }
}
