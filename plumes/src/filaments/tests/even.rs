//! Even dye stays even round solids: in every open cell of the blockage grid, in still and in flowing water.
//!
//! The water around is even too: before each step the cells in a frame along the sides are filled again; no filament
//! crosses that frame in one step. Counts are pooled over neighbouring cells and over several times, between which the
//! water in a pool is exchanged. With n filaments in a pool they are Poisson: noise of 1/√n, 1 % for 10⁴.

use super::water::source;
use crate::filaments::plume::{Plume, PlumeSettings};
use crate::flow::blockage::Cells;
use crate::flow::blockage::tests::{area, block, eastward, pile, solids, spec};
use crate::flow::tests::kit::{meander, rough};
use crate::flow::{Water, WaterSpec};
use nalgebra::Vector2;
use world::area::Area;
use world::fields::Flow;
use world::obstacles::Obstacles;
use world::ranges::{Finite, NonNegative};
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

pub(super) struct Scene {
    water: Water,
    plume: Plume,
    rng: Stream,
    /// Filaments per m³.
    density: f64,
    /// Width of the frame, in columns.
    frame: usize,
}

impl Scene {
    pub(super) fn new(
        spec: &WaterSpec,
        area: &Area,
        bed: &Terrain,
        solids: &Obstacles,
        density: f64,
        frame: usize,
    ) -> Self {
        let water = spec.build_round(area, bed, solids, 5).unwrap();
        let settings = PlumeSettings { grid: spec.blockage.as_ref().unwrap().grid_shape(), refresh_s: 5.0 };
        let mut nozzle = source(0.5, 1e-6, 0.001, 0.1);
        let corner = area.world(Vector2::new(0.49 * area.length_m, 0.49 * area.width_m));
        nozzle.east_m = Finite::new(corner.x);
        nozzle.north_m = Finite::new(corner.y);
        let plume = Plume::new(&[nozzle], area, bed, 3, settings)
            .unwrap()
            .with_obstacles(solids.clone())
            .unwrap()
            .led_round(water.blocked())
            .unwrap();
        let mut scene = Self { water, plume, rng: Stream::new(4, "test", "even"), density, frame };
        scene.pour(|_, _| true);
        scene
    }

    pub(super) fn cells(&self) -> std::sync::Arc<Cells> {
        self.water.blocked().unwrap().cells().clone()
    }

    fn in_frame(&self, cells: &Cells, i: usize, j: usize) -> bool {
        let f = self.frame;
        i < f || j < f || i + f >= cells.n[0] || j + f >= cells.n[1]
    }

    /// Fills the open cells of columns with even dye.
    fn pour(&mut self, of: impl Fn(usize, usize) -> bool) {
        let cells = self.cells();
        for i in 0..cells.n[0] {
            for j in (0..cells.n[1]).filter(|j| of(i, *j)) {
                for k in 0..cells.n[2] {
                    if cells.open[cells.cell([i, j, k])] {
                        self.fill(&cells, [i, j, k]);
                    }
                }
            }
        }
    }

    fn fill(&mut self, cells: &Cells, [i, j, k]: [usize; 3]) {
        let bed = |p: Vector2<f64>, plume: &Plume| {
            let [x, y, _] = plume.grid().local(&p.push(0.0));
            f64::from(plume.cells.bed(x, y))
        };
        let ds = cells.s[k + 1] - cells.s[k];
        let middle = cells.place(i as f64 + 0.5, j as f64 + 0.5);
        let volume = cells.d[0] * cells.d[1] * ds * -bed(middle, &self.plume);
        let count = (self.density * volume + self.rng.uniform()) as usize;
        for _ in 0..count {
            let [a, b, c] = [0; 3].map(|_| self.rng.uniform());
            let p = cells.place(i as f64 + a, j as f64 + b);
            let bed = bed(p, &self.plume);
            let z = bed * (1.0 - cells.s[k] - c * ds);
            let p = self.plume.grid().local(&p.push(z));
            self.plume.stores_mut()[0].push(p, bed as f32, 0.0);
        }
    }

