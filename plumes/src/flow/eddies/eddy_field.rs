//! The eddies at one time: their velocity at a place, and how they carry filaments.
//!
//! *Source*: see `field`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none. The arithmetic is written once, without fused multiply-add, and compiled for each version of
//! `path`, with the same bits.

use super::stretch::LENGTH;
use crate::simd::dispatch::InstructionSet;
use crate::simd::f32x4::{F32x4, fetch_soon};
use nalgebra::Vector2;

/// A patch of the stretch at one time: where it begins (cells), and its weight.
#[derive(Clone, Copy)]
pub(super) struct Patch {
    pub(super) begin: f32,
    pub(super) mirrored: bool,
    pub(super) weight: f32,
}

/// The eddies at one time.
pub(super) struct EddyField<'a> {
    pub(super) nodes: &'a [[f32; 4]],
    pub(super) across: usize,
    pub(super) up: usize,
    pub(super) per_m: [f32; 3],
    pub(super) half_width: f32,
    pub(super) depth: f32,
    pub(super) patches: [Patch; 2],
}

/// The channel's axes in the world.
pub(super) struct ChannelAxes {
    pub(super) centre: Vector2<f32>,
    pub(super) along: Vector2<f32>,
    pub(super) left: Vector2<f32>,
}

impl EddyField<'_> {
    /// Number of nodes from a line across to the next one.
    #[inline(always)]
    fn sheet(&self) -> usize {
        (self.up + 1) * LENGTH
    }

    /// `[along, left, up]` velocity at `[along, left, up]` from the area's centre and the surface.
    pub(super) fn velocity(&self, q: [f32; 3]) -> [f32; 3] {
        let v = velocities::<1>(self, &Cells::locate(self, &q.map(|q| [q])));
        v.map(|v| v[0])
    }

    /// Carries places (ENU, m) up to this time, the n-th for `dt_s[n]`.
    pub(super) fn carry(&self, path: InstructionSet, turned: &ChannelAxes, dt_s: &[f32], p: [&mut [f32]; 3]) {
        path.run(
            #[inline(always)]
            || carry(self, turned, dt_s, p),
        );
    }
}

/// Filaments that are carried side by side.
const BLOCK: usize = 8;

#[inline(always)]
fn carry(now: &EddyField, turned: &ChannelAxes, dt_s: &[f32], [x, y, z]: [&mut [f32]; 3]) {
    let (a, l) = (turned.along, turned.left);
    let mut next = BlockPoints::from_block(turned, [x, y, z], 0);
    let mut next_cells = Cells::locate(now, &next.q);
    for from in (0..dt_s.len()).step_by(BLOCK) {
        let (places, cells) = (next, next_cells);
        // The nodes of the next block are on their way while this one is carried.
        next = BlockPoints::from_block(turned, [x, y, z], from + BLOCK);
        next_cells = Cells::locate(now, &next.q);
        for cells in &next_cells {
            cells.fetch_soon(now);
        }
        let BlockPoints { mut p, mut q } = places;
        let dt = block(dt_s, from);
        // Half the step ahead first, so that an even cloud stays even to second order.
        let v = velocities::<BLOCK>(now, &cells);
        for n in 0..BLOCK {
            let half = 0.5 * dt[n];
            for d in 0..3 {
                q[d][n] += half * v[d][n];
            }
        }
        let v = velocities::<BLOCK>(now, &Cells::locate(now, &q));
        for n in 0..BLOCK {
            p[0][n] += dt[n] * (v[0][n] * a.x + v[1][n] * l.x);
            p[1][n] += dt[n] * (v[0][n] * a.y + v[1][n] * l.y);
            p[2][n] += dt[n] * v[2][n];
        }
        for (to, p) in [&mut *x, &mut *y, &mut *z].into_iter().zip(p) {
            match to[from..].first_chunk_mut() {
                Some(to) => *to = p,
                None => {
                    let used = dt_s.len() - from;
                    to[from..].copy_from_slice(&p[..used]);
                }
            }
        }
    }
}

/// Places of a block.
#[derive(Clone, Copy)]
struct BlockPoints {
    /// ENU, m.
    p: [[f32; BLOCK]; 3],
    /// Along, left, up, from the area's centre and the surface, m.
    q: [[f32; BLOCK]; 3],
}

