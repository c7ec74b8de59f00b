//! One long periodic stretch of turbulence between bed, surface and side walls, on a grid, in units of u_*.
//!
//! *Source*: kinematic simulation, a sum of random Fourier modes with a given spectrum: Kraichnan 1970, Phys. Fluids
//! 13, 22; Fung, Hunt, Malik & Perkins 1992, J. Fluid Mech. 236, 281. Walls by sines and cosines, which equal image
//! eddies.
//!
//! *Parameters*: [`Shape`]: width, depth, the spectrum, spacing of the nodes (an even part of the depth), [`LENGTH`]
//! nodes along.
//!
//! *Deviations*: the field is the curl of a vector potential whose tangential parts vanish at bed, surface and walls.
//! So it is free of divergence and crosses none of them; along a wall it slips. Every potential is multiplied by
//! e^(−z/H) before the curl, so that intensities fall as Nezu & Nakagawa's do. Three constants, one for each potential,
//! are solved so that the expected mean squares of the three components between 0.2 H and 0.8 H equal theirs times the
//! resolved part. Near bed and surface the vertical one falls to zero within about 0.2 H. Between nodes the field is
//! trilinear: waves of four cells are smoothed, and a divergence of a few per cent of the gradients remains.

use super::fourier::{Four, Fourier};
use super::spectrum::{ELONGATION, Spectrum};
use crate::flow::channel::INTENSITIES;
use std::f64::consts::{PI, TAU};
use std::sync::Mutex;
use world::math;
use world::seeds::{Seed, Stream};

/// Nodes along the stream; a power of two.
pub(super) const LENGTH: usize = 512;
/// Length of the shortest wave, in cells.
pub(super) const CELLS_A_WAVE: f64 = 4.0;

/// The parameters of a stretch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shape {
    pub(super) width_m: f64,
    pub(super) depth_m: f64,
    pub(super) spectrum: Spectrum,
    /// Number of cells from bed to surface, and from wall to wall.
    pub(super) up: usize,
    pub(super) across: usize,
}

/// The velocities at the nodes.
#[derive(Debug)]
pub(super) struct Stretch {
    /// `[along, across to the left, up, 0]` over u_* at (j·[`LENGTH`] + i)·(up + 1) + k: one sheet of nodes along and up
    /// for each line j across.
    pub(super) nodes: Vec<[f32; 4]>,
}

/// A wave: numbers along, across and up, and the standard deviation of each potential's coefficient (real and imaginary
/// part).
struct Wave {
    k: [f64; 3],
    /// Indices across and up.
    n: usize,
    m: usize,
    std: f64,
}

impl Shape {
    pub(super) fn spacing(&self) -> [f64; 3] {
        let along = self.depth_m / self.up as f64;
        [along, self.width_m / self.across as f64, along]
    }

    /// Greatest number of half waves in an extent.
    fn most(&self, extent_m: f64) -> usize {
        (self.spectrum.k_c * extent_m / PI) as usize
    }

    /// All waves whose number along the stream is j.
    fn waves(&self, j: usize) -> Vec<Wave> {
        let k_c = self.spectrum.k_c;
        let kx = TAU * j as f64 / (LENGTH as f64 * self.spacing()[0]);
        let mut waves = Vec::new();
        for n in 0..=self.most(self.width_m) {
            let ky = n as f64 * PI / self.width_m;
            for m in 0..=self.most(self.depth_m) {
                let kz = m as f64 * PI / self.depth_m;
                if kx * kx + ky * ky + kz * kz > k_c * k_c {
                    break;
                }
                let round = (ELONGATION * ELONGATION * kx * kx + ky * ky + kz * kz).sqrt();
                let density = self.spectrum.energy(round) / (round * round * round * round);
                // A wave number of zero stands for half a cell.
                let part = |number: usize| if number == 0 { 0.5 } else { 1.0 };
                let cells: f64 = part(n) * part(m);
                waves.push(Wave { k: [kx, ky, kz], n, m, std: (density * cells).sqrt() });
            }
        }
        waves
    }

