//! The eddies at one time: their velocity at a place, and how they carry filaments.
//!
//! *Source*: see `field`.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none. The arithmetic is written once, without fused multiply-add, and compiled for each version of
//! `path`, with the same bits.

use super::stretch::LENGTH;
use crate::path::Path;
#[cfg(target_arch = "x86_64")]
use crate::quad::Avx;
use crate::quad::{Pair, Twice};
use nalgebra::Vector2;

/// A patch of the stretch at one time: where it begins (cells), and its weight.
#[derive(Clone, Copy)]
pub(super) struct Patch {
    pub(super) begin: f32,
    pub(super) mirrored: bool,
    pub(super) weight: f32,
}

/// The eddies at one time.
pub(super) struct Now<'a> {
    pub(super) nodes: &'a [[f32; 4]],
    pub(super) across: usize,
    pub(super) up: usize,
    pub(super) per_m: [f32; 3],
    pub(super) half_width: f32,
    pub(super) depth: f32,
    pub(super) patches: [Patch; 2],
}

/// The channel's axes in the world.
pub(super) struct Turned {
    pub(super) centre: Vector2<f32>,
    pub(super) along: Vector2<f32>,
    pub(super) left: Vector2<f32>,
}

impl Now<'_> {
    /// `[along, left, up]` velocity at `[along, left, up]` from the area's centre and the surface.
    pub(super) fn at(&self, q: [f32; 3]) -> [f32; 3] {
        // SAFETY: a pair that every machine of the target has.
        unsafe { velocity::<Twice>(self, q) }
    }

    /// Carries places (ENU, m) up to this time, the n-th for `dt_s[n]`.
    pub(super) fn carry(&self, path: Path, turned: &Turned, dt_s: &[f32], p: [&mut [f32]; 3]) {
        match path {
            // SAFETY: a pair that every machine of the target has.
            Path::Portable => unsafe { carry::<Twice>(self, turned, dt_s, p) },
            // SAFETY: this variant is only made after the feature was detected.
            #[cfg(target_arch = "x86_64")]
            Path::Avx2 | Path::Avx512 => unsafe { carry_avx2(self, turned, dt_s, p) },
        }
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn carry_avx2(now: &Now, turned: &Turned, dt_s: &[f32], p: [&mut [f32]; 3]) {
    // SAFETY: the pair needs AVX, which is part of this function's features.
    unsafe { carry::<Avx>(now, turned, dt_s, p) }
}

/// # Safety
/// The machine must have the instructions of `P`.
#[inline(always)]
unsafe fn carry<P: Pair>(now: &Now, turned: &Turned, dt_s: &[f32], [x, y, z]: [&mut [f32]; 3]) {
    let (centre, a, l) = (turned.centre, turned.along, turned.left);
    for n in 0..dt_s.len() {
        let dt = dt_s[n];
        let (dx, dy) = (x[n] - centre.x, y[n] - centre.y);
        let q = [dx * a.x + dy * a.y, dx * l.x + dy * l.y, z[n]];
        // Half the step ahead first, so that an even cloud stays even to second order.
        // SAFETY: the caller promises the instructions of the pair.
        let v = unsafe { velocity::<P>(now, q) };
        let half = 0.5 * dt;
        let q = [q[0] + half * v[0], q[1] + half * v[1], q[2] + half * v[2]];
        // SAFETY: as above.
        let v = unsafe { velocity::<P>(now, q) };
        x[n] += dt * (v[0] * a.x + v[1] * l.x);
        y[n] += dt * (v[0] * a.y + v[1] * l.y);
        z[n] += dt * v[2];
    }
}

/// # Safety
/// The machine must have the instructions of `P`.
#[inline(always)]
unsafe fn velocity<P: Pair>(now: &Now, q: [f32; 3]) -> [f32; 3] {
    let (k, h) = cell((q[2] + now.depth) * now.per_m[2], now.up);
    let mut sum = [0.0_f32; 3];
    for patch in &now.patches {
        let side = if patch.mirrored { -1.0 } else { 1.0 };
        let (j, g) = cell((side * q[1] + now.half_width) * now.per_m[1], now.across);
        let at = q[0] * now.per_m[0] - patch.begin;
        let floor = at.floor();
        let f = at - floor;
        let i = floor as i32 as usize & (LENGTH - 1);
        let (row, column) = (now.up + 1, (now.up + 1) * (now.across + 1));
        let near = i * column + j * row + k;
        let far = ((i + 1) & (LENGTH - 1)) * column + j * row + k;
        // SAFETY: the caller promises the instructions of the pair.
        let [right, left] = unsafe {
            [
                line::<P>(now.nodes, near, far, h),
                line::<P>(now.nodes, near + row, far + row, h),
            ]
        };
        let [behind, ahead] = right.add(left.sub(right).times(g)).apart();
        let v = behind.add(ahead.sub(behind).times(f)).array();
        sum[0] += patch.weight * v[0];
        sum[1] += patch.weight * side * v[1];
        sum[2] += patch.weight * v[2];
    }
    sum
}

/// The velocities between two nodes and those above them, at this part of the way up.
///
/// # Safety
/// The machine must have the instructions of `P`.
#[inline(always)]
unsafe fn line<P: Pair>(nodes: &[[f32; 4]], near: usize, far: usize, part: f32) -> P {
    // SAFETY: as the caller promises.
    let [low, high] = unsafe {
        [
            P::of(&nodes[near], &nodes[far]),
            P::of(&nodes[near + 1], &nodes[far + 1]),
        ]
    };
    low.add(high.sub(low).times(part))
}

/// Cell, and the position in it as a part.
#[inline(always)]
fn cell(c: f32, cells: usize) -> (usize, f32) {
    let c = c.clamp(0.0, cells as f32);
    let i = (c as i32 as usize).min(cells - 1);
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
        let nodes: Vec<[f32; 4]> = (0..count)
            .map(|n| [0x9e37_79b9, 0x85eb_ca6b, 0xc2b2_ae35, 0].map(|m| part(n, m)))
            .collect();
        let patch = |begin: f32, mirrored: bool| Patch {
            begin,
            mirrored,
            weight: 0.003,
        };
        let now = Now {
            nodes: &nodes,
            across,
            up,
            per_m: [20.0; 3],
            half_width: 0.125,
            depth: 0.2,
            patches: [patch(3.7, false), patch(60.2, true)],
        };
        let turned = Turned {
            centre: Vector2::new(0.3, -0.1),
            along: Vector2::new(0.6, 0.8),
            left: Vector2::new(-0.8, 0.6),
        };
        let dt: Vec<f32> = (0..1000)
            .map(|n| 0.2 + 0.1 * part(n, 0x27d4_eb2f))
            .collect();
        let start = [0x9e37_79b9, 0x85eb_ca6b, 0xc2b2_ae35].map(|m| {
            (0..1000)
                .map(|n| 0.2 * part(n, m) - 0.1)
                .collect::<Vec<f32>>()
        });
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
        let portable = carried(Path::Portable);
        assert_ne!(portable, bits(&start));
        for path in Path::all() {
            assert_eq!(carried(path), portable, "{path:?}");
        }
    }
}