    /// Fills the frame again and drifts.
    fn step(&mut self, t: f64, dt: f64) {
        let cells = self.cells();
        let keep: Vec<[f32; 4]> = {
            let s = &self.plume.stores_mut()[0];
            (0..s.len()).map(|n| [s.x[n], s.y[n], s.z[n], s.bed[n]]).collect()
        };
        let grid = self.plume.grid().clone();
        let store = &mut self.plume.stores_mut()[0];
        store.truncate(0);
        for [x, y, z, bed] in keep {
            let c = cells.in_cells(grid.world([x, y, z]).xy());
            let f = self.frame as f64;
            let inside = (0..2).all(|d| c[d] >= f && c[d] < cells.n[d] as f64 - f);
            if inside {
                store.push([x, y, z], bed, 0.0);
            }
        }
        let frame: Vec<bool> =
            (0..cells.n[0] * cells.n[1]).map(|c| self.in_frame(&cells, c / cells.n[1], c % cells.n[1])).collect();
        self.pour(|i, j| frame[i * cells.n[1] + j]);
        self.water.advance(t + dt);
        self.plume.drift(&self.water, t, t + dt);
    }

    /// Adds the filaments in each cell to `counts`.
    fn count(&self, counts: &mut Vec<f64>) {
        let cells = self.cells();
        counts.resize(cells.open.len(), 0.0);
        for f in self.plume.all() {
            let c = cells.in_cells(self.plume.grid().world(f).xy());
            let bed = self.plume.cells.bed(f[0], f[1]);
            let s = f64::from((1.0 - f[2] / bed).clamp(0.0, 1.0));
            let of = |d: usize| (c[d].max(0.0) as usize).min(cells.n[d] - 1);
            counts[cells.cell([of(0), of(1), cells.level(s)])] += 1.0;
        }
    }

    /// Number of filaments over the number for even dye, in each pool of open cells outside the frame. No filament may
    /// be in a closed cell.
    fn ratios(&self, counts: &[f64], shots: f64, pool: impl Fn([usize; 3]) -> usize) -> Vec<[f64; 2]> {
        let cells = self.cells();
        let mut pools: Vec<[f64; 2]> = Vec::new();
        for i in 0..cells.n[0] {
            for j in 0..cells.n[1] {
                let middle = cells.place(i as f64 + 0.5, j as f64 + 0.5);
                let grid = self.plume.grid();
                let [x, y, z] = grid.local(&middle.push(0.0));
                let depth = -f64::from(grid.sample(x, y, z).bed_z);
                for k in 0..cells.n[2] {
                    let at = cells.cell([i, j, k]);
                    if !cells.open[at] {
                        // On a shared face, rounding may assign a filament to either side.
                        assert!(counts[at] <= 1e-4 * shots * self.plume.len() as f64 / 100.0 + 2.0);
                        continue;
                    }
                    if self.in_frame(&cells, i, j) {
                        continue;
                    }
                    let volume = cells.d[0] * cells.d[1] * depth * (cells.s[k + 1] - cells.s[k]);
                    let n = pool([i, j, k]);
                    if pools.len() <= n {
                        pools.resize(n + 1, [0.0; 2]);
                    }
                    pools[n][0] += counts[at];
                    pools[n][1] += volume * self.density * shots;
                }
            }
        }
        pools.retain(|p| p[1] > 0.0);
        pools
    }
}

/// The greatest deviation from even over pools (filaments, expected filaments); for a pool with less than 6000, only
/// the part beyond four times its noise.
fn worst(pools: &[[f64; 2]]) -> f64 {
    let off = |[got, even]: &[f64; 2]| {
        let noise = if *even < 6000.0 { 4.0 / even.sqrt() } else { 0.0 };
        (got / even - 1.0).abs() - noise
    };
    pools.iter().map(off).fold(0.0, f64::max)
}

/// When a scene is counted: first after so many steps, then every so many, so many times.
#[derive(Clone, Copy)]
pub(super) struct Shots {
    pub(super) first: u32,
    pub(super) then: u32,
    pub(super) count: u32,
}

