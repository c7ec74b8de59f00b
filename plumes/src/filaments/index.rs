//! Finds the filaments that can be felt at a point: groups in the order of release, each parted into leaves where it is asked.
//!
//! *Source*: k-d tree, Bentley 1975, Commun. ACM 18, 509, as bounding boxes of leaves.
//!
//! *Parameters*: 1024 filaments a group, 32 a leaf; speed in `benches/filaments.rs`.
//!
//! *Deviations*: neighbours in the order of release are neighbours in the water, so a group needs no sorting, only its
//! bounds, and most groups are never near a robot. A group is halved again and again, as far as what is asked lies near a
//! half; what it answers does not depend on what was asked before, so a viewer that asks too changes nothing.

use super::kernel::Path;
pub use super::leaf::CUT_SIGMAS;
use super::leaf::{LEAF, Leaf};
use super::store::Store;
use super::thread;
use nalgebra::Vector3;
use std::sync::OnceLock;

/// Filaments a group, at most.
const GROUP: usize = 1024;

/// All groups of all stores at one time.
#[derive(Clone, Debug)]
pub(super) struct Index {
    groups: Vec<Group>,
    now_s: f64,
}

#[derive(Clone, Debug)]
struct Group {
    store: usize,
    from: usize,
    n: usize,
    lo: [f32; 3],
    hi: [f32; 3],
    /// Size of the oldest member, the largest: horizontal, and vertical wherever it may be.
    largest: [f32; 2],
    whole: OnceLock<Part>,
}

/// Members of a group, in the order of release, with the box they are in; parted when first asked near it.
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

/// A leaf with its bounds.
#[derive(Clone, Debug)]
struct Bounded {
    leaf: Leaf,
    lo: [f32; 3],
    hi: [f32; 3],
}

impl Index {
    pub(super) fn new(stores: &[Store], now_s: f64) -> Self {
        let mut groups = Vec::new();
        for (store, s) in stores.iter().enumerate().filter(|(_, s)| !s.size.shares()) {
            for from in (0..s.len()).step_by(GROUP) {
                let n = GROUP.min(s.len() - from);
                // The first is the oldest, and so the largest.
                let horizontal = s.size.horizontal(now_s - s.born_s[from]);
                let reach = CUT_SIGMAS * 1.000_01 * horizontal;
                let (mut lo, mut hi) = ([0.0; 3], [0.0; 3]);
                for (d, v) in [&s.x, &s.y, &s.z].into_iter().enumerate() {
                    let (low, high) = extent(&v[from..from + n]);
                    (lo[d], hi[d]) = (low - reach, high + reach);
                }
                groups.push(Group {
                    store,
                    from,
                    n,
                    lo,
                    hi,
                    largest: [horizontal, s.size.vertical(horizontal, f32::MIN)],
                    whole: OnceLock::new(),
                });
            }
        }
        Self { groups, now_s }
    }

    /// Concentration at a point, kg/m³; nothing above the surface.
    pub(super) fn at(&self, stores: &[Store], path: Path, p: &Vector3<f64>) -> f64 {
        let p = [p.x as f32, p.y as f32, p.z as f32];
        if p[2] > 0.0 {
            return 0.0;
        }
        let mut total = 0.0;
        for s in stores.iter().filter(|s| s.size.shares()) {
            total += thread::at(s, self.now_s, path, p);
        }
        for g in &self.groups {
            if within(p, g.lo, g.hi) {
                let s = &stores[g.store];
                let mut felt = 0.0;
                g.whole.get_or_init(|| g.whole(s)).add(
                    &Asked { p, path, g, s },
                    self.now_s,
                    &mut felt,
                );
                total += felt;
            }
        }
        total
    }
}

