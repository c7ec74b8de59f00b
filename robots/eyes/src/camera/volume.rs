//! Light from the water itself: what water, dye and lamp send into each line of sight up to any distance.
//!
//! *Source:* single scattering along a line of sight, dL/ds = -c L + b E p + glow (Mobley 1994, Light and Water,
//! section 5.2; for cameras Jaffe 1990, IEEE J. Oceanic Eng. 15, 101); each step is solved exactly with the values in
//! its middle.
//!
//! *Parameters:* a tile is one eightieth of the picture's longer side wide; 96 steps, which grow with distance from 2
//! % of the range on, reach to where 3·10⁻⁴ of the clearest colour is left, but at most 80 m.
//!
//! *Deviations:* light scattered more than once by dye, or forward on its way to the camera, is not added: small
//! things look sharper than they are. Daylight reaches dye from two sides: the share from the camera's half comes
//! along the line of sight, the rest from the sun's direction; the lamp's light comes along the line of sight.

use super::bands::{N, Rgb, Spectrum, each, see};
use super::dye_grid::{DyeGrid, Lines};
use super::light::{SCATTER_COSINE, phase};
use super::scene::{Optics, Scene};
use nalgebra::Vector3;
use robots::sense::{CameraSpec, LampSpec};
use std::f64::consts::{LN_2, PI};
use world::frames::Pose;
use world::math;

/// Tiles along the picture's longer side.
const TILES: u32 = 80;
/// Steps along a line.
const STEPS: usize = 96;
/// End of the first step, as a share of the range.
const FIRST: f64 = 0.02;
/// Optical thickness of the clearest colour up to which a line is followed, and its greatest length, m.
const FARTHEST: (f64, f64) = (8.0, 80.0);

/// A lamp in the world.
pub(super) struct Lamp {
    p_W: Vector3<f64>,
    axis: Vector3<f64>,
    candela: f64,
    half_rad: f64,
}

impl Lamp {
    pub(super) fn new(spec: &LampSpec, pose_WC: &Pose) -> Self {
        let beside = Vector3::new(spec.right_m.get(), spec.down_m.get(), 0.0);
        Self {
            p_W: pose_WC.point(beside),
            axis: pose_WC.R_WB * Vector3::z(),
            candela: spec.candela.get(),
            half_rad: spec.half_deg.get().to_radians(),
        }
    }

    /// Light on a face turned to the lamp, lx, and the direction to the lamp.
    pub(super) fn on(&self, p: &Vector3<f64>, o: &Optics) -> (Spectrum, Vector3<f64>) {
        let to = self.p_W - p;
        let way = to.norm().max(0.05);
        let to = to / way;
        let off = math::acos((-to.dot(&self.axis)).clamp(-1.0, 1.0)) / self.half_rad;
        let bare = self.candela * math::exp(-LN_2 * off * off) / (way * way);
        let lx = each(|i| bare * math::exp(-o.clarity.attenuation[i] * way));
        (lx, to)
    }
}

/// The light of the water up to some distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Veil {
    /// Radiance of the water alone as the camera sees it, cd/m².
    pub water: Rgb,
    /// The same with its dye.
    pub dyed: Rgb,
    /// Share of light that the dye transmits.
    pub passes: Spectrum,
}

/// Numbers of a veil.
const ROW: usize = 6 + N;

/// The veil at the ends of all steps of all lines.
pub(super) struct Volume {
    tile: u32,
    lines: Lines,
    /// Without dye, with dye, and transmission.
    veils: Vec<[f32; ROW]>,
}

impl Volume {
    /// How far a line is followed in a water, m.
    pub(super) fn range_m(o: &Optics) -> f64 {
        let clearest = o.clarity.attenuation.into_iter().fold(f64::INFINITY, f64::min);
        (FARTHEST.0 / clearest).min(FARTHEST.1)
    }

