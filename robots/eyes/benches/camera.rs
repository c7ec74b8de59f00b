//! How long a picture takes: 640 × 480 pixels, a dark block and a meandering plume of 1500 puffs.
//!
//! `cargo bench -p rheotaxis-eyes --bench camera`

use divan::Bencher;
use eyes::camera::{ClaritySpec, Optics, OpticsSpec, Scene, render};
use nalgebra::Vector3;
use robots::sense::{CameraSpec, looking};
use std::path::Path;
use world::fields::{Clean, Concentration};
use world::math;
use world::obstacles::{Base, BoxShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use world::ranges::{Finite, HeadingDeg, Positive};
use world::seeds::Stream;
use world::terrain::Terrain;

fn main() {
    divan::main();
}

/// Puffs of a source, sorted along the flow: middle and size.
struct Puffs {
    puffs: Vec<(Vector3<f64>, f64)>,
    kg: f64,
    reach: f64,
}

impl Puffs {
    /// 25 mg/s in 5 puffs a second, carried at 0.1 m/s.
    fn new(from: Vector3<f64>) -> Self {
        let mut r = Stream::new(3, "bench", "puffs");
        let (mut y, mut v) = (0.0, 0.0);
        let puffs: Vec<_> = (0..1500)
            .map(|k| 0.2 * f64::from(k))
            .map(|t: f64| {
                v += 0.02 * r.normal() - 0.05 * v;
                y = 0.98 * y + 0.3 * v;
                let spread = 0.03 * t.sqrt();
                let side = y * t.sqrt() + spread * r.normal();
                let p = from + Vector3::new(0.1 * t, side, 0.5 * spread * r.normal());
                (p, (0.001 + 0.001 * t).sqrt())
            })
            .collect();
        let reach = 4.0 * puffs.last().expect("there are some").1;
        Self { puffs, kg: 5e-6, reach }
    }
}

impl Concentration for Puffs {
    fn concentration(&self, p: &Vector3<f64>) -> f64 {
        let from = (self.puffs).partition_point(|c| c.0.x < p.x - self.reach);
        (self.puffs[from..].iter())
            .take_while(|c| c.0.x <= p.x + self.reach)
            .map(|(c, s)| ((p - c).norm_squared() / (s * s), s))
            .filter(|(d2, _)| *d2 < 16.0)
            .map(|(d2, s)| self.kg / (15.749_61 * s * s * s) * math::exp(-0.5 * d2))
            .sum()
    }
}

#[divan::bench(sample_count = 10, args = [("clean", 8.0), ("plume", 20.0), ("plume", 8.0), ("plume", 3.0)])]
fn picture(bencher: Bencher, (water, visibility_m): (&str, f64)) {
    let terrain = Terrain::Level { depth_m: 6.0 };
    let m = Positive::new;
    let block = ObstacleSpec {
        id: "source".into(),
        shape: ShapeSpec::Box(BoxShape { size_m: (m(0.5), m(1.0), m(0.5)) }),
        east_m: Finite::new(4.0),
        north_m: Finite::new(0.0),
        base: Base::default(),
        heading_deg: HeadingDeg::new(20.0),
        surface: Default::default(),
    };
    let block = Obstacle::build(&block, &terrain, Path::new(".")).expect("a block");
    let optics = Optics::new(&OpticsSpec {
        clarity: ClaritySpec { visibility_m: m(visibility_m), ..ClaritySpec::default() },
        ..OpticsSpec::default()
    })
    .expect("water");
    let puffs = Puffs::new(Vector3::new(4.0, 0.0, -5.3));
    let scene = Scene {
        terrain: &terrain,
        obstacles: &Obstacles(vec![block]),
        dye: if water == "plume" { &puffs } else { &Clean },
        optics: &optics,
    };
    let camera = CameraSpec::default();
    let pose_WC = looking(Vector3::new(4.5, -2.6, -4.8), 1.57, 0.15);
    bencher.bench_local(|| render(&camera, &pose_WC, &scene, 1));
}