impl BlockPoints {
    /// Those of the filaments from a number on.
    #[inline(always)]
    fn from_block(turned: &ChannelAxes, all: [&[f32]; 3], from: usize) -> Self {
        let (centre, a, l) = (turned.centre, turned.along, turned.left);
        let [x, y, z] = all;
        let p = [block(x, from), block(y, from), block(z, from)];
        let mut q = [[0.0; BLOCK]; 3];
        for n in 0..BLOCK {
            let (dx, dy) = (p[0][n] - centre.x, p[1][n] - centre.y);
            q[0][n] = dx * a.x + dy * a.y;
            q[1][n] = dx * l.x + dy * l.y;
            q[2][n] = p[2][n];
        }
        Self { p, q }
    }
}

/// A block of numbers from a place on. Empty places are carried too, and left.
#[inline(always)]
fn block(v: &[f32], from: usize) -> [f32; BLOCK] {
    let rest = v.get(from..).unwrap_or_default();
    // A copy of a known length takes no call.
    rest.first_chunk().copied().unwrap_or_else(|| {
        let mut some = [0.0; BLOCK];
        some[..rest.len()].copy_from_slice(rest);
        some
    })
}

/// The cells of a patch in which `N` places are.
#[derive(Clone, Copy)]
struct Cells<const N: usize> {
    /// The lowest right node behind, and ahead.
    near: [u32; N],
    far: [u32; N],
    /// Positions in the cells along, left and up, as parts.
    part: [[f32; N]; 3],
}

impl<const N: usize> Cells<N> {
    /// Those of places (along, left, up), in both patches.
    #[inline(always)]
    fn locate(now: &EddyField, q: &[[f32; N]; 3]) -> [Self; 2] {
        // Not by a closure, which would not be compiled for the caller's instructions.
        let [older, younger] = &now.patches;
        [Self::of_one(now, older, q), Self::of_one(now, younger, q)]
    }

    #[inline(always)]
    fn of_one(now: &EddyField, patch: &Patch, q: &[[f32; N]; 3]) -> Self {
        let row = now.up as u32 + 1;
        let (mut near, mut far) = ([0_u32; N], [0_u32; N]);
        let [mut f, mut g, mut h] = [[0.0_f32; N]; 3];
        let side = if patch.mirrored { -1.0 } else { 1.0 };
        for n in 0..N {
            let (k, part) = cell((q[2][n] + now.depth) * now.per_m[2], now.up);
            h[n] = part;
            let (j, part) = cell((side * q[1][n] + now.half_width) * now.per_m[1], now.across);
            g[n] = part;
            // Within what an integer holds; a place that is not a number lies at an end, and its part is none.
            let at = q[0][n] * now.per_m[0] - patch.begin;
            let floor = between(at, -FARTHEST, FARTHEST).floor();
            f[n] = at - floor;
            // SAFETY: as just limited.
            let i = unsafe { floor.to_int_unchecked::<i32>() } as u32;
            let sheet = j * LENGTH as u32;
            near[n] = (sheet + (i & (LENGTH as u32 - 1))) * row + k;
            far[n] = (sheet + (i.wrapping_add(1) & (LENGTH as u32 - 1))) * row + k;
        }
        Self { near, far, part: [f, g, h] }
    }

    /// Asks the processor for the nodes.
    #[inline(always)]
    fn fetch_soon(&self, now: &EddyField) {
        let sheet = now.sheet();
        for n in self.near.iter().chain(&self.far) {
            fetch_soon(now.nodes, *n as usize);
            fetch_soon(now.nodes, *n as usize + sheet);
        }
    }
}

/// Velocities (along, left, up) in `N` cells of each patch.
#[inline(always)]
fn velocities<const N: usize>(now: &EddyField, cells: &[Cells<N>; 2]) -> [[f32; N]; 3] {
    let sheet = now.sheet();
    let mut sum = [[0.0_f32; N]; 3];
    for (patch, cells) in now.patches.iter().zip(cells) {
        let Cells { near, far, part: [f, g, h] } = cells;
        let highest = near.iter().zip(far).fold(0, |most, (a, b)| most.max(*a).max(*b));
        assert!(
            highest as usize + sheet + 1 < now.nodes.len(),
            "a cell is not one of the eddies' grid: its nodes are not those of its shape"
        );
        let mut v = [[0.0; N]; 3];
        for from in (0..N).step_by(4) {
            let mut four = [F32x4::new(&[0.0; 4]); 4];
            for (l, four) in four.iter_mut().enumerate().take(N - from) {
                let n = from + l;
                let (near, far) = (near[n] as usize, far[n] as usize);
                // SAFETY: the nodes exist, as asserted.
                *four = unsafe { one(now.nodes, [near, far], sheet, [f[n], g[n], h[n]]) };
            }
            let four = F32x4::columns(four);
            for (v, four) in v.iter_mut().zip(four) {
                for (v, four) in v[from..].iter_mut().zip(four) {
                    *v = four;
                }
            }
        }
        let side = if patch.mirrored { -1.0 } else { 1.0 };
        for n in 0..N {
            sum[0][n] += patch.weight * v[0][n];
            sum[1][n] += patch.weight * side * v[1][n];
            sum[2][n] += patch.weight * v[2][n];
        }
    }
    sum
}

