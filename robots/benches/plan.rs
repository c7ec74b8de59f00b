//! How long a plan takes: A* over a million voxels, and over the paper's cells.
//!
//! `cargo bench -p rheotaxis-robots --bench plan`

use nalgebra::{Vector2, Vector3};
use robots::handoff::BeliefGrid;
use robots::plan::{AStar, AStarParams, Cost, FreeSpace, PathStart, Planner};
use std::path::Path;
use world::obstacles::{Base, BoxShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use world::ranges::{Finite, HeadingDeg, Positive};
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

fn main() {
    divan::main();
}

/// Blocks at random on a level bed.
fn room(n: [usize; 3], cell_m: [f64; 3], blocks: usize) -> FreeSpace {
    let size = [0, 1, 2].map(|a| n[a] as f64 * cell_m[a]);
    let bed = Terrain::Level { depth_m: size[2] };
    let mut rng = Stream::new(7, "bench", "blocks");
    let mut within = |from: f64, to: f64| from + (to - from) * rng.uniform();
    let solids = (0..blocks)
        .map(|k| {
            let spec = ObstacleSpec {
                surface: Default::default(),
                id: format!("b{k}"),
                shape: ShapeSpec::Box(BoxShape {
                    size_m: (
                        Positive::new(within(2.0, 12.0)),
                        Positive::new(within(2.0, 12.0)),
                        Positive::new(within(0.3, 1.0) * size[2]),
                    ),
                }),
                east_m: Finite::new(within(0.1, 0.9) * size[0]),
                north_m: Finite::new(within(0.1, 0.9) * size[1]),
                base: Base::default(),
                heading_deg: HeadingDeg::new(within(0.0, 360.0)),
            };
            Obstacle::build(&spec, &bed, Path::new(".")).expect("a legal block")
        })
        .collect();
    let lattice =
        BeliefGrid { corner: Vector3::new(0.0, 0.0, -size[2]), axes: [Vector2::x(), Vector2::y()], cell_m, n };
    let mut room = FreeSpace::new(lattice, 0.5, 4.0);
    room.chart(&Obstacles(solids), &bed, &|_, _| -size[2] / 2.0);
    room
}

fn plan(bencher: divan::Bencher, room: &FreeSpace, params: &AStarParams, to: [f64; 3]) {
    let n = room.lattice().n;
    let c = room.lattice().cell_m;
    let place = |part: [f64; 3]| {
        let at = [0, 1, 2].map(|a| part[a] * n[a] as f64 * c[a]);
        room.lattice().corner + Vector3::new(at[0], at[1], at[2])
    };
    let start = PathStart { p_W: place([0.02, 0.03, 0.5]), heading: Heading::from_deg(45.0), turning_radius_m: 12.0 };
    let goal = place(to);
    let mut planner = AStar::new(params).expect("legal");
    planner.plan(room, &start, &goal).expect("a path");
    bencher.bench_local(|| planner.plan(room, &start, &goal).expect("a path"));
}

/// Corner to corner through a million voxels with 60 blocks.
#[divan::bench(sample_count = 20, sample_size = 1)]
fn million_voxels(bencher: divan::Bencher) {
    let room = room([200, 200, 25], [1.0; 3], 60);
    plan(bencher, &room, &AStarParams::default(), [0.98, 0.97, 0.5]);
}

/// The same as a cube.
#[divan::bench(sample_count = 20, sample_size = 1)]
fn million_voxels_cube(bencher: divan::Bencher) {
    let room = room([100, 100, 100], [1.0; 3], 30);
    plan(bencher, &room, &AStarParams::default(), [0.98, 0.97, 0.9]);
}

/// A hundred by a hundred metres in cells of one metre.
#[divan::bench(sample_count = 50, sample_size = 1)]
fn hectare(bencher: divan::Bencher) {
    let room = room([100, 100, 1], [1.0, 1.0, 10.0], 12);
    plan(bencher, &room, &AStarParams::default(), [0.98, 0.97, 0.5]);
}

/// The paper's cells and costs.
#[divan::bench(sample_count = 50, sample_size = 1)]
fn paper(bencher: divan::Bencher) {
    let room = room([40, 25, 1], [2.5, 4.0, 10.0], 3);
    let params = AStarParams { cost: Cost::Paper, ..AStarParams::default() };
    plan(bencher, &room, &params, [0.9, 0.9, 0.5]);
}

/// The hardest: walls that leave a gap at alternate ends. The goal is at the near or at the far end of the last
/// corridor: 610 000 or 680 000 of 770 000 free voxels must be opened.
#[divan::bench(args = [0.03, 0.97], sample_count = 10, sample_size = 1)]
fn million_voxels_between_walls(bencher: divan::Bencher, north: f64) {
    let (n, size) = ([200, 200, 25], [200.0, 200.0, 25.0]);
    let bed = Terrain::Level { depth_m: size[2] };
    let walls = (1..10).map(|k| {
        let spec = ObstacleSpec {
            surface: Default::default(),
            id: format!("w{k}"),
            shape: ShapeSpec::Box(BoxShape { size_m: (Positive::new(1.0), Positive::new(180.0), Positive::new(25.0)) }),
            east_m: Finite::new(20.0 * f64::from(k)),
            north_m: Finite::new(if k % 2 == 0 { 90.0 } else { 110.0 }),
            base: Base::default(),
            heading_deg: HeadingDeg::new(90.0),
        };
        Obstacle::build(&spec, &bed, Path::new(".")).expect("a legal wall")
    });
    let solids = Obstacles(walls.collect());
    let lattice = BeliefGrid {
        corner: Vector3::new(0.0, 0.0, -size[2]),
        axes: [Vector2::x(), Vector2::y()],
        cell_m: [1.0; 3],
        n,
    };
    let mut room = FreeSpace::new(lattice, 0.5, 4.0);
    room.chart(&solids, &bed, &|_, _| -size[2] / 2.0);
    plan(bencher, &room, &AStarParams::default(), [0.98, north, 0.5]);
}
