use super::*;
use crate::filaments::water::fetch::{trilinear, weights};
use crate::flow::grid::{FlowGrid, GridShape};
use crate::simd::f32x4::F32x4;
use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::fields::{Flow, Mixing};
use world::terrain::Terrain;
use world::units::Heading;

struct Swirl;

/// The same, but nothing mixes upwards, and nothing rises unless the swirl does.
struct Calm {
    rises: bool,
}

impl Flow for Calm {
    fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        let u = Swirl.velocity(p, t_s);
        Vector3::new(u.x, u.y, if self.rises { u.z } else { 0.0 })
    }
    fn mixing(&self, p: &Vector3<f64>, t_s: f64) -> Mixing {
        Mixing { k_z_m2_s: 0.0, ..Swirl.mixing(p, t_s) }
    }
}

impl Flow for Swirl {
    fn velocity(&self, p: &Vector3<f64>, _: f64) -> Vector3<f64> {
        Vector3::new(0.1 - 0.01 * p.y, 0.01 * p.x, 1e-3 * p.z)
    }
    fn mixing(&self, p: &Vector3<f64>, _: f64) -> Mixing {
        Mixing { k_h_m2_s: 0.01 + 1e-4 * p.x.abs(), k_z_m2_s: 1e-3 * -p.z }
    }
}

fn scene(shape: GridShape) -> (FlowGrid, Lookup) {
    scene_in(&Swirl, shape)
}

fn scene_in(flow: &dyn Flow, shape: GridShape) -> (FlowGrid, Lookup) {
    let area = Area { centre: Vector2::new(3.0, -2.0), length_m: 100.0, width_m: 60.0, axis: Heading::from_deg(340.0) };
    let terrain = Terrain::sloping_over(&area, Heading::from_deg(250.0), 4.0, 8.0);
    let mut grid = FlowGrid::new(&area, &terrain, shape);
    grid.refresh(flow, 0.0);
    let mut cells = Lookup::new(&grid);
    cells.refresh(&grid, None);
    (grid, cells)
}

fn block(cells: &Lookup) -> Block {
    let spread = |n: usize, m: u32| (n as u32).wrapping_mul(m) as f32 / u32::MAX as f32;
    let x: [f32; BLOCK] = std::array::from_fn(|n| 40.0 * (spread(n, 0x9e37_79b9) - 0.5));
    let y: [f32; BLOCK] = std::array::from_fn(|n| 40.0 * (spread(n, 0x85eb_ca6b) - 0.5));
    let bed: [f32; BLOCK] = std::array::from_fn(|n| cells.bed(x[n], y[n]));
    Block {
        z: std::array::from_fn(|n| bed[n] * spread(n, 0xc2b2_ae35)),
        x,
        y,
        bed,
        dt: std::array::from_fn(|n| 0.5 + 0.001 * n as f32),
        number: std::array::from_fn(|n| n as u32),
        kicked: [1.0; BLOCK],
        outside: [0; BLOCK],
        moved: [0; BLOCK],
        used: BLOCK,
    }
}

#[test]
fn cells_read_the_grid_as_the_grid_reads_itself() {
    for stretch in [0.0, 0.8] {
        let (grid, cells) = scene(GridShape { stretch, ..GridShape::default() });
        let b = block(&cells);
        for l in 0..BLOCK {
            let c = cells.column(b.x[l], b.y[l]);
            let level = cells.level(b.z[l], -1.0 / b.bed[l]);
            // SAFETY: the cell was found in the grid of these nodes.
            let (q, rise) = unsafe {
                let weight = weights(c.f, c.g);
                let (below, part) = (level.below, level.part);
                trilinear::<[F32x4; 2]>(&cells, &grid.data, c.at, weight, below, part)
            };
            let got = F32x4::columns([q; 4]).map(|v| v[0]);
            let want = grid.sample(b.x[l], b.y[l], b.z[l]);
            let p = grid.world([b.x[l], b.y[l], b.z[l]]);
            let slope = grid.ground.floor(p.xy()).slope.map(|v| v as f32);
            // The grid's vertical velocity is that through surfaces of equal parts of the depth.
            let on_bed = (got[0] * slope.x + got[1] * slope.y) * b.z[l] / b.bed[l];
            for (got, want) in [got[0], got[1], got[2] + on_bed].iter().zip(want.velocity) {
                assert!((got - want).abs() < 1e-5);
            }
            assert!((got[3] - want.k_z).abs() < 1e-6);
            // Next to a level, the slope of either cell is right.
            let slope = F32x4::columns([rise; 4])[3][0] * level.per_m;
            assert!((slope - want.dk_dz).abs() < 1e-6 || !(1e-3..0.999).contains(&level.part));
            assert!((b.bed[l] - want.bed_z).abs() < 1e-5);
            assert!((cells.k_h(c).0 - want.k_h).abs() < 1e-6);
        }
    }
}