/// Farthest place along the stretch, in cells.
const FARTHEST: f32 = 1e9;

/// `[along, left, up, 0]` velocity in a cell from two of its nodes, the stride to those on the left, and the position in
/// it as parts.
///
/// # Safety
/// The cell's eight nodes must exist.
#[inline(always)]
unsafe fn one(nodes: &[[f32; 4]], [near, far]: [usize; 2], sheet: usize, [f, g, h]: [f32; 3]) -> F32x4 {
    debug_assert!(near.max(far) + sheet + 1 < nodes.len());
    // SAFETY: as the caller promises.
    let node = |n: usize| F32x4::new(unsafe { nodes.get_unchecked(n) });
    // From the lower to the upper node, from right to left, from the near to the far side.
    let between = |a: F32x4, b: F32x4, part: f32| a.add(b.sub(a).times(part));
    let line = |n: usize| between(node(n), node(n + 1), h);
    let side = |n: usize| between(line(n), line(n + sheet), g);
    between(side(near), side(far), f)
}

/// Limits a number; what is none becomes the lower limit.
#[inline(always)]
fn between(v: f32, low: f32, high: f32) -> f32 {
    let v = if v > low { v } else { low };
    if v < high { v } else { high }
}

/// Cell, and the position in it as a part.
#[inline(always)]
fn cell(c: f32, cells: usize) -> (u32, f32) {
    let c = between(c, 0.0, cells as f32);
    // SAFETY: just limited to the number of cells, which is small.
    let i = unsafe { c.to_int_unchecked::<i32>() } as u32;
    let i = i.min(cells as u32 - 1);
    (i, c - i as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_versions_carry_to_the_same_bits() {
        let (across, up) = (5, 4);
        let count = LENGTH * (across + 1) * (up + 1);
        let part = |n: usize, m: u32| (n as u32).wrapping_mul(m) as f32 / u32::MAX as f32 - 0.5;
        let nodes: Vec<[f32; 4]> =
            (0..count).map(|n| [0x9e37_79b9, 0x85eb_ca6b, 0xc2b2_ae35, 0].map(|m| part(n, m))).collect();
        let patch = |begin: f32, mirrored: bool| Patch { begin, mirrored, weight: 0.003 };
        let now = EddyField {
            nodes: &nodes,
            across,
            up,
            per_m: [20.0; 3],
            half_width: 0.125,
            depth: 0.2,
            patches: [patch(3.7, false), patch(60.2, true)],
        };
        let turned = ChannelAxes {
            centre: Vector2::new(0.3, -0.1),
            along: Vector2::new(0.6, 0.8),
            left: Vector2::new(-0.8, 0.6),
        };
        let dt: Vec<f32> = (0..1000).map(|n| 0.2 + 0.1 * part(n, 0x27d4_eb2f)).collect();
        let start = [0x9e37_79b9, 0x85eb_ca6b, 0xc2b2_ae35]
            .map(|m| (0..1000).map(|n| 0.2 * part(n, m) - 0.1).collect::<Vec<f32>>());
        let bits = |p: &[Vec<f32>; 3]| {
            let of = |v: &Vec<f32>| v.iter().map(|v| v.to_bits()).collect::<Vec<u32>>();
            p.each_ref().map(of)
        };
        let carried = |path| {
            let mut p = start.clone();
            for _ in 0..20 {
                now.carry(path, &turned, &dt, p.each_mut().map(Vec::as_mut_slice));
            }
            bits(&p)
        };
        let portable = carried(InstructionSet::Portable);
        assert_ne!(portable, bits(&start));
        for path in InstructionSet::all() {
            assert_eq!(carried(path), portable, "{path:?}");
        }
    }
}
