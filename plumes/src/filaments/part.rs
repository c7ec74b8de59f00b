//! A part of a group of filaments: halved where a question falls near, down to a leaf.
//!
//! *Source*: k-d tree, Bentley 1975, Commun. ACM 18, 509, as bounding boxes of leaves.
//!
//! *Parameters*: 32 filaments in a leaf.
//!
//! *Deviations*: a half is halved only where a question falls near.

use super::felt::{Asked, Present};
use super::leaf::LEAF;
use super::moving::Moving;
use super::store::Store;
use std::ops::Range;
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

/// The way of each member of a group through its step: least and greatest coordinates, with a fourth place that makes
/// them one word of the processor.
#[derive(Clone, Debug)]
struct Boxes(Box<[[[f32; 4]; 2]]>);

impl Boxes {
    /// Of `n` members from `from` on.
    fn new(s: &Store, members: Range<usize>) -> Self {
        let way = |m: usize| {
            let mut ends = [[0.0; 4]; 2];
            for (d, (start, end)) in s.start.iter().zip([&s.x, &s.y, &s.z]).enumerate() {
                let (a, b) = (start[m], end[m]);
                (ends[0][d], ends[1][d]) = if a < b { (a, b) } else { (b, a) };
            }
            ends
        };
        Self(members.map(way).collect())
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

/// The members of a group, halved repeatedly.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    boxes: Boxes,
    whole: Part,
}

impl Tree {
    /// Of these members of a store.
    pub(super) fn new(s: &Store, members: Range<usize>) -> Self {
        let all: Vec<u16> = (0..members.len() as u16).collect();
        let boxes = Boxes::new(s, members);
        let whole = Part::new(&boxes, all);
        Self { boxes, whole }
    }

    /// Forgets what holds only for the present time.
    pub(super) fn forget(&mut self) {
        self.whole.forget();
    }

    /// The sum of the contributions of its leaves, in quanta.
    pub(super) fn felt(&self, asked: &Asked) -> i64 {
        let mut total = 0;
        self.whole.add(asked, &self.boxes, &mut total);
        total
    }
}

impl Part {
    fn new(boxes: &Boxes, members: Vec<u16>) -> Self {
        let sides = boxes.around(&members);
        Self {
            members,
            lo: sides.map(|s| s[0]),
            hi: sides.map(|s| s[1]),
            inside: OnceLock::new(),
        }
    }

    /// Forgets what holds only for the present time.
    fn forget(&mut self) {
        match self.inside.get_mut() {
            Some(Inside::Halves(halves)) => halves.iter_mut().for_each(Self::forget),
            Some(Inside::Leaf(leaf)) => {
                leaf.present.take();
            }
            None => {}
        }
    }

    /// Adds the contributions of its leaves.
    fn add(&self, asked: &Asked, boxes: &Boxes, total: &mut i64) {
        let near = |d: usize| {
            let (p, reach) = (asked.p[d], asked.reach[d]);
            p >= self.lo[d] - reach && p <= self.hi[d] + reach
        };
        if !(near(0) && near(1) && near(2)) {
            return;
        }
        match self.inside.get_or_init(|| self.part(asked, boxes)) {
            Inside::Halves(halves) => {
                for half in &**halves {
                    half.add(asked, boxes, total);
                }
            }
            Inside::Leaf(leaf) => *total += leaf.felt(asked),
        }
    }

    fn part(&self, asked: &Asked, boxes: &Boxes) -> Inside {
        if self.members.len() <= LEAF {
            let mut leaf = Box::new(LeafInStep {
                moving: Moving::default(),
                present: OnceLock::new(),
            });
            leaf.moving
                .take(asked.s, asked.q.lookup, asked.from, &self.members);
            return Inside::Leaf(leaf);
        }
        Inside::Halves(Box::new(self.halves(asked, boxes)))
    }

    /// Halves the members along their longest side (in units of the kernel's reach), so that leaves are full.
    fn halves(&self, asked: &Asked, boxes: &Boxes) -> [Self; 2] {
        let Asked { s, from, .. } = *asked;
        let n = self.members.len();
        let weight = asked.reach.map(|reach| 1.0 / reach);
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
        let key =
            |m: &u16| (((ends[from + usize::from(*m)] - lo) * scale) as u32) << 10 | u32::from(*m);
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
        [low, high].map(|members| Self::new(boxes, members))
    }
}

impl LeafInStep {
    fn felt(&self, asked: &Asked) -> i64 {
        let present = match self.present.get() {
            Some(present) => present,
            // Half of all leaves that are asked do not contribute, and to see this from their horizontal places takes
            // a fraction of the time in which a leaf is worked out.
            None if !asked.may_feel(&self.moving) => return 0,
            None => self.present.get_or_init(|| {
                let mut present = Box::new(Present::default());
                present.work_out(&self.moving, asked);
                present
            }),
        };
        present.felt(asked)
    }
}
