//! Speed of the plume in water like that of Duck: `cargo bench -p rheotaxis-plumes --bench filaments`.
//!
//! Goals: 5·10⁷ filament updates a second and 10⁶ point queries a second at 10⁴ filaments on one core.

use divan::counter::ItemsCount;
use divan::{Bencher, black_box};
use nalgebra::{Vector2, Vector3};
use plumes::filaments::{Plume, PlumeSettings};
use plumes::flow::plane_current::uniform::UniformSpec;
use plumes::flow::{BlockageSpec, CurrentSpec, WaterSpec};
use plumes::release::{ReleaseSpec, SourceSpec};
use std::path::Path;
use world::area::Area;
use world::fields::{Concentration, Flow, Mixing};
use world::math;
use world::obstacles::{BoxShape, CylinderShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

fn main() {
    divan::main();
}

/// Two layers against each other, slow down at the bed, wander with a scale of 25 m.
struct TwoLayers;

impl Flow for TwoLayers {
    fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        let upper = 0.5 * (1.0 + math::tanh((p.z + 1.8) / 0.5));
        let (u, v) = (-0.04 * upper + 0.045 * (1.0 - upper), 0.21 * upper - 0.11 * (1.0 - upper));
        let (sx, cx) = math::sin_cos(p.x / 25.0 + 0.02 * t_s);
        let (sy, cy) = math::sin_cos(p.y / 25.0 - 0.01 * t_s);
        let bed = 1.0 - math::exp(-(p.z + 6.0).max(0.0) / 0.5);
        Vector3::new((u + 0.02 * sx * cy) * bed, (v - 0.02 * cx * sy) * bed, 0.0)
    }

    fn mixing(&self, p: &Vector3<f64>, _: f64) -> Mixing {
        let d = (p.z + 1.8) / 0.5;
        Mixing { k_h_m2_s: 0.01, k_z_m2_s: 1e-5 + 1e-3 * (1.0 - math::exp(-d * d)) }
    }
}

/// The same over a bed of a millimetre's roughness: the current falls by the law of the wall to its foot.
struct OverRoughBed;

impl Flow for OverRoughBed {
    fn velocity(&self, p: &Vector3<f64>, t_s: f64) -> Vector3<f64> {
        TwoLayers.velocity(p, t_s)
    }

    fn mixing(&self, p: &Vector3<f64>, t_s: f64) -> Mixing {
        TwoLayers.mixing(p, t_s)
    }

    fn log_layer(&self) -> Option<[f64; 2]> {
        Some([0.001, 2.0])
    }
}

/// A plume 2000 s old with about `n` filaments, and the area it is in.
fn plume(n: usize) -> Plume {
    plume_in(&TwoLayers, n)
}

fn plume_in(flow: &dyn Flow, n: usize) -> Plume {
    let area = Area { centre: Vector2::zeros(), length_m: 1094.0, width_m: 367.0, axis: Heading::from_deg(340.0) };
    let terrain = Terrain::sloping_over(&area, Heading::from_deg(250.0), 4.0, 8.0);
    let source = SourceSpec {
        id: "s1".into(),
        east_m: Finite::new(-242.0),
        north_m: Finite::new(414.0),
        height_m: Some(Finite::new(0.2)),
        depth_m: None,
        rate_g_s: Positive::new(0.025),
        release: ReleaseSpec {
            rate_hz: Positive::new(n as f64 / 2000.0),
            vertical_size_limit_m: Some(Positive::new(0.5)),
            ..ReleaseSpec::default()
        },
    };
    let settings = PlumeSettings { refresh_s: 1e9, ..PlumeSettings::default() };
    let mut plume = Plume::new(&[source], &area, &terrain, 1, settings).expect("a legal source");
    for t in 0..2000 {
        plume.drift(flow, f64::from(t), f64::from(t + 1));
    }
    plume
}

/// Drift of half a second, one after the other; items are filaments (those released meanwhile not counted).
#[divan::bench(args = [1_000, 10_000, 50_000])]
fn drift(bencher: Bencher, n: usize) {
    drift_in(&TwoLayers, bencher, n);
}

/// The same over a rough bed, with the law of the wall in the lowest cell.
#[divan::bench(args = [1_000, 10_000, 50_000])]
fn drift_over_a_rough_bed(bencher: Bencher, n: usize) {
    drift_in(&OverRoughBed, bencher, n);
}