    fn along(&self) -> std::ops::RangeInclusive<usize> {
        let reach = self.spectrum.k_c * LENGTH as f64 * self.spacing()[0] / TAU;
        1..=((reach + 1e-9) as usize).min(LENGTH / 2 - 1)
    }

    /// f and f′ at a level, where f is the decrease of the intensities with height.
    fn fall(&self, height_m: f64) -> (f64, f64) {
        let f = math::exp(-height_m / self.depth_m);
        (f, -f / self.depth_m)
    }

    /// All waves, by their number along the stream.
    fn all_waves(&self) -> Vec<(usize, Vec<Wave>)> {
        self.along().map(|j| (j, self.waves(j))).collect()
    }

    /// Expected mean squares at a height for each potential of unit strength: [component][potential], averaged over the
    /// width.
    fn shares(&self, height_m: f64, waves: &[(usize, Vec<Wave>)]) -> [[f64; 3]; 3] {
        let (f, df) = self.fall(height_m);
        let of = |m: usize| math::sin_cos(m as f64 * PI / self.depth_m * height_m);
        let turns: Vec<(f64, f64)> = (0..=self.most(self.depth_m)).map(of).collect();
        let mut v = [[0.0; 3]; 3];
        for w in waves.iter().flat_map(|(_, waves)| waves) {
            let (s, c) = turns[w.m];
            let bent = df * s + f * w.k[2] * c;
            // Real part of a coefficient with variance std² in each part: mean square std²; cos² or sin² across: a
            // half, or one.
            let even = w.std * w.std * if w.n == 0 { 1.0 } else { 0.5 };
            let odd = w.std * w.std * if w.n == 0 { 0.0 } else { 0.5 };
            v[0][2] += even * sq(f * w.k[1] * c);
            v[0][1] += even * sq(bent);
            v[1][0] += odd * sq(bent);
            v[1][2] += odd * sq(f * w.k[0] * c);
            v[2][1] += even * sq(f * w.k[0] * s);
            v[2][0] += even * sq(f * w.k[1] * s);
        }
        v
    }

    /// Strengths of the three potentials.
    fn strengths(&self, resolved: f64, waves: &[(usize, Vec<Wave>)]) -> [f64; 3] {
        const N: usize = 13;
        let (mut v, mut want) = ([[0.0; 3]; 3], [0.0; 3]);
        for n in 0..N {
            let height = self.depth_m * (0.2 + 0.6 * n as f64 / (N - 1) as f64);
            let f2 = sq(self.fall(height).0);
            let here = self.shares(height, waves);
            for c in 0..3 {
                want[c] += resolved * sq(INTENSITIES[c]) * f2;
                for p in 0..3 {
                    v[c][p] += here[c][p];
                }
            }
        }
        let m = nalgebra::Matrix3::from_fn(|c, p| v[c][p]);
        let solved = m.lu().solve(&nalgebra::Vector3::from(want)).unwrap_or_else(nalgebra::Vector3::zeros);
        [0, 1, 2].map(|p: usize| solved[p].max(0.0).sqrt())
    }

    /// Expected intensities at a height in units of u_*.
    pub(super) fn expected(&self, height_m: f64) -> [f64; 3] {
        let waves = self.all_waves();
        let a = self.strengths(self.spectrum.resolved(), &waves);
        let v = self.shares(height_m, &waves);
        [0, 1, 2].map(|c: usize| (0..3).map(|p| a[p] * a[p] * v[c][p]).sum::<f64>().sqrt())
    }
}

fn sq(x: f64) -> f64 {
    x * x
}

impl Stretch {
    /// Draws a stretch with so many threads; `seed` identifies it, and with any number it is the same.
    pub(super) fn new(shape: &Shape, seed: impl Into<Seed>, threads: usize) -> Self {
        let drawn = Amplitudes::draw(shape, seed.into());
        let sheet = LENGTH * (shape.up + 1);
        let mut nodes = vec![[0.0_f32; 4]; sheet * (shape.across + 1)];
        let sheets = Mutex::new(nodes.chunks_exact_mut(sheet).enumerate());
        let next = || sheets.lock().expect("nobody panics while it is held").next();
        let work = || {
            while let Some((y, sheet)) = next() {
                drawn.sum(y, sheet);
            }
        };
        std::thread::scope(|scope| {
            for _ in 1..threads.min(shape.across + 1) {
                // Without the thread, the others do its part.
                drop(std::thread::Builder::new().spawn_scoped(scope, work));
            }
            work();
        });
        Self { nodes }
    }
}

