//! Finds the members of a group near a point by looking at every one of its runs that may be near.
//!
//! Vector code looks at sixteen filaments in some twenty instructions, while a tree must be made anew
//! after each of their steps, and its leaves at each time. So a tree pays only where many ask about one time.

use super::contribution::{GroupQuery, PresentMembers};
use super::moving_packet::MovingPacket;
use super::packet::PACKET;
use super::run_bounds::{RUN, RUNS};
use crate::filaments::store::bands::on_way;
use crate::simd::movemask::{LaneMask, bits, mark};

/// Coordinates of the members at the start and at the end of their step.
type Ways<'a> = [[&'a [f32]; 2]; 3];

/// Which members may contribute: a bit for each member of each run.
type Near = [u32; RUNS];

/// The sum of the contributions of a group of `n`, in quanta. Only these `runs` of it (a bit each) may be near.
pub(crate) fn felt(asked: &GroupQuery, n: usize, runs: u32) -> i64 {
    let GroupQuery { s, from, moment, .. } = asked;
    // Those that are released within the step come last, each on a way of its own. Few of them are not near.
    let born_s = &s.born_s[*from..from + n];
    let late = (born_s.iter().rev()).take_while(|b| **b > moment.span.from_s);
    let on_time = n - late.count();
    let range = *from..from + on_time;
    let way = |d: usize| [&s.start[d], [&s.x, &s.y, &s.z][d]].map(|v| &v[range.clone()]);
    let ways = [way(0), way(1), way(2)];
    let mut near = [0; RUNS];
    asked.q.path.run(
        #[inline(always)]
        || look(asked, &ways, runs, &mut near),
    );
    for m in on_time..n {
        near[m / RUN] |= 1 << (m % RUN);
    }
    if near.iter().all(|run| *run == 0) {
        return 0;
    }
    sum(asked, &near)
}

/// The sum of the contributions of these members, in quanta.
fn sum(asked: &GroupQuery, near: &Near) -> i64 {
    let GroupQuery { s, q, from, .. } = asked;
    let (mut moving, mut present) = (MovingPacket::default(), PresentMembers::default());
    let (mut some, mut count, mut total) = ([0; PACKET], 0, 0);
    let mut add = |some: &[u16]| {
        moving.take(s, q.lookup, *from, some);
        present.fill(&moving, asked);
        present.seal(asked);
        total += present.felt(asked);
    };
    for (run, left) in near.iter().enumerate() {
        let mut left = *left;
        while left != 0 {
            some[count] = (run * RUN) as u16 + left.trailing_zeros() as u16;
            left &= left - 1;
            count += 1;
            if count == PACKET {
                add(&some);
                count = 0;
            }
        }
    }
    if count > 0 {
        add(&some[..count]);
    }
    total
}

/// Notes the members within reach.
#[inline(always)]
fn look(asked: &GroupQuery, ways: &Ways, runs: u32, near: &mut Near) {
    let n = ways[0][0].len();
    let mut left = runs;
    while left != 0 {
        let run = left.trailing_zeros() as usize;
        left &= left - 1;
        let from = run * RUN;
        if from + RUN <= n {
            near[run] = within(asked, ways, from);
        } else if from < n {
            let mut last = [[[0.0; RUN]; 2]; 3];
            for d in 0..3 {
                for end in 0..2 {
                    last[d][end][..n - from].copy_from_slice(&ways[d][end][from..]);
                }
            }
            let [[x, x1], [y, y1], [z, z1]] = &last;
            let last = [[x, x1], [y, y1], [z, z1]].map(|ends| ends.map(|end| &end[..]));
            near[run] = within(asked, &last, 0) & ((1 << (n - from)) - 1);
        }
    }
}

/// One bit for each of a run that is within reach.
#[inline(always)]
fn within(asked: &GroupQuery, ways: &Ways, from: usize) -> u32 {
    let (p, part) = (asked.p, asked.moment.part);
    let [flat, _, high] = asked.reach;
    let [[x, x1], [y, y1], [z, z1]] = ways;
    let (x, x1) = (&x[from..from + RUN], &x1[from..from + RUN]);
    let (y, y1) = (&y[from..from + RUN], &y1[from..from + RUN]);
    let (z, z1) = (&z[from..from + RUN], &z1[from..from + RUN]);
    let mut inside: LaneMask = [0; RUN];
    for l in 0..RUN {
        let dx = p[0] - on_way(x[l], x1[l], part);
        let dy = p[1] - on_way(y[l], y1[l], part);
        let dz = p[2] - on_way(z[l], z1[l], part);
        let near = (dx * dx + dy * dy <= flat * flat) & (dz.abs() <= high);
        inside[l] = mark(near);
    }
    bits(&inside)
}
