#![allow(missing_docs, clippy::all)]
use nalgebra::{Vector2, Vector3};
use plumes::filaments::{Plume, PlumeSettings};
use plumes::flow::channel::OpenChannelSpec;
use plumes::flow::eddies::EddiesSpec;
use plumes::flow::{CurrentSpec, GridShape, WaterSpec};
use plumes::release::{NozzleSpec, ReleaseSpec, SourceSpec};
struct Instant(f64);
fn cpu() -> f64 { std::fs::read_to_string("/proc/thread-self/schedstat").unwrap().split_whitespace().next().unwrap().parse::<f64>().unwrap() * 1e-6 }
impl Instant { fn now() -> Self { Self(cpu()) } fn elapsed(&self) -> String { format!("{:.1} ms CPU", cpu() - self.0) } }
use world::area::Area;
use world::fields::{Concentration, Flow};
use world::ranges::*;
use world::terrain::Terrain;
use world::units::Heading;

fn main() {
    let area = Area { centre: Vector2::new(0.85, 0.0), length_m: 2.5, width_m: 1.07, axis: Heading::from_deg(90.0) };
    let bed = Terrain::Level { depth_m: 0.2 };
    let spec = WaterSpec {
        currents: vec![CurrentSpec::OpenChannel(OpenChannelSpec {
            mean_m_s: Positive::new(0.05),
            heading_deg: HeadingDeg::new(90.0),
            roughness_m: NonNegative::new(0.0),
            viscosity_m2_s: Positive::new(1e-6),
            eddies: Some(EddiesSpec::default()),
        })],
        ..WaterSpec::default()
    };
    let t = Instant::now();
    let water = spec.build(&area, &bed, 1).unwrap();
    println!("build {:?}", t.elapsed());
    let t = Instant::now();
    let water = spec.build(&area, &bed, 1).unwrap();
    println!("again {:?}", t.elapsed());
    let c = *water.channel().unwrap();
    let e = water.eddies().unwrap();
    println!("u* {} T {} resolved {} eps {}", c.u_star_m_s, e.turn_over_s(), e.spectrum().resolved(), c.dissipation(0.038));
    for h in [0.0, 0.005, 0.01, 0.02, 0.038, 0.06, 0.08, 0.1, 0.125, 0.15, 0.175, 0.2] {
        let x = e.intensities(h);
        let n = c.intensities(h);
        // measured over box
        let mut m = [0.0; 3];
        let (mut a, mut b) = (0.0, 0.0);
        let nn = 4000;
        for k in 0..nn {
            let f = k as f64;
            let p = Vector3::new((f * 0.618) % 3.0, ((f * 0.7548) % 1.0 - 0.5) * 1.07, h - 0.2);
            let u = e.velocity(&p, (f * 0.5698) % 3.0 + 100.0 * (k % 50) as f64);
            for d in 0..3 { m[d] += u[d] * u[d] / nn as f64; }
            a += u[0] * u[2] / nn as f64; b += u[0] / nn as f64;
        }
        let m = m.map(f64::sqrt);
        println!("h {h:.3} U {:.4} exp {:.2?} nezu {:.2?} meas {:.2?} uw {:.2} Ksub {:.2e}", c.speed(h),
            x.map(|v| v / c.u_star_m_s), n.map(|v| v / c.u_star_m_s), m.map(|v| v / c.u_star_m_s), a / c.u_star_m_s.powi(2), e.spectrum().sub_grid(&c, h));
        let _ = b;
    }
    let source = SourceSpec {
        id: "nozzle".into(), east_m: Finite::new(0.0), north_m: Finite::new(0.0), height_m: Some(Finite::new(0.038)), depth_m: None,
        rate_g_s: Positive::new(0.032557),
        release: ReleaseSpec { eddy_size_m: Some(Positive::new(0.008)), nozzle: Some(NozzleSpec { diameter_m: Positive::new(0.0042), speed_m_s: Positive::new(0.05) }), ..ReleaseSpec::default() },
    };
    let settings = PlumeSettings { grid: GridShape::fitting(&area), refresh_s: 1e5 };
    let t = Instant::now();
    let mut plume = Plume::new(&[source], &area, &bed, 1, settings).unwrap();
    let dt = 0.25;
    for n in 0..240 { plume.drift(&water, n as f64 * dt, (n + 1) as f64 * dt); }
    println!("spin-up {:?} n {}", t.elapsed(), plume.len());
    let t = Instant::now();
    let mut rec: Vec<f64> = vec![];
    let dt = 0.05;
    let mut p2 = plume.clone();
    for n in 0..1500 { let t0 = 60.0 + n as f64 * dt; p2.drift(&water, t0, t0 + dt); }
    println!("mission drift 75 s {:?} n {}", t.elapsed(), p2.len());
    let t = Instant::now();
    for n in 0..1500 { let t0 = 60.0 + n as f64 * dt; plume.drift(&water, t0, t0 + dt);
        for y in [-0.0625, 0.0, 0.0625] { rec.push(plume.at(&Vector3::new(1.0, y, -0.125)) / 47.0); } }
    println!("mission with probes 75 s {:?}", t.elapsed());
    for k in 0..60 { print!("{:.1} ", rec[3 * (k + 600) + 1] * 1e4); }
    println!();
    // long statistics
    let xs = [0.25, 0.5, 1.0, 1.5, 2.0];
    let t = Instant::now();
    let mut s = [[0.0f64; 4]; 5]; let mut cl = [0.0; 5]; let mut cl2 = [0.0; 5]; let mut on = [0.0; 5]; let mut count = 0.0;
    let mut width = [0.0; 5];
    let total: f64 = std::env::args().nth(1).map_or(600.0, |v| v.parse().unwrap());
    let dt = 0.1; let steps = (total / dt) as usize;
    for n in 0..steps { let t0 = 135.0 + n as f64 * dt; plume.drift(&water, t0, t0 + dt);
        if n % 5 == 0 { count += 1.0;
        for (i, x) in xs.iter().enumerate() {
            let v = plume.at(&Vector3::new(*x, 0.0, -0.162)) / 47.0;
            cl[i] += v; cl2[i] += v * v; on[i] += f64::from(v > 1e-5);
        }
        let mut inst = [[0.0f64; 3]; 5];
        for f in plume.iter() { for (i, x) in xs.iter().enumerate() { if (f[0] as f64 - x).abs() < 0.05 { let y = f[1] as f64; let z = f[2] as f64; s[i][0] += 1.0; s[i][1] += y; s[i][2] += y * y; s[i][3] += z*z; inst[i][0]+=1.0; inst[i][1]+=y; inst[i][2]+=y*y; } } }
        for i in 0..5 { let [n,a,b]=inst[i]; if n>0.0 { width[i]+= b/n-(a/n)*(a/n); } }
        } }
    println!("stats {:?}", t.elapsed());
    for i in 0..5 { let m = s[i][1] / s[i][0]; println!("x {} sigma_y {:.4} mean {:.4} inst {:.4} rms(z from surf) {:.3} C/C0 {:.2e} rms/mean {:.2} on {:.2}", xs[i], (s[i][2] / s[i][0] - m * m).sqrt(), m, (width[i]/count).sqrt(), (s[i][3]/s[i][0]).sqrt(), cl[i] / count, (cl2[i]/count).sqrt()/(cl[i]/count), on[i]/count); }
    let _ = water.velocity(&Vector3::zeros(), 0.0);
}
