//! Finds the filaments that contribute at a point: groups in the order of release, divided into leaves where needed.
//!
//! *Source*: k-d tree, Bentley 1975, Commun. ACM 18, 509, as bounding boxes of leaves.
//!
//! *Parameters*: 1024 filaments in a group, 32 in a leaf; speed in `benches/filaments.rs`.
//!
//! *Deviations*: neighbours in the order of release are neighbours in the water. So a group needs only its bounds and
//! no sorting, and most groups are never near a robot. A group is halved repeatedly, but only where a question falls
//! near a half. Answers do not depend on earlier questions, so a viewer that asks too changes nothing.

use super::image::{Felt, Spot};
use super::kernel::Path;
pub use super::leaf::CUT_SIGMAS;
use super::leaf::{LEAF, Leaf};
use super::lookup::Lookup;
use super::room::Room;
use super::store::Store;
use super::thread;
use nalgebra::Vector3;
use std::sync::OnceLock;

/// Most filaments in a group.
const GROUP: usize = 1024;

/// All groups of all stores at one time.
#[derive(Clone, Debug)]
pub(super) struct Index {
    groups: Vec<Group>,
    now_s: f64,
    /// Longest reach of any filament, m.
    reach: f64,
}

#[derive(Clone, Debug)]
struct Group {
    store: usize,
    from: usize,
    n: usize,
    lo: [f32; 3],
    hi: [f32; 3],
    /// Sizes of the oldest member, which is the largest: horizontal, and vertical at any place.
    largest: [f32; 2],
    /// Additional vertical reach over a steep bed, m.
    steep: f32,
    whole: OnceLock<Part>,
}

/// Members of a group in the order of release, with their bounding box. Divided when first asked near it.
#[derive(Clone, Debug)]
struct Part {
    members: Vec<u16>,
    at: [Vec<f32>; 3],
    lo: [f32; 3],
    hi: [f32; 3],
    inside: OnceLock<Inside>,
}

#[derive(Clone, Debug)]
enum Inside {
    Halves(Box<[Part; 2]>),
    Leaf(Box<Bounded>),
}

/// A leaf with its bounds, and the filaments that feel a wall and are therefore not in the leaf.
#[derive(Clone, Debug)]
struct Bounded {
    leaf: Leaf,
    walled: Vec<Felt>,
    lo: [f32; 3],
    hi: [f32; 3],
}

impl Index {
    /// Builds the index. `steepest` is the slope of bed and solids: over a steep slope, a filament near a wall is felt
    /// over a larger range of heights. 0 without walls.
    pub(super) fn new(stores: &[Store], now_s: f64, steepest: f32) -> Self {
        let mut groups = Vec::new();
        let mut farthest = 0.0_f64;
        for (store, s) in stores.iter().enumerate().filter(|(_, s)| !s.size.shares()) {
            for from in (0..s.len()).step_by(GROUP) {
                let n = GROUP.min(s.len() - from);
                // The first is the oldest, and so the largest.
                let horizontal = s.size.horizontal(now_s - s.born_s[from]);
                let reach = CUT_SIGMAS * 1.000_01 * horizontal;
                farthest = farthest.max(f64::from(reach));
                let (mut lo, mut hi) = ([0.0; 3], [0.0; 3]);
                for (d, v) in [&s.x, &s.y, &s.z].into_iter().enumerate() {
                    let (low, high) = extent(&v[from..from + n]);
                    (lo[d], hi[d]) = (low - reach, high + reach);
                }
                let steep = 2.0 * steepest * reach;
                (lo[2], hi[2]) = (lo[2] - steep, hi[2] + steep);
                groups.push(Group {
                    store,
                    from,
                    n,
                    lo,
                    hi,
                    largest: [horizontal, s.size.vertical(horizontal, f32::MIN)],
                    steep,
                    whole: OnceLock::new(),
                });
            }
        }
        for s in stores.iter().filter(|s| s.size.shares()) {
            let largest = s.born_s.first().map(|b| s.size.horizontal(now_s - b));
            farthest = farthest.max(f64::from(CUT_SIGMAS * 1.000_01 * largest.unwrap_or(0.0)));
        }
        Self {
            groups,
            now_s,
            reach: farthest,
        }
    }

    /// Concentration at a point, kg/m³; zero above the surface. In a solid it is that of the nearest water.
    pub(super) fn at(
        &self,
        stores: &[Store],
        room: &Room,
        lookup: &Lookup,
        path: Path,
        p: &Vector3<f64>,
    ) -> f64 {
        let p = [p.x as f32, p.y as f32, p.z as f32];
        if p[2] > 0.0 {
            return 0.0;
        }
        let Some(query) = Spot::new(room, lookup, p, self.reach) else {
            return 0.0;
        };
        let p = query.p;
        let mut total = 0.0;
        for s in stores.iter().filter(|s| s.size.shares()) {
            total += thread::at(s, self.now_s, path, &query);
        }
        for g in &self.groups {
            if within(p, g.lo, g.hi) {
                let s = &stores[g.store];
                let mut felt = 0.0;
                g.whole.get_or_init(|| g.whole(s)).add(
                    &Asked {
                        p,
                        query: &query,
                        path,
                        g,
                        s,
                    },
                    self.now_s,
                    &mut felt,
                );
                total += felt;
            }
        }
        total
    }
}