fn drift_in(flow: &dyn Flow, bencher: Bencher, n: usize) {
    let mut plume = plume_in(flow, n);
    bencher.counter(ItemsCount::new(plume.len())).bench_local(|| {
        let t = plume.now_s();
        plume.drift(flow, t, t + 0.5);
    });
}

/// The yardstick: the same walk without any of the above. Each filament evaluates the water where it is, with the
/// gradient of its mixing by a difference, and draws its kicks from a stream; one after the other, in f64.
#[divan::bench(args = [10_000])]
fn plain_loop(bencher: Bencher, n: usize) {
    let (dt_s, h, bed) = (0.5, 1e-3, -6.0);
    let mut all: Vec<Vector3<f64>> = plume(n).iter().map(|f| Vector3::new(f[0], f[1], f[2]).map(f64::from)).collect();
    let mut r = Stream::new(1, "bench", "plain");
    let mut t_s = 2000.0;
    bencher.counter(ItemsCount::new(all.len())).bench_local(|| {
        for p in &mut all {
            let u = TwoLayers.velocity(p, t_s);
            let k = TwoLayers.mixing(p, t_s);
            let above = TwoLayers.mixing(&(*p + Vector3::z() * h), t_s);
            let rise = (above.k_z_m2_s - k.k_z_m2_s) / h;
            let [flat, high] = [k.k_h_m2_s, k.k_z_m2_s].map(|k| (2.0 * k * dt_s).sqrt());
            let kick = Vector3::new(flat * r.normal(), flat * r.normal(), high * r.normal());
            *p += u * dt_s + kick + Vector3::z() * (rise * dt_s);
            // Mirrored at surface and bed.
            p.z = -p.z.abs();
            p.z = bed + (p.z - bed).abs();
        }
        t_s += dt_s;
    });
}

/// A stream round a block and ten piles, in cells of 2 m, with about `n` filaments among them; in it the plume follows the cells, or, as
/// if nothing stood there, the grid.
fn round(n: usize, led: bool) -> (plumes::flow::Water, Plume) {
    let area = Area { centre: Vector2::zeros(), length_m: 160.0, width_m: 80.0, axis: Heading::from_deg(90.0) };
    let terrain = Terrain::Level { depth_m: 10.0 };
    let m = Positive::new;
    let mut solids = vec![(ShapeSpec::Box(BoxShape { size_m: (m(7.5), m(20.0), m(10.0)) }), -20.0, 2.0)];
    for k in 0..10 {
        let pile = CylinderShape { radius_m: m(1.5), height_m: m(12.0) };
        solids.push((ShapeSpec::Cylinder(pile), 10.0, -31.0 + 7.0 * f64::from(k)));
    }
    let solids = solids.into_iter().map(|(shape, east, north)| {
        let spec = ObstacleSpec {
            surface: Default::default(),
            id: "o".into(),
            shape,
            east_m: Finite::new(east),
            north_m: Finite::new(north),
            base: Default::default(),
            heading_deg: HeadingDeg::new(90.0),
        };
        Obstacle::build(&spec, &terrain, Path::new("")).expect("a block or a pile")
    });
    let solids = Obstacles(solids.collect());
    let blockage = BlockageSpec { cell_m: m(2.0), ..BlockageSpec::default() };
    let mut spec = WaterSpec {
        currents: vec![CurrentSpec::new(UniformSpec {
            speed_m_s: NonNegative::new(0.2),
            heading_deg: HeadingDeg::new(90.0),
        })],
        blockage: Some(blockage.clone()),
        ..WaterSpec::default()
    };
    spec.mixing.horizontal_m2_s = NonNegative::new(0.02);
    spec.mixing.background_vertical_m2_s = NonNegative::new(1e-3);
    let water = spec.build_round(&area, &terrain, &solids, 1).expect("water round obstacles");
    let sources: Vec<SourceSpec> = (0..8)
        .map(|k| SourceSpec {
            id: format!("s{k}"),
            east_m: Finite::new(-60.0),
            north_m: Finite::new(-28.0 + 8.0 * f64::from(k)),
            height_m: Some(Finite::new(5.0)),
            depth_m: None,
            rate_g_s: Positive::new(0.025),
            release: ReleaseSpec { rate_hz: Positive::new(n as f64 / 8.0 / 700.0), ..ReleaseSpec::default() },
        })
        .collect();
    let settings = PlumeSettings { refresh_s: 1e9, grid: blockage.grid_shape() };
    let mut plume = Plume::new(&sources, &area, &terrain, 1, settings).expect("legal sources");
    if led {
        plume = plume.with_obstacles(solids).and_then(|p| p.led_round(water.blocked())).expect("sources in open water");
    }
    for t in 0..700 {
        plume.drift(&water, f64::from(t), f64::from(t + 1));
    }
    (water, plume)
}