/// The drawn coefficients, summed over the waves up. Those across and along are left to be summed.
struct Amplitudes {
    fourier: Fourier,
    /// Levels.
    levels: usize,
    /// Numbers along the stream, and at each the sums by number across and level.
    along: Vec<(usize, Vec<Four>)>,
    /// Sine and cosine by line across and number across.
    across: Vec<Vec<(f64, f64)>>,
}

impl Amplitudes {
    fn draw(shape: &Shape, seed: Seed) -> Self {
        let all_waves = shape.all_waves();
        let strength = shape.strengths(shape.spectrum.resolved(), &all_waves);
        let (ny, nz) = (shape.across + 1, shape.up + 1);
        let h = shape.spacing();
        let mut rng = Stream::new(seed, "eddies", "waves");
        let turn =
            |n: usize, cells: usize, at: usize| math::sin_cos(PI * ((n * at) % (2 * cells)) as f64 / cells as f64);
        let across =
            (0..ny).map(|y| (0..=shape.most(shape.width_m)).map(|n| turn(n, shape.across, y)).collect()).collect();
        let up: Vec<Vec<(f64, f64)>> =
            (0..=shape.most(shape.depth_m)).map(|m| (0..nz).map(|z| turn(m, shape.up, z)).collect()).collect();
        let falls: Vec<(f64, f64)> = (0..nz).map(|z| shape.fall(z as f64 * h[2])).collect();
        let mut along = Vec::with_capacity(all_waves.len());
        for (j, waves) in &all_waves {
            let mut sums = vec![Four::default(); (shape.most(shape.width_m) + 1) * nz];
            for w in waves {
                let mut draw = || [w.std * rng.normal(), w.std * rng.normal()];
                let a = [draw(), draw(), draw()];
                let [kx, ky, kz] = w.k;
                for z in 0..nz {
                    let ((f, df), (s, c)) = (falls[z], up[w.m][z]);
                    let bent = df * s + f * kz * c;
                    let to = &mut sums[w.n * nz + z];
                    let [ax, ay, az] = strength;
                    // i·kx of a coefficient (r, i) is (−kx·i, kx·r).
                    for (part, other, sign) in [(0, 1, -1.0), (1, 0, 1.0)] {
                        let along = |p: usize| sign * kx * a[p][other];
                        to[part][0] += az * f * ky * c * a[2][part] - ay * bent * a[1][part];
                        to[part][1] += ax * bent * a[0][part] - az * f * c * along(2);
                        to[part][2] += ay * f * s * along(1) - ax * f * s * ky * a[0][part];
                    }
                }
            }
            along.push((*j, sums));
        }
        Self { fourier: Fourier::new(LENGTH), levels: nz, along, across }
    }

    /// The velocities of the sheet of nodes at a line across.
    fn sum(&self, y: usize, sheet: &mut [[f32; 4]]) {
        let nz = self.levels;
        let mut rows = vec![Four::default(); nz * self.along.len()];
        for (row, (_, sums)) in rows.chunks_exact_mut(nz).zip(&self.along) {
            for ((s, c), from) in self.across[y].iter().zip(sums.chunks_exact(nz)) {
                self.fourier.add_times(row, from, [*c, *s, *c, 0.0]);
            }
        }
        let mut line = vec![Four::default(); LENGTH];
        for z in 0..nz {
            line.fill(Four::default());
            for (row, (j, _)) in rows.chunks_exact(nz).zip(&self.along) {
                line[*j] = row[z];
            }
            self.fourier.sum(&mut line);
            for (to, value) in sheet.chunks_exact_mut(nz).zip(&line) {
                to[z] = value[0].map(|v| v as f32);
            }
        }
    }
}