/// Drifts and counts; each pool of cells must be even, and there must be at least so many pools.
#[track_caller]
pub(super) fn stays_even(mut scene: Scene, dt: f64, shots: Shots, pool: impl Fn([usize; 3]) -> usize, least: usize) {
    let (mut counts, mut n) = (Vec::new(), 0);
    for shot in 0..shots.count {
        while n < shots.first + shot * shots.then {
            scene.step(dt * f64::from(n), dt);
            n += 1;
        }
        scene.count(&mut counts);
    }
    let mut ratios = scene.ratios(&counts, f64::from(shots.count), pool);
    let off = worst(&ratios);
    let uneven = |[got, even]: &[f64; 2]| (got / even - 1.0).abs();
    ratios.sort_by(|a, b| uneven(b).total_cmp(&uneven(a)));
    assert!(off < 0.05 && ratios.len() >= least, "{off} of {}: {:?}", ratios.len(), &ratios[..5]);
}

/// Pools of so many columns each way and so many levels.
pub(super) fn blocks_of(columns: usize, levels: usize) -> impl Fn([usize; 3]) -> usize {
    move |[i, j, k]| ((i / columns) * 100 + j / columns) * 100 + k / levels
}

pub(super) fn mixing(spec: &mut WaterSpec, k_h: f64, k_z: f64) {
    spec.mixing.horizontal_m2_s = NonNegative::new(k_h);
    spec.mixing.background_vertical_m2_s = NonNegative::new(k_z);
}

/// A block 16 m wide in a stream of 0.3 m/s with cells of 2 m, and one 10 m wide with cells of 1 m; each column six
/// times, 4 to 7 m of way apart: 3600 filaments. In 100 and 160 s the water moves 5 to 8 block lengths.
#[test]
fn behind_a_block() {
    let bed = Terrain::Level { depth_m: 6.0 };
    for (cell, frame, wide, size, dt, shots) in [
        (2.0, 2, 16.0, [40.0, 36.0], 6.0, Shots { first: 7, then: 4, count: 6 }),
        (1.0, 3, 10.0, [28.0, 20.0], 4.5, Shots { first: 7, then: 3, count: 6 }),
    ] {
        let solids = solids(&[(block([6.0, wide, 6.0]), 1.0, -7.0, 90.0)], &bed);
        let spec = eastward(0.3, spec(cell, 2, 0.0));
        let density = 600.0 / (cell * cell * 6.0);
        let area = area(size[0], size[1], 90.0);
        let scene = Scene::new(&spec, &area, &bed, &solids, density, frame);
        stays_even(scene, dt, shots, blocks_of(1, 2), 100);
    }
}

/// Still water with long kicks, 1.4 m per step beside cells of 2 m: against a turned block, a pile and a thin wall, in
/// a turned area. Two levels of each column five times 10 s apart: 7400 and more, of which a kick leaves a part in its
/// place.
#[test]
fn in_still_water() {
    let bed = Terrain::Level { depth_m: 6.0 };
    let solids = solids(
        &[
            (block([9.0, 7.0, 4.0]), 0.0, -12.0, 60.0),
            (pile(3.0, 6.0), 9.0, 1.0, 0.0),
            (block([0.2, 8.0, 6.0]), 0.4, 1.0, 20.0),
        ],
        &bed,
    );
    let mut spec = eastward(0.0, spec(2.0, 4, 0.0));
    mixing(&mut spec, 0.2, 0.02);
    let scene = Scene::new(&spec, &area(28.0, 30.0, 20.0), &bed, &solids, 140.0, 3);
    stays_even(scene, 5.0, Shots { first: 4, then: 2, count: 5 }, blocks_of(1, 2), 50);
}

/// A meander, a log law, a sloping bed (1 in 9) and a block that the stream passes over. 30 filaments per m³, pooled
/// over the open ones of 2 x 2 columns and 2 levels, twelve times 8 s apart: 1.3 % and less.
#[test]
fn in_unsteady_water_over_a_slope() {
    let area = area(36.0, 36.0, 70.0);
    let bed = Terrain::sloping_over(&area, Heading::from_deg(290.0), 4.0, 8.0);
    let solids = solids(&[(block([8.0, 6.0, 3.0]), 4.0, -7.0, 90.0)], &bed);
    let mut spec = eastward(0.2, spec(2.0, 5, 0.0));
    spec.currents.push(meander(0.05, 0.02, 9.0));
    spec.bed = rough(0.001, 2.0);
    mixing(&mut spec, 0.01, 1e-3);
    let scene = Scene::new(&spec, &area, &bed, &solids, 30.0, 2);
    stays_even(scene, 2.0, Shots { first: 20, then: 4, count: 12 }, blocks_of(2, 2), 90);
}