    /// Follows the lines of sight of a camera through the scene's water, as far as the picture's pixels see; `seen_m`
    /// are their distances, row by row.
    pub(super) fn new(
        camera: &CameraSpec,
        pose_WC: &Pose,
        scene: &Scene<'_>,
        lamp: Option<&Lamp>,
        seen_m: impl Iterator<Item = f64>,
    ) -> Self {
        let range = Self::range_m(scene.optics);
        let tile = camera.width.max(camera.height).div_ceil(TILES);
        let n = [camera.width, camera.height].map(|n| n.div_ceil(tile) as usize + 1);
        let from = pose_WC.p_WB;
        let at = |n: usize| f64::from(n as u32 * tile);
        let dirs: Vec<_> = (0..n[0] * n[1]).map(|k| pose_WC.R_WB * camera.ray(at(k % n[0]), at(k / n[0]))).collect();
        let growth = math::powf(1.0 / FIRST, 1.0 / (STEPS - 1) as f64);
        let mut ways = vec![FIRST * range; STEPS];
        for k in 1..STEPS {
            ways[k] = ways[k - 1] * growth;
        }
        // A little behind bed and surface, for neighbouring lines that go farther.
        let ends = (dirs.iter()).map(|dir| 1.15 * scene.shell(&from, dir, range).way_m).collect();
        let lines = Lines { from, n, dirs, ends, ways };
        let dye = DyeGrid::new(scene, &lines);
        let mut volume = Self { tile, veils: Vec::with_capacity(lines.dirs.len() * STEPS), lines };
        let clear: Vec<Spectrum> = (0..STEPS)
            .map(|k| each(|i| math::exp(-scene.optics.clarity.attenuation[i] * volume.lines.step(k).1)))
            .collect();
        for (line, far_m) in volume.farthest(camera.width, seen_m).into_iter().enumerate() {
            let (last, _) = volume.step_of(far_m);
            volume.follow(scene.optics, &dye, lamp, line, &clear[..=last]);
            // Nobody looks farther.
            volume.veils.resize((line + 1) * STEPS, [f32::NAN; ROW]);
        }
        volume
    }

    /// The greatest distance in the tiles around each line, m.
    fn farthest(&self, width: u32, seen_m: impl Iterator<Item = f64>) -> Vec<f64> {
        let mut far_m = vec![0.0_f64; self.lines.dirs.len()];
        for (n, way_m) in (0_u32..).zip(seen_m) {
            let (x, y) = (f64::from(n % width) + 0.5, f64::from(n / width) + 0.5);
            for (line, _) in self.around(x, y) {
                far_m[line] = far_m[line].max(way_m);
            }
        }
        far_m
    }

