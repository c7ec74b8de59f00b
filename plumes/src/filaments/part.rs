//! A part of a group of filaments: halved where a question falls near, down to a leaf.
//!
//! *Source*: see `index`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

use super::image::{Felt, Spot};
use super::index::{Group, Question};
use super::leaf::{CUT_SIGMAS, LEAF, Leaf};
use super::moving::Moving;
use super::store::Store;
use std::sync::OnceLock;

/// Members of a group in the order of release, with the box that holds all of them during their step.
#[derive(Clone, Debug)]
pub(super) struct Part {
    members: Vec<u16>,
    lo: [f32; 3],
    hi: [f32; 3],
    inside: OnceLock<Inside>,
}

#[derive(Clone, Debug)]
enum Inside {
    Halves(Box<[Part; 2]>),
    Leaf(Box<LeafInStep>),
}

/// A leaf during a step.
#[derive(Clone, Debug)]
struct LeafInStep {
    moving: Moving,
    present: OnceLock<Box<Present>>,
}

/// A leaf, and the filaments that feel a wall and are therefore not in it.
#[derive(Clone, Debug)]
struct Present {
    leaf: Leaf,
    walled: Vec<Felt>,
}

/// The way of each member of a group through its step: least and greatest coordinates, with a fourth place that makes
/// them one word of the processor.
#[derive(Clone, Debug)]
pub(super) struct Boxes(Box<[[[f32; 4]; 2]]>);

impl Boxes {
    /// Of `n` members from `from` on.
    pub(super) fn new(s: &Store, from: usize, n: usize) -> Self {
        let way = |m: usize| {
            let mut ends = [[0.0; 4]; 2];
            for (d, (start, end)) in s.start.iter().zip([&s.x, &s.y, &s.z]).enumerate() {
                let (a, b) = (start[m], end[m]);
                (ends[0][d], ends[1][d]) = if a < b { (a, b) } else { (b, a) };
            }
            ends
        };
        Self((from..from + n).map(way).collect())
    }

    /// The box that holds the ways of all these members.
    fn around(&self, members: &[u16]) -> [[f32; 2]; 3] {
        // Two at a time, so that one does not wait for the other.
        let mut all = [[[f32::MAX; 4], [f32::MIN; 4]]; 2];
        for some in members.chunks(2) {
            for (m, [lo, hi]) in some.iter().zip(&mut all) {
                let [low, high] = &self.0[usize::from(*m)];
                for k in 0..4 {
                    lo[k] = if low[k] < lo[k] { low[k] } else { lo[k] };
                    hi[k] = if high[k] > hi[k] { high[k] } else { hi[k] };
                }
            }
        }
        let [a, b] = all;
        std::array::from_fn(|d| [a[0][d].min(b[0][d]), a[1][d].max(b[1][d])])
    }
}

impl Present {
    fn of(moving: &Moving, asked: &Asked) -> Self {
        let Asked { s, q, spot, .. } = asked;
        let moment = q.bands.moment(asked.band, q.now_s);
        let mut leaf = moving.leaf(q.path, spot.lookup, &s.size, &moment);
        let mut walled = Vec::new();
        if !spot.room.is_open() {
            leaf.retain(|p, sizes| {
                let felt = Felt::new(spot.room, spot.lookup, p, sizes, s.filament_kg);
                let free = felt.is_none();
                walled.extend(felt);
                free
            });
        }
        leaf.seal(q.path, s.filament_kg);
        Self { leaf, walled }
    }
}

/// A question to one group.
pub(super) struct Asked<'a> {
    pub(super) p: [f32; 3],
    pub(super) spot: &'a Spot<'a>,
    pub(super) q: &'a Question<'a>,
    pub(super) g: &'a Group,
    pub(super) s: &'a Store,
    pub(super) band: usize,
}

impl Asked<'_> {
    /// Whether the members of a leaf may contribute. Half of all leaves that are asked do not, and to see this from
    /// their horizontal places takes a fraction of the time in which a leaf is worked out.
    fn may_feel(&self, moving: &Moving) -> bool {
        if !self.spot.room.is_open() {
            return true;
        }
        let moment = self.q.bands.moment(self.band, self.q.now_s);
        let reach = CUT_SIGMAS * 1.000_1 * self.g.largest[0];
        moving.may_reach(self.q.path, self.p, &moment, reach)
    }
}

impl Part {
    fn new(boxes: &Boxes, members: Vec<u16>) -> Self {
        Self::within(boxes.around(&members), members)
    }

    /// Members whose least and greatest coordinates are known.
    pub(super) fn within(sides: [[f32; 2]; 3], members: Vec<u16>) -> Self {
        let (lo, hi) = (sides.map(|s| s[0]), sides.map(|s| s[1]));
        let inside = OnceLock::new();
        Self {
            members,
            lo,
            hi,
            inside,
        }
    }

