//! What it costs to cut an area into cells.

use divan::Bencher;
use nalgebra::Vector2;
use std::path::Path;
use world::area::Area;
use world::obstacles::{BoxShape, CylinderShape, HeightfieldShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use world::ranges::{Finite, HeadingDeg, Positive};
use world::terrain::Terrain;
use world::units::Heading;
use world::voxels::Voxels;

fn main() {
    divan::main();
}

const BED: Terrain = Terrain::Level { depth_m: 20.0 };

fn area() -> Area {
    Area { centre: Vector2::zeros(), length_m: 200.0, width_m: 200.0, axis: Heading::from_deg(20.0) }
}

fn built(shape: ShapeSpec, east_m: f64, north_m: f64, dir: &Path) -> Obstacle {
    let spec = ObstacleSpec {
        surface: Default::default(),
        id: "o".into(),
        shape,
        east_m: Finite::new(east_m),
        north_m: Finite::new(north_m),
        base: Default::default(),
        heading_deg: HeadingDeg::new(30.0),
    };
    Obstacle::build(&spec, &BED, dir).expect("a sound obstacle")
}

/// A quay of 100 piles and a hull.
fn harbour() -> Obstacles {
    let m = Positive::new;
    let pile = || ShapeSpec::Cylinder(CylinderShape { radius_m: m(0.5), height_m: m(20.0) });
    let hull = ShapeSpec::Box(BoxShape { size_m: (m(100.0), m(16.0), m(8.0)) });
    let here = Path::new("");
    let piles = (0..100).map(|k| {
        let (i, j) = (f64::from(k % 20), f64::from(k / 20));
        built(pile(), -60.0 + 5.0 * i, 40.0 + 5.0 * j, here)
    });
    Obstacles(piles.chain([built(hull, 0.0, 0.0, here)]).collect())
}

/// A mound of 20 000 triangles.
fn reef() -> Obstacles {
    let n = 100;
    let mut text = String::new();
    let height = |i: usize, j: usize| {
        let (x, y) = (i as f64 / n as f64 - 0.5, j as f64 / n as f64 - 0.5);
        10.0 * (1.0 - 2.0 * (x * x + y * y)) + ((i * 7 + j * 13) % 5) as f64 * 0.2
    };
    text += &format!("ncols {}\nnrows {}\nxllcorner 0\nyllcorner 0\ncellsize 1\n", n + 1, n + 1);
    for j in 0..=n {
        let row: Vec<String> = (0..=n).map(|i| height(i, j).to_string()).collect();
        text += &(row.join(" ") + "\n");
    }
    let dir = tempfile::tempdir().expect("a temporary folder");
    std::fs::write(dir.path().join("reef.asc"), text).expect("a written file");
    let shape = HeightfieldShape { file: "reef.asc".into(), scale: Positive::new(1.0) };
    Obstacles(vec![built(ShapeSpec::Heightfield(shape), 0.0, 0.0, dir.path())])
}

/// 200 x 200 x 25 = 10⁶ cells with their clearances.
#[divan::bench(args = ["nothing", "harbour", "reef"], sample_count = 5, sample_size = 1)]
fn million_cells(bencher: Bencher<'_, '_>, what: &str) {
    let solids = match what {
        "harbour" => harbour(),
        "reef" => reef(),
        _ => Obstacles::default(),
    };
    bencher.bench_local(|| Voxels::new(&area(), [1.0, 1.0, 0.8], &BED, &solids).expect("cells"));
}
