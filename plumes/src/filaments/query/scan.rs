//! Finds the members of a group near a point by looking at every one of its runs that may be near.
//!
//! Vector code looks at sixteen filaments in some twenty instructions, while a tree must be made anew
//! after each of their steps, and its leaves at each time. So a tree pays only where many ask about one time.

use super::contribution::{GroupQuery, PresentMembers, Strongest};
use super::moving_packet::MovingPacket;
use super::packet::{PACKET, Packet, falling};
use super::run_bounds::{RUN, RUNS};
use crate::filaments::store::bands::on_way;
use crate::simd::movemask::{LaneMask, bits, mark};

/// Coordinates of the members at the start and at the end of their step.
type Ways<'a> = [[&'a [f32]; 2]; 3];

/// Which members may contribute: a bit for each member of each run.
type Near = [u32; RUNS];

/// The sum of the contributions of a group of `n`, in quanta. Only these `runs` of it (a bit each) may be near.
pub(crate) fn felt(asked: &GroupQuery, n: usize, runs: u32) -> i64 {
    let near = near(asked, n, runs);
    if near == [0; RUNS] {
        return 0;
    }
    let (mut moving, mut present, mut total) = (MovingPacket::default(), PresentMembers::default(), 0);
    each_packet(&near, |some| {
        moving.take(asked.s, asked.q.lookup, asked.from, some);
        present.fill(&moving, asked);
        present.seal(asked);
        total += present.felt(asked);
    });
    total
}

/// Which member of a group of `n` contributes most, if it is more than the strongest so far. Images do not count.
pub(crate) fn strongest(asked: &GroupQuery, n: usize, runs: u32, so_far: &mut Option<Strongest>) {
    let (mut moving, mut packet) = (MovingPacket::default(), Packet::default());
    each_packet(&near(asked, n, runs), |some| {
        moving.take(asked.s, asked.q.lookup, asked.from, some);
        moving.fill(asked.q.path, &asked.s.size, &asked.moment, &mut packet);
        for (l, m) in some.iter().enumerate().take(packet.count) {
            let away = [packet.x[l], packet.y[l], packet.z[l]];
            let away: [f32; 3] = std::array::from_fn(|d| asked.p[d] - away[d]);
            let [east, north, up] = away.map(|way| way * way);
            let (h, v) = (packet.h[l] * packet.h[l], packet.v[l] * packet.v[l]);
            let weight = falling((east + north) / (16.0 * h) + up / (16.0 * v)) / (h * packet.v[l]);
            if weight > so_far.as_ref().map_or(0.0, |so_far| so_far.weight) {
                *so_far = Some(Strongest { weight, member: asked.from + usize::from(*m), away_m: away });
            }
        }
    });
}

/// The members within reach.
fn near(asked: &GroupQuery, n: usize, runs: u32) -> Near {
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
    near
}

/// Gives the members in packets, in their order.
fn each_packet(near: &Near, mut give: impl FnMut(&[u16])) {
    let (mut some, mut count) = ([0; PACKET], 0);
    for (run, left) in near.iter().enumerate() {
        let mut left = *left;
        while left != 0 {
            some[count] = (run * RUN) as u16 + left.trailing_zeros() as u16;
            left &= left - 1;
            count += 1;
            if count == PACKET {
                give(&some);
                count = 0;
            }
        }
    }
    if count > 0 {
        give(&some[..count]);
    }
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