    /// Forgets what holds only for the present time.
    pub(super) fn forget(&mut self) {
        match self.inside.get_mut() {
            Some(Inside::Halves(halves)) => halves.iter_mut().for_each(Self::forget),
            Some(Inside::Leaf(leaf)) => {
                leaf.present.take();
            }
            None => {}
        }
    }

    /// Adds the contributions of its leaves, one after the other.
    pub(super) fn add(&self, asked: &Asked, total: &mut f64) {
        // Somewhat more than the reach of any member; beyond its reach, a filament contributes nothing.
        let reach = asked.g.largest.map(|size| CUT_SIGMAS * 1.000_1 * size);
        let reach = [reach[0], reach[0], reach[1] + asked.g.steep];
        let lo = std::array::from_fn(|d| self.lo[d] - reach[d]);
        let hi = std::array::from_fn(|d| self.hi[d] + reach[d]);
        if !within(asked.p, lo, hi) {
            return;
        }
        match self.inside.get_or_init(|| self.part(asked)) {
            Inside::Halves(halves) => {
                for half in &**halves {
                    half.add(asked, total);
                }
            }
            Inside::Leaf(leaf) => {
                if leaf.present.get().is_none() && !asked.may_feel(&leaf.moving) {
                    return;
                }
                let present = || Box::new(Present::of(&leaf.moving, asked));
                let present = leaf.present.get_or_init(present);
                *total += f64::from(present.leaf.at(asked.q.path, asked.p));
                for felt in &present.walled {
                    *total += felt.add(asked.spot);
                }
            }
        }
    }

    fn part(&self, asked: &Asked) -> Inside {
        if self.members.len() <= LEAF {
            return Inside::Leaf(Box::new(LeafInStep {
                moving: Moving::new(asked.s, asked.g.from, &self.members),
                present: OnceLock::new(),
            }));
        }
        Inside::Halves(Box::new(self.halves(asked)))
    }

    /// Halves the members along their longest side (in units of the kernel's reach), so that leaves are full.
    fn halves(&self, Asked { g, s, .. }: &Asked) -> [Self; 2] {
        let n = self.members.len();
        let horizontal = g.largest[0];
        let vertical = s.size.vertical(horizontal, s.bed[g.from]);
        let weight = [1.0 / horizontal, 1.0 / horizontal, 1.0 / vertical];
        let side = |d: usize| self.hi[d] - self.lo[d];
        let mut d = 0;
        for other in 1..3 {
            if side(other) * weight[other] > side(d) * weight[d] {
                d = other;
            }
        }
        // Coordinate in 22 bits, member in 10 bits: plain numbers without ties are fast to select from.
        let (lo, side) = (self.lo[d], side(d));
        let scale = if side > 0.0 { 4_194_300.0 / side } else { 0.0 };
        let ends = [&s.x, &s.y, &s.z][d];
        let key = |m: &u16| {
            (((ends[g.from + usize::from(*m)] - lo) * scale) as u32) << 10 | u32::from(*m)
        };
        let keys: Vec<u32> = self.members.iter().map(key).collect();
        let half = n.div_ceil(LEAF) / 2 * LEAF;
        let least_high = *keys.clone().select_nth_unstable(half).1;
        let (mut low, mut high) = (Vec::with_capacity(half), Vec::with_capacity(n - half));
        for (m, key) in self.members.iter().zip(&keys) {
            let to = if *key < least_high {
                &mut low
            } else {
                &mut high
            };
            to.push(*m);
        }
        let boxes = g.boxes(s);
        [low, high].map(|members| Self::new(boxes, members))
    }
}

fn within(p: [f32; 3], lo: [f32; 3], hi: [f32; 3]) -> bool {
    (0..3).all(|d| p[d] >= lo[d] && p[d] <= hi[d])
}

/// Least and greatest value.
pub(super) fn extent(v: &[f32]) -> (f32, f32) {
    let mut lo = [f32::MAX; 8];
    let mut hi = [f32::MIN; 8];
    let mut chunks = v.chunks_exact(8);
    for c in &mut chunks {
        for l in 0..8 {
            lo[l] = if c[l] < lo[l] { c[l] } else { lo[l] };
            hi[l] = if c[l] > hi[l] { c[l] } else { hi[l] };
        }
    }
    let rest = chunks.remainder();
    (
        lo.into_iter()
            .chain(rest.iter().copied())
            .fold(f32::MAX, f32::min),
        hi.into_iter()
            .chain(rest.iter().copied())
            .fold(f32::MIN, f32::max),
    )
}
