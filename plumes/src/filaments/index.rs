//! Finds the filaments that can be felt at a point: groups in the order of release, each parted into leaves on demand.
//!
//! *Source*: k-d tree, Bentley 1975, Commun. ACM 18, 509, as bounding boxes of leaves.
//!
//! *Parameters*: 1024 filaments a group, 32 a leaf; speed in `benches/filaments.rs`.
//!
//! *Deviations*: neighbours in the order of release are neighbours in the water, so a group needs no sorting, only its
//! bounds, and most groups are never near a robot. A group is parted when first asked; what it answers does not
//! depend on when that was, so a viewer that asks too changes nothing.

use super::kernel::Path;
pub use super::leaf::CUT_SIGMAS;
use super::leaf::{LEAF, Leaf};
use super::store::Store;
use super::thread;
use nalgebra::Vector3;
use std::sync::OnceLock;

/// Leaves a group, at most.
const LEAVES: usize = 32;
const GROUP: usize = LEAF * LEAVES;

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
    leaves: OnceLock<Leaves>,
}

/// The leaves of a group, with their bounds side by side.
#[derive(Clone, Debug)]
struct Leaves {
    lo: [[f32; LEAVES]; 3],
    hi: [[f32; LEAVES]; 3],
    leaves: Vec<Leaf>,
}

impl Index {
    pub(super) fn new(stores: &[Store], now_s: f64) -> Self {
        let mut groups = Vec::new();
        for (store, s) in stores.iter().enumerate().filter(|(_, s)| !s.size.shares()) {
            for from in (0..s.len()).step_by(GROUP) {
                let n = GROUP.min(s.len() - from);
                // The first is the oldest, and so the largest.
                let reach = CUT_SIGMAS * 1.000_01 * s.size.horizontal(now_s - s.born_s[from]);
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
                    leaves: OnceLock::new(),
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
            if (0..3).all(|d| p[d] >= g.lo[d] && p[d] <= g.hi[d]) {
                let leaves = g
                    .leaves
                    .get_or_init(|| Leaves::new(&stores[g.store], g.from, g.n, self.now_s));
                total += leaves.at(path, p);
            }
        }
        total
    }
}

impl Leaves {
    fn new(s: &Store, from: usize, n: usize, now_s: f64) -> Self {
        let part = |v: &'_ [f32]| -> Vec<f32> { v[from..from + n].to_vec() };
        let coordinates = [part(&s.x), part(&s.y), part(&s.z)];
        let horizontal = s.size.horizontal(now_s - s.born_s[from]);
        let vertical = s.size.vertical(horizontal, s.bed[from]);
        let weight = [1.0 / horizontal, 1.0 / horizontal, 1.0 / vertical];
        let mut order: Vec<u16> = (0..n as u16).collect();
        let mut keys = Vec::with_capacity(n);
        let mut out = Self {
            lo: [[f32::MAX; LEAVES]; 3],
            hi: [[f32::MIN; LEAVES]; 3],
            leaves: Vec::with_capacity(n.div_ceil(LEAF)),
        };
        parted(
            &mut order,
            &coordinates,
            weight,
            &mut keys,
            &mut |members| {
                // In the order of release, so that the sum does not depend on how the parting is done.
                members.sort_unstable();
                let mut leaf = Leaf::new();
                for m in members.iter() {
                    let i = from + usize::from(*m);
                    let sh = s.size.horizontal(now_s - s.born_s[i]);
                    let sizes = [sh, s.size.vertical(sh, s.bed[i])];
                    leaf.push([s.x[i], s.y[i], s.z[i]], s.bed[i], sizes, s.filament_kg);
                }
                let (lo, hi) = leaf.bounds();
                for d in 0..3 {
                    out.lo[d][out.leaves.len()] = lo[d];
                    out.hi[d][out.leaves.len()] = hi[d];
                }
                out.leaves.push(leaf);
            },
        );
        out
    }

    #[expect(clippy::needless_range_loop, reason = "one axis of three arrays")]
    fn at(&self, path: Path, p: [f32; 3]) -> f64 {
        let mut felt = [true; LEAVES];
        for d in 0..3 {
            for (l, felt) in felt.iter_mut().enumerate() {
                *felt &= (p[d] >= self.lo[d][l]) & (p[d] <= self.hi[d][l]);
            }
        }
        let mut total = 0.0;
        for (leaf, _) in self.leaves.iter().zip(felt).filter(|(_, felt)| *felt) {
            total += f64::from(leaf.at(path, p));
        }
        total
    }
}

/// Halves the members along their longest side (in units of the kernel's reach) until each part fits a leaf.
fn parted(
    members: &mut [u16],
    coordinates: &[Vec<f32>; 3],
    weight: [f32; 3],
    keys: &mut Vec<u32>,
    leaf: &mut impl FnMut(&mut [u16]),
) {
    if members.len() <= LEAF {
        leaf(members);
        return;
    }
    let mut widest = (0, f32::MIN, 0.0, 1.0);
    for d in 0..3 {
        let (mut lo, mut hi) = (f32::MAX, f32::MIN);
        for m in members.iter() {
            let v = coordinates[d][usize::from(*m)];
            lo = lo.min(v);
            hi = hi.max(v);
        }
        if (hi - lo) * weight[d] > widest.1 {
            widest = (d, (hi - lo) * weight[d], lo, hi - lo);
        }
    }
    let (d, _, lo, side) = widest;
    // Coordinate in 22 bits, member in 10: plain numbers without ties, which select fast.
    let scale = if side > 0.0 { 4_194_300.0 / side } else { 0.0 };
    keys.clear();
    keys.extend(members.iter().map(|m| {
        let place = ((coordinates[d][usize::from(*m)] - lo) * scale) as u32;
        (place << 10) | u32::from(*m)
    }));
    let half = members.len().div_ceil(LEAF) / 2 * LEAF;
    keys.select_nth_unstable(half);
    for (m, key) in members.iter_mut().zip(keys.iter()) {
        *m = (key & 0x3ff) as u16;
    }
    let (low, high) = members.split_at_mut(half);
    parted(low, coordinates, weight, keys, leaf);
    parted(high, coordinates, weight, keys, leaf);
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
    fn nothing_is_felt_above_the_surface() {
        let stores = [cloud(1000)];
        let index = Index::new(&stores, 0.0);
        let at = |z: f64| index.at(&stores, Path::detect(), &Vector3::new(15.0, 0.0, z));
        assert!(at(-1e-6) > 0.0 && at(1e-6) == 0.0);
    }
}