#[test]
fn all_versions_give_the_same_bits() {
    let (grid, cells) = scene(GridShape::default());
    let start = block(&cells);
    let run = |path| {
        let (mut b, mut work) = (start.clone(), Work::new());
        for n in 0..200 {
            step(path, &cells, &grid.data, [n, 7], &mut b, &mut work);
        }
        [&b.x, &b.y, &b.z, &b.bed].map(|v| v.map(f32::to_bits))
    };
    let portable = run(InstructionSet::Portable);
    assert_ne!(portable[0], start.x.map(f32::to_bits));
    for path in InstructionSet::all() {
        assert_eq!(run(path), portable, "{path:?}");
    }
}

/// A block in which one filament is kicked upwards goes the long way, and the others in it move as without it.
#[test]
fn filaments_that_are_not_kicked_upwards_move_the_same_on_the_short_way() {
    for rises in [true, false] {
        let (grid, cells) = scene_in(&Calm { rises }, GridShape::default());
        let mut nodes = grid.data.clone();
        let start = block(&cells);
        // The last one: the nodes of its column mix, and no other filament is in the cells round it.
        let (nz, _) = cells.strides();
        let at = cells.column(-40.0, -20.0).at as usize;
        for node in &mut nodes[at * nz..(at + 1) * nz] {
            node[3] = 1e-3;
        }
        for path in InstructionSet::all() {
            let run = |stray: bool| {
                let (mut b, mut work) = (start.clone(), Work::new());
                if stray {
                    (b.x[BLOCK - 1], b.y[BLOCK - 1]) = (-40.0, -20.0);
                    b.bed[BLOCK - 1] = cells.bed(-40.0, -20.0);
                    b.z[BLOCK - 1] = 0.5 * b.bed[BLOCK - 1];
                    b.dt[BLOCK - 1] = 1e-6;
                }
                for n in 0..20 {
                    step(path, &cells, &nodes, [n, 7], &mut b, &mut work);
                    assert_eq!(work.here[3][BLOCK - 1] > 0.0, stray);
                    assert!(work.here[3][..BLOCK - 1].iter().all(|k| *k == 0.0));
                }
                [&b.x, &b.y, &b.z, &b.bed].map(|v| v.map(f32::to_bits)[..BLOCK - 1].to_vec())
            };
            assert_eq!(run(false), run(true), "{path:?}");
        }
    }
}

#[test]
fn few_filaments_in_a_block_move_as_in_a_full_one() {
    let (grid, cells) = scene(GridShape::default());
    let start = block(&cells);
    let run = |path, used: usize| {
        let (mut b, mut work) = (start.clone(), Work::new());
        b.used = used;
        for n in 0..20 {
            step(path, &cells, &grid.data, [n, 7], &mut b, &mut work);
        }
        let moved = [&b.x, &b.y, &b.z, &b.bed].map(|v| v.map(f32::to_bits)[..used].to_vec());
        (moved, b.outside[..used].to_vec(), b.moved[..used].to_vec())
    };
    for path in InstructionSet::all() {
        let (full, outside, moved) = run(path, BLOCK);
        for used in [1, 5, 32, 33, 64, 65, 96, 97, 127] {
            let first = full.clone().map(|v| v[..used].to_vec());
            let whole = (first, outside[..used].to_vec(), moved[..used].to_vec());
            assert_eq!(run(path, used), whole, "{used} on {path:?}");
        }
    }
}

#[test]
fn folding_mirrors_at_bed_and_surface() {
    for (z, want) in [(-1.0, -1.0), (0.5, -0.5), (-4.5, -3.5), (4.5, -3.5), (-8.5, -0.5), (-8.0, 0.0), (9.0, -1.0)] {
        assert!((folded(z, -4.0, 0.25) - want).abs() < 1e-5, "{z}");
    }
}