/// A question, and the data that answer it.
struct Asked<'a> {
    p: [f32; 3],
    query: &'a Spot<'a>,
    path: Path,
    g: &'a Group,
    s: &'a Store,
}

impl Group {
    fn whole(&self, s: &Store) -> Part {
        let of = |v: &[f32]| v[self.from..self.from + self.n].to_vec();
        let members = (0..self.n as u16).collect();
        Part::new(members, [of(&s.x), of(&s.y), of(&s.z)])
    }
}

impl Part {
    fn new(members: Vec<u16>, at: [Vec<f32>; 3]) -> Self {
        let (mut lo, mut hi) = ([0.0; 3], [0.0; 3]);
        for (d, v) in at.iter().enumerate() {
            (lo[d], hi[d]) = extent(v);
        }
        Self {
            members,
            at,
            lo,
            hi,
            inside: OnceLock::new(),
        }
    }

    /// Adds the contributions of its leaves, one after the other.
    fn add(&self, asked: &Asked, now_s: f64, total: &mut f64) {
        // More than the leaves' own bounds, which decide.
        let reach = asked.g.largest.map(|size| CUT_SIGMAS * 1.000_1 * size);
        let reach = [reach[0], reach[0], reach[1] + asked.g.steep];
        let lo = std::array::from_fn(|d| self.lo[d] - reach[d]);
        let hi = std::array::from_fn(|d| self.hi[d] + reach[d]);
        if !within(asked.p, lo, hi) {
            return;
        }
        match self.inside.get_or_init(|| self.part(asked, now_s)) {
            Inside::Halves(halves) => {
                for half in &**halves {
                    half.add(asked, now_s, total);
                }
            }
            Inside::Leaf(b) => {
                if within(asked.p, b.lo, b.hi) {
                    *total += f64::from(b.leaf.at(asked.path, asked.p));
                    for felt in &b.walled {
                        *total += felt.add(asked.query);
                    }
                }
            }
        }
    }

    fn part(&self, asked: &Asked, now_s: f64) -> Inside {
        if self.members.len() <= LEAF {
            return Inside::Leaf(Box::new(self.leaf(asked, now_s)));
        }
        Inside::Halves(Box::new(self.halves(asked)))
    }

    fn leaf(&self, Asked { g, s, query, .. }: &Asked, now_s: f64) -> Bounded {
        let (mut leaf, mut walled) = (Leaf::new(), Vec::new());
        let (room, lookup) = (query.room, query.lookup);
        for m in &self.members {
            let i = g.from + usize::from(*m);
            let sh = s.size.horizontal(now_s - s.born_s[i]);
            let sizes = [sh, s.size.vertical(sh, s.bed[i])];
            let p = [s.x[i], s.y[i], s.z[i]];
            match Felt::new(room, lookup, p, sizes, s.filament_kg) {
                Some(felt) => walled.push(felt),
                None => leaf.push(p, s.bed[i], sizes, s.filament_kg),
            }
        }
        let (mut lo, mut hi) = leaf.bounds();
        for felt in &walled {
            let (low, high) = felt.bounds(room);
            for d in 0..3 {
                (lo[d], hi[d]) = (lo[d].min(low[d]), hi[d].max(high[d]));
            }
        }
        Bounded {
            leaf,
            walled,
            lo,
            hi,
        }
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
        let key = |(v, m): (&f32, &u16)| (((v - lo) * scale) as u32) << 10 | u32::from(*m);
        let keys: Vec<u32> = self.at[d].iter().zip(&self.members).map(key).collect();
        let half = n.div_ceil(LEAF) / 2 * LEAF;
        let least_high = *keys.clone().select_nth_unstable(half).1;
        let (mut low, mut high) = (Vec::with_capacity(half), Vec::with_capacity(n - half));
        for (place, key) in keys.iter().enumerate() {
            let to = if *key < least_high {
                &mut low
            } else {
                &mut high
            };
            to.push(place as u16);
        }
        [low, high].map(|places| {
            let of = |v: &[f32]| places.iter().map(|l| v[usize::from(*l)]).collect();
            let at = [of(&self.at[0]), of(&self.at[1]), of(&self.at[2])];
            let members = places.iter().map(|l| self.members[usize::from(*l)]);
            Self::new(members.collect(), at)
        })
    }
}

fn within(p: [f32; 3], lo: [f32; 3], hi: [f32; 3]) -> bool {
    (0..3).all(|d| p[d] >= lo[d] && p[d] <= hi[d])
}

fn extent(v: &[f32]) -> (f32, f32) {
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