/// What is asked, and of whom.
struct Asked<'a> {
    p: [f32; 3],
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

    /// Adds what its leaves make felt, one after the other.
    fn add(&self, asked: &Asked, now_s: f64, total: &mut f64) {
        // More than the leaves' own bounds, which decide.
        let reach = asked.g.largest.map(|size| CUT_SIGMAS * 1.000_1 * size);
        let reach = [reach[0], reach[0], reach[1]];
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

    fn leaf(&self, Asked { g, s, .. }: &Asked, now_s: f64) -> Bounded {
        let mut leaf = Leaf::new();
        for m in &self.members {
            let i = g.from + usize::from(*m);
            let sh = s.size.horizontal(now_s - s.born_s[i]);
            let sizes = [sh, s.size.vertical(sh, s.bed[i])];
            leaf.push([s.x[i], s.y[i], s.z[i]], s.bed[i], sizes, s.filament_kg);
        }
        let (lo, hi) = leaf.bounds();
        Bounded { leaf, lo, hi }
    }

    /// Halves the members along their longest side (in units of the kernel's reach), full leaves to each.
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
        // Coordinate in 22 bits, member in 10: plain numbers without ties, which select fast.
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

#[cfg(test)]
mod tests {
    use super::super::size::Size;
    use super::*;
    use crate::release::ReleaseSpec;
    use world::seeds::Stream;

    /// A cloud of filaments of all ages in 6 m of water.
    fn cloud(n: usize) -> Store {
        let mut s = Store::new(Size::new(&ReleaseSpec::default()), 1e-6);
        let mut r = Stream::new(5, "test", "cloud");
        for k in 0..n {
            let age = (n - k) as f64 * 0.2;
            let p = [0.1 * age, 0.2 * age.sqrt() * r.normal(), -6.0 * r.uniform()];
            s.push(p.map(|v| v as f32), -6.0, -age);
        }
        s
    }

    #[test]
    fn index_finds_all_that_a_full_search_finds() {
        let s = cloud(5000);
        let stores = [s];
        let index = Index::new(&stores, 0.0);
        let mut all = Vec::new();
        for chunk in 0..stores[0].len().div_ceil(LEAF) {
            let mut leaf = Leaf::new();
            let s = &stores[0];
            for i in chunk * LEAF..((chunk + 1) * LEAF).min(s.len()) {
                let sh = s.size.horizontal(-s.born_s[i]);
                let sizes = [sh, s.size.vertical(sh, s.bed[i])];
                leaf.push([s.x[i], s.y[i], s.z[i]], s.bed[i], sizes, s.filament_kg);
            }
            all.push(leaf);
        }
        let mut r = Stream::new(6, "test", "probe");
        let mut hits = 0;
        for _ in 0..2000 {
            let p = Vector3::new(
                110.0 * r.uniform(),
                10.0 * r.uniform() - 5.0,
                -6.0 * r.uniform(),
            );
            let got = index.at(&stores, Path::detect(), &p);
            let q = [p.x as f32, p.y as f32, p.z as f32];
            let want: f64 = all.iter().map(|l| f64::from(l.at(Path::Portable, q))).sum();
            assert!((got - want).abs() <= 1e-5 * want, "{got} {want}");
            hits += usize::from(want > 0.0);
        }
        assert!(hits > 500, "{hits}");
    }

    #[test]
    fn answers_do_not_depend_on_what_was_asked_before() {
        let stores = [cloud(5000)];
        let asked = Index::new(&stores, 0.0);
        let mut r = Stream::new(7, "test", "probe");
        let mut hits = 0;
        for _ in 0..300 {
            let p = Vector3::new(110.0 * r.uniform(), 2.0 * r.normal(), -6.0 * r.uniform());
            let fresh = Index::new(&stores, 0.0).at(&stores, Path::Portable, &p);
            let again = asked.at(&stores, Path::detect(), &p);
            assert_eq!(again.to_bits(), fresh.to_bits());
            hits += usize::from(fresh > 0.0);
        }
        assert!(hits > 100, "{hits}");
    }

    #[test]
    fn nothing_is_felt_above_the_surface() {
        let stores = [cloud(1000)];
        let index = Index::new(&stores, 0.0);
        let at = |z: f64| index.at(&stores, Path::detect(), &Vector3::new(15.0, 0.0, z));
        assert!(at(-1e-6) > 0.0 && at(1e-6) == 0.0);
    }
}
