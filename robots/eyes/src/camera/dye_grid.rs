//! Dye before a camera on a grid along its lines of sight, and the amount of dye between there and the sun.
//!
//! *Source:* volumes in camera-aligned cells: Wronski 2014, Volumetric Fog, SIGGRAPH course Advances in Real-Time
//! Rendering.
//!
//! *Parameters:* only the shape of [`Lines`].
//!
//! *Deviations:* the concentration is first evaluated at every second node along each axis, then at those near a node
//! with dye. A wisp that fits between them, thinner than some 2 % of its distance, may be missed. Dye towards the sun
//! is summed over seven growing steps, also for every second node only.

use super::scene::Scene;
use nalgebra::Vector3;

/// Lines of sight through the corners of the picture's tiles, each divided into steps.
pub(super) struct Lines {
    /// Camera, m.
    pub from: Vector3<f64>,
    /// Lines across and down the picture.
    pub n: [usize; 2],
    /// Unit vectors, row by row.
    pub dirs: Vec<Vector3<f64>>,
    /// Distance along each line beyond which there is nothing to evaluate, m.
    pub ends: Vec<f64>,
    /// Distances at which steps end, m; the first step begins at zero.
    pub ways: Vec<f64>,
}

impl Lines {
    /// Middle and length of step `k`, m.
    pub(super) fn step(&self, k: usize) -> (f64, f64) {
        let begin = if k == 0 { 0.0 } else { self.ways[k - 1] };
        (0.5 * (begin + self.ways[k]), self.ways[k] - begin)
    }

    fn place(&self, line: usize, k: usize) -> Vector3<f64> {
        self.from + self.dirs[line] * self.step(k).0
    }
}

/// Concentration in the middle of each step, kg/m³, and dye from there to the sun, kg/m².
pub(super) struct DyeGrid {
    steps: usize,
    rho: Vec<f32>,
    above: Vec<f32>,
    /// Whether there is any dye.
    pub any: bool,
}

/// Whether number `i` of `n` is among those that are evaluated first: every other one, and the last.
fn coarse(i: usize, n: usize) -> bool {
    i.is_multiple_of(2) || i + 1 == n
}

/// Those among `n` numbers.
fn coarse_of(n: usize) -> impl Iterator<Item = usize> {
    (0..n).filter(move |i| coarse(*i, n))
}

/// Steps towards the sun end here, m.
const TOWARDS: [f64; 7] = [0.05, 0.13, 0.28, 0.55, 1.1, 2.2, 4.5];

impl DyeGrid {
    /// Evaluates the dye along all lines.
    pub(super) fn new(scene: &Scene<'_>, lines: &Lines) -> Self {
        let steps = lines.ways.len();
        let mut grid = Self {
            steps,
            rho: vec![0.0; lines.dirs.len() * steps],
            above: vec![0.0; lines.dirs.len() * steps],
            any: false,
        };
        // Dye that absorbs less than 2/1000 of the light over the whole distance counts as none, everywhere alike, so
        // that no edge shows.
        let dye = &scene.optics.dye;
        let strongest = dye.absorption.into_iter().fold(0.0, f64::max) + dye.scattering;
        let whole_m = lines.ways.last().copied().unwrap_or(1.0);
        let least = 2e-3 / (strongest * whole_m).max(1e-30);
        let ask = |line: usize, k: usize| {
            let p = lines.place(line, k);
            if lines.step(k).0 > lines.ends[line] || p.z > 0.0 {
                return 0.0;
            }
            let rho = scene.dye.concentration(&p);
            if rho < least { 0.0 } else { rho as f32 }
        };
        let [nx, ny] = lines.n;
        for j in coarse_of(ny) {
            for i in coarse_of(nx) {
                let line = j * nx + i;
                for k in coarse_of(steps) {
                    let rho = ask(line, k);
                    grid.rho[line * steps + k] = rho;
                    grid.any |= rho > 0.0;
                }
            }
        }
        if grid.any {
            grid.refine(lines, ask);
            grid.look_up(scene, lines);
        }
        grid
    }

    /// Evaluates the other nodes that have dye at a corner of their coarse cell.
    fn refine(&mut self, lines: &Lines, ask: impl Fn(usize, usize) -> f32) {
        let ([nx, ny], steps) = (lines.n, self.steps);
        let about = |i: usize, n: usize| {
            if coarse(i, n) { [i, i] } else { [i - 1, (i + 1).min(n - 1)] }
        };
        for j in 0..ny {
            for i in 0..nx {
                let line = j * nx + i;
                for k in 0..steps {
                    if coarse(i, nx) && coarse(j, ny) && coarse(k, steps) {
                        continue;
                    }
                    let found = about(j, ny).into_iter().any(|j| {
                        about(i, nx)
                            .into_iter()
                            .any(|i| (about(k, steps).into_iter()).any(|k| self.rho[(j * nx + i) * steps + k] > 0.0))
                    });
                    if found {
                        self.rho[line * steps + k] = ask(line, k);
                    }
                }
            }
        }
    }

    /// Sums the dye towards the sun at the coarse nodes with dye at or beside them, and interpolates for the nodes
    /// between.
    fn look_up(&mut self, scene: &Scene<'_>, lines: &Lines) {
        let ([nx, ny], steps) = (lines.n, self.steps);
        let to_sun = scene.optics.light.to_sun;
        for j in coarse_of(ny) {
            for i in coarse_of(nx) {
                let line = j * nx + i;
                for k in coarse_of(steps) {
                    let beside = (j.saturating_sub(1)..(j + 2).min(ny)).any(|j| {
                        (i.saturating_sub(1)..(i + 2).min(nx)).any(|i| {
                            (k.saturating_sub(1)..(k + 2).min(steps)).any(|k| self.rho[(j * nx + i) * steps + k] > 0.0)
                        })
                    });
                    if !beside {
                        continue;
                    }
                    let p = lines.place(line, k);
                    let (mut begin, mut sum) = (0.0, 0.0);
                    for end in TOWARDS {
                        let q = p + to_sun * (0.5 * (begin + end));
                        if q.z > 0.0 {
                            break;
                        }
                        sum += scene.dye.concentration(&q) * (end - begin);
                        begin = end;
                    }
                    self.above[line * steps + k] = sum as f32;
                }
            }
        }
        self.fill_between(lines);
    }

    /// Means of the neighbours, one axis after the other.
    fn fill_between(&mut self, lines: &Lines) {
        let ([nx, ny], steps) = (lines.n, self.steps);
        for j in coarse_of(ny) {
            for i in coarse_of(nx) {
                let at = (j * nx + i) * steps;
                for k in (0..steps).filter(|k| !coarse(*k, steps)) {
                    self.above[at + k] = 0.5 * (self.above[at + k - 1] + self.above[at + k + 1]);
                }
            }
            for i in (0..nx).filter(|i| !coarse(*i, nx)) {
                let at = (j * nx + i) * steps;
                for k in at..at + steps {
                    self.above[k] = 0.5 * (self.above[k - steps] + self.above[k + steps]);
                }
            }
        }
        for j in (0..ny).filter(|j| !coarse(*j, ny)) {
            for k in j * nx * steps..(j + 1) * nx * steps {
                self.above[k] = 0.5 * (self.above[k - nx * steps] + self.above[k + nx * steps]);
            }
        }
    }

    /// Concentration (kg/m³) in step `k` of a line and dye from there to the sun (kg/m²).
    pub(super) fn dye_at(&self, line: usize, k: usize) -> (f64, f64) {
        let n = line * self.steps + k;
        (f64::from(self.rho[n]), f64::from(self.above[n]))
    }
}