    fn follow(&mut self, o: &Optics, dye: &DyeGrid, lamp: Option<&Lamp>, line: usize, clear: &[Spectrum]) {
        let (w, d) = (&o.clarity, &o.dye);
        let dir = self.lines.dirs[line];
        let (thrown, front) = (o.light.scattered(&dir), o.light.from_front(&dir));
        let (mut left, mut passes) = ([1.0; N], [1.0; N]);
        let (mut water, mut dyed) = ([0.0; N], [0.0; N]);
        let mut parted = false;
        for (k, clear) in clear.iter().enumerate() {
            let (way, length) = self.lines.step(k);
            let p = self.lines.from + dir * way;
            let day = o.light.irradiance(p.z);
            let (rho, above) = if dye.any { dye.dye_at(line, k) } else { (0.0, 0.0) };
            let lamp = lamp.map(|l| {
                let (lx, to) = l.on(&p, o);
                (lx, phase(SCATTER_COSINE, to.dot(&dir)))
            });
            parted |= rho > 0.0;
            let before = passes;
            let from_lamp = each(|i| lamp.map_or(0.0, |(lx, p)| lx[i] * p));
            // What the dye of this step takes along the way, and what that above it has taken of the sun's light.
            let taken = d.absorption.map(|a| rho * a);
            let under = if rho > 0.0 { d.absorption.map(|a| math::exp(-a * above)) } else { [1.0; N] };
            for i in 0..N {
                let (b, c) = (w.scattering[i], w.attenuation[i]);
                let got = left[i] * (1.0 - clear[i]) / c;
                water[i] += got * b * (day[i] * thrown + from_lamp[i]);
                if !parted {
                    dyed[i] = water[i];
                } else if rho == 0.0 {
                    let lit = day[i] * thrown + from_lamp[i] * before[i];
                    dyed[i] += got * before[i] * b * lit;
                } else {
                    // Light from the camera's side has come along the line of sight, the rest from the sun.
                    let all = c + taken[i] + rho * d.scattering;
                    let along = |rate: f64| (1.0 - math::exp(-rate * length)) / rate;
                    let back = along(all);
                    let ahead = |j: usize| before[j] * along(all + taken[j]);
                    let day_on = |j: usize, ahead: f64| day[j] * (front * ahead + (1.0 - front) * (under[j] * back));
                    let lamp_on = |j: usize, ahead: f64| lamp.map_or(0.0, |(lx, _)| lx[j] * ahead);
                    let evenly = rho / (4.0 * PI);
                    let own = ahead(i);
                    let mut sum = b * from_lamp[i] * own + (b * thrown + d.scattering * evenly) * day_on(i, own);
                    for j in (0..N).filter(|j| d.glow[i][*j] > 0.0) {
                        let there = ahead(j);
                        sum += evenly * d.glow[i][j] * (day_on(j, there) + lamp_on(j, there));
                    }
                    dyed[i] += left[i] * before[i] * sum;
                    passes[i] *= math::exp(-all * length) / clear[i];
                }
                left[i] *= clear[i];
            }
            let mut row = [0.0; ROW];
            let seen = (see(&water).into_iter()).chain(see(&dyed)).chain(passes);
            for (to, v) in row.iter_mut().zip(seen) {
                *to = v as f32;
            }
            self.veils.push(row);
        }
    }

    /// The veil before a thing at the distance `way_m` behind the place (x, y) of the picture, pixels.
    pub(super) fn before(&self, x: f64, y: f64, way_m: f64) -> Veil {
        let (k, part) = self.step_of(way_m);
        let mut sum = [0.0; ROW];
        for (line, weight) in self.around(x, y) {
            let far = &self.veils[line * STEPS + k];
            let none: [f32; ROW] = std::array::from_fn(|k| if k < 6 { 0.0 } else { 1.0 });
            let near = if k == 0 { &none } else { &self.veils[line * STEPS + k - 1] };
            for (sum, (near, far)) in sum.iter_mut().zip(near.iter().zip(far)) {
                let (near, far) = (f64::from(*near), f64::from(*far));
                *sum += weight * (near + part * (far - near));
            }
        }
        Veil { water: [sum[0], sum[1], sum[2]], dyed: [sum[3], sum[4], sum[5]], passes: each(|i| sum[6 + i]) }
    }

    /// The step in which a distance ends, and the part of it that is passed.
    fn step_of(&self, way_m: f64) -> (usize, f64) {
        let ways = &self.lines.ways;
        let grown = math::ln(way_m.max(1e-9) / ways[0]) / math::ln(ways[1] / ways[0]);
        if way_m <= ways[0] {
            (0, way_m / ways[0])
        } else {
            let k = ((grown as usize) + 1).min(STEPS - 1);
            let begin = ways[k - 1];
            (k, ((way_m - begin) / (ways[k] - begin)).clamp(0.0, 1.0))
        }
    }

    /// The lines at the corners of the tile around a place of the picture, and their weights there.
    fn around(&self, x: f64, y: f64) -> [(usize, f64); 4] {
        let [nx, ny] = self.lines.n;
        let cell = |x: f64, n: usize| {
            let x = x / f64::from(self.tile);
            let i = (x as usize).min(n - 2);
            (i, x - i as f64)
        };
        let ((i, fx), (j, fy)) = (cell(x, nx), cell(y, ny));
        [
            (j * nx + i, (1.0 - fx) * (1.0 - fy)),
            (j * nx + i + 1, fx * (1.0 - fy)),
            ((j + 1) * nx + i, (1.0 - fx) * fy),
            ((j + 1) * nx + i + 1, fx * fy),
        ]
    }
}
