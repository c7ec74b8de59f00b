//! Even dye stays even round solids: in every open cell of the blockage grid, in still and in flowing water.
//!
//! The water around is even too: before each step the cells in a frame along the sides are filled again; no filament
//! crosses that frame in one step. Counts are pooled over neighbouring cells and over several times, between which the
//! water in a pool is exchanged. With n filaments in a pool they are Poisson: noise of 1/√n, 1 % for 10⁴.

use super::water::{plume_in, source};
use crate::filaments::plume::Plume;
use crate::flow::blockage::Cells;
use crate::flow::blockage::tests::{area, block, eastward, pile, solids, spec};
use crate::flow::tests::kit::{meander, rough};
use crate::flow::{Water, WaterSpec};
use nalgebra::Vector2;
use std::collections::BTreeMap;
use std::sync::Arc;
use world::area::Area;
use world::fields::Flow;
use world::obstacles::Obstacles;
use world::ranges::NonNegative;
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
        let corner = area.world(Vector2::new(0.49 * area.length_m, 0.49 * area.width_m));
        let nozzle = source(0.5, 1e-6, 0.001, 0.1).at(corner.x, corner.y);
        let (water, plume) = plume_in(spec, nozzle, area, bed, solids, 5.0);
        let mut scene = Self { water, plume, rng: Stream::new(4, "test", "even"), density, frame };
        scene.pour(|_| true);
        scene
    }

    pub(super) fn cells(&self) -> Arc<Cells> {
        self.water.blocked().unwrap().cells().clone()
    }

    fn in_frame(&self, [i, j, _]: [usize; 3]) -> bool {
        let (f, n) = (self.frame, self.cells().n);
        i < f || j < f || i + f >= n[0] || j + f >= n[1]
    }

    /// All cells of the water.
    fn each(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        let n = self.cells().n;
        (0..n[0] * n[1] * n[2]).map(move |c| [c / (n[1] * n[2]), c / n[2] % n[1], c % n[2]])
    }

    /// Height of the bed under a place, in the plume's grid.
    fn bed(&self, p: Vector2<f64>) -> f64 {
        let [x, y, _] = self.plume.grid().local(&p.push(0.0));
        f64::from(self.plume.cells.bed(x, y))
    }

    /// Number of filaments in a cell of even dye.
    fn even(&self, [i, j, k]: [usize; 3]) -> f64 {
        let cells = self.cells();
        let depth = -self.bed(cells.place(i as f64 + 0.5, j as f64 + 0.5));
        self.density * cells.d[0] * cells.d[1] * depth * (cells.s[k + 1] - cells.s[k])
    }

    /// Fills open cells with even dye.
    fn pour(&mut self, of: impl Fn([usize; 3]) -> bool) {
        let cells = self.cells();
        for at in self.each().filter(|at| cells.open[cells.cell(*at)] && of(*at)) {
            let [i, j, k] = at;
            let count = (self.even(at) + self.rng.uniform()) as usize;
            for _ in 0..count {
                let [a, b, c] = [0; 3].map(|_| self.rng.uniform());
                let p = cells.place(i as f64 + a, j as f64 + b);
                let bed = self.bed(p);
                let z = bed * (1.0 - cells.s[k] - c * (cells.s[k + 1] - cells.s[k]));
                let p = self.plume.grid().local(&p.push(z));
                self.plume.stores_mut()[0].push(p, bed as f32, 0.0);
            }
        }
    }

    /// The cell of a filament, by its ends.
    fn cell_of(&self, f: [f32; 3]) -> [usize; 3] {
        let cells = self.cells();
        let c = cells.in_cells(self.plume.grid().world(f).xy());
        let s = f64::from((1.0 - f[2] / self.plume.cells.bed(f[0], f[1])).clamp(0.0, 1.0));
        let of = |d: usize| (c[d].max(0.0) as usize).min(cells.n[d] - 1);
        [of(0), of(1), cells.level(s)]
    }

    /// Fills the frame again and drifts.
    fn step(&mut self, n: u32, dt: f64) {
        let inside: Vec<[f32; 3]> = self.plume.all().filter(|f| !self.in_frame(self.cell_of(*f))).collect();
        self.plume.stores_mut()[0].truncate(0);
        for f in inside {
            let bed = self.plume.cells.bed(f[0], f[1]);
            self.plume.stores_mut()[0].push(f, bed, 0.0);
        }
        let frame: Vec<bool> = self.each().map(|at| self.in_frame(at)).collect();
        let cells = self.cells();
        self.pour(|at| frame[cells.cell(at)]);
        self.water.advance(dt * f64::from(n + 1));
        self.plume.drift_on(&self.water, dt, n..n + 1);
    }

    /// Adds the filaments in each cell to `counts`.
    fn count(&self, counts: &mut Vec<f64>) {
        let cells = self.cells();
        counts.resize(cells.open.len(), 0.0);
        for f in self.plume.all() {
            counts[cells.cell(self.cell_of(f))] += 1.0;
        }
    }

    /// Number of filaments, and that of even dye, in each pool of open cells outside the frame. No filament may be in a
    /// closed cell.
    fn pools(&self, counts: &[f64], shots: f64, pool: impl Fn([usize; 3]) -> usize) -> Vec<[f64; 2]> {
        let cells = self.cells();
        let mut pools = BTreeMap::<usize, [f64; 2]>::new();
        for at in self.each() {
            let got = counts[cells.cell(at)];
            if !cells.open[cells.cell(at)] {
                // On a shared face, rounding may assign a filament to either side.
                assert!(got <= 1e-4 * shots * self.plume.len() as f64 / 100.0 + 2.0);
            } else if !self.in_frame(at) {
                let pool = pools.entry(pool(at)).or_default();
                pool[0] += got;
                pool[1] += self.even(at) * shots;
            }
        }
        pools.into_values().collect()
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
            scene.step(n, dt);
            n += 1;
        }
        scene.count(&mut counts);
    }
    let mut ratios = scene.pools(&counts, f64::from(shots.count), pool);
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
