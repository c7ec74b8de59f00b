//! What the flume costs: `cargo bench -p rheotaxis-plumes --bench flume`. Goal: a minute of spin-up and 75 s of mission in 0.25 s.

use divan::{Bencher, black_box};
use nalgebra::{Vector2, Vector3};
use plumes::filaments::{Plume, PlumeSettings};
use plumes::flow::channel::open_channel::OpenChannelSpec;
use plumes::flow::eddies::EddiesSpec;
use plumes::flow::{CurrentSpec, GridShape, Water, WaterSpec};
use plumes::release::{NozzleSpec, ReleaseSpec, SourceSpec};
use world::area::Area;
use world::fields::Concentration;
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::terrain::Terrain;
use world::units::Heading;

fn main() {
    divan::main();
}

/// The flume of Webster et al. 2012.
fn flume() -> (Water, Plume) {
    let area = Area { centre: Vector2::new(0.85, 0.0), length_m: 2.5, width_m: 1.07, axis: Heading::from_deg(90.0) };
    let bed = Terrain::Level { depth_m: 0.2 };
    let water = WaterSpec {
        currents: vec![CurrentSpec::new(OpenChannelSpec {
            mean_m_s: Positive::new(0.05),
            heading_deg: HeadingDeg::new(90.0),
            roughness_m: NonNegative::new(0.0),
            viscosity_m2_s: Positive::new(1e-6),
            eddies: Some(EddiesSpec::default()),
        })],
        ..WaterSpec::default()
    };
    let source = SourceSpec {
        id: "nozzle".into(),
        east_m: Finite::new(0.0),
        north_m: Finite::new(0.0),
        height_m: Some(Finite::new(0.038)),
        depth_m: None,
        rate_g_s: Positive::new(0.032557),
        release: ReleaseSpec {
            eddy_size_m: Some(Positive::new(0.008)),
            nozzle: Some(NozzleSpec { diameter_m: Positive::new(0.0042), speed_m_s: Positive::new(0.05) }),
            ..ReleaseSpec::default()
        },
    };
    let settings = PlumeSettings { grid: GridShape::fitting(&area), refresh_s: 1e6 };
    let water = water.build(&area, &bed, 1).expect("legal water");
    let plume = Plume::new(&[source], &area, &bed, 1, settings).expect("a legal source");
    (water, plume)
}

fn spun_up() -> (Water, Plume) {
    let (water, mut plume) = flume();
    for n in 0..240 {
        let t = 0.25 * f64::from(n);
        plume.drift(&water, t, t + 0.25);
    }
    (water, plume)
}

/// A minute in steps of a quarter of a second, from clean water.
#[divan::bench(sample_count = 20)]
fn spin_up(bencher: Bencher) {
    bencher.bench(spun_up);
}

/// 75 s at 20 Hz with three probes.
#[divan::bench(sample_count = 10)]
fn mission(bencher: Bencher) {
    bencher.with_inputs(spun_up).bench_values(|(water, mut plume)| {
        let mut sum = 0.0;
        for n in 0..1500 {
            let t = 60.0 + 0.05 * f64::from(n);
            plume.drift(&water, t, t + 0.05);
            for (y, z) in [(-0.0625, -0.125), (0.0625, -0.125), (0.0, -0.075)] {
                sum += plume.concentration(&Vector3::new(1.0, y, z));
            }
        }
        black_box(sum)
    });
}