/// Drift of half a second round obstacles, and on a grid as fine without any; items are filaments.
#[divan::bench(args = [(10_000, true), (10_000, false)])]
fn drift_round(bencher: Bencher, (n, led): (usize, bool)) {
    let (water, mut plume) = round(n, led);
    bencher.counter(ItemsCount::new(plume.len())).bench_local(|| {
        let t = plume.now_s();
        plume.drift(&water, t, t + 0.5);
    });
}

/// Points where a filament is within a metre or two: a track through the plume.
fn near(plume: &Plume) -> Vec<Vector3<f64>> {
    let mut r = Stream::new(1, "bench", "near");
    let all: Vec<[f64; 5]> = plume.iter().collect();
    (0..4096)
        .map(|_| {
            let f = all[(r.uniform() * all.len() as f64) as usize];
            let p = Vector3::new(f[0] + r.normal(), f[1] + r.normal(), f[2] + 0.3 * r.normal());
            Vector3::new(p.x, p.y, p.z.clamp(-6.0, 0.0))
        })
        .collect()
}

/// Points anywhere in the box that holds all filaments.
fn in_box(plume: &Plume) -> Vec<Vector3<f64>> {
    let mut r = Stream::new(1, "bench", "box");
    let (mut lo, mut hi) = ([f64::MAX; 3], [f64::MIN; 3]);
    for f in plume.iter() {
        for d in 0..3 {
            lo[d] = lo[d].min(f[d]);
            hi[d] = hi[d].max(f[d]);
        }
    }
    (0..4096).map(|_| Vector3::from_fn(|d, _| lo[d] + r.uniform() * (hi[d] - lo[d]))).collect()
}

/// Points along straight tracks at 2 m/s and 10 Hz, 40 m long, across the plume at random places.
fn tracks(plume: &Plume) -> Vec<Vector3<f64>> {
    let mut r = Stream::new(1, "bench", "tracks");
    let all: Vec<[f64; 5]> = plume.iter().collect();
    let mut points = Vec::new();
    for _ in 0..64 {
        let f = all[(r.uniform() * all.len() as f64) as usize];
        let course = Heading::from_deg(360.0 * r.uniform()).unit();
        for k in -100..100 {
            let q = Vector2::new(f[0], f[1]) + course * (0.2 * f64::from(k));
            points.push(Vector3::new(q.x, q.y, f[2]));
        }
    }
    points
}

fn ask(bencher: Bencher, n: usize, points: fn(&Plume) -> Vec<Vector3<f64>>) {
    let plume = plume(n);
    let points = points(&plume);
    for p in &points {
        black_box(plume.concentration(p));
    }
    bencher
        .counter(ItemsCount::new(points.len()))
        .bench_local(|| points.iter().map(|p| plume.concentration(p)).sum::<f64>());
}

/// Queries close to filaments; items are points.
#[divan::bench(args = [10_000, 50_000])]
fn ask_near(bencher: Bencher, n: usize) {
    ask(bencher, n, near);
}

/// Queries along tracks through the plume; items are points.
#[divan::bench(args = [10_000, 50_000])]
fn ask_tracks(bencher: Bencher, n: usize) {
    ask(bencher, n, tracks);
}

/// Queries in the plume's box; items are points.
#[divan::bench(args = [10_000, 50_000])]
fn ask_box(bencher: Bencher, n: usize) {
    ask(bencher, n, in_box);
}

/// What a mission does each half second: drift, then five readings of one robot.
#[divan::bench(args = [10_000, 50_000])]
fn drift_and_five_readings(bencher: Bencher, n: usize) {
    let mut plume = plume(n);
    let points = tracks(&plume);
    let mut tracks = points.chunks(5).cycle();
    bencher.bench_local(|| {
        let t = plume.now_s();
        plume.drift(&TwoLayers, t, t + 0.5);
        let five = tracks.next().unwrap_or_default();
        five.iter().map(|q| plume.concentration(q)).sum::<f64>()
    });
}
