//! What the water costs: one question, the hull's sample, the plume's grid and a step of the meander.

use divan::{Bencher, black_box};
use nalgebra::{Vector2, Vector3};
use plumes::flow::bed::BedSpec;
use plumes::flow::layered::{InterfaceSpec, LayerSpec, LayeredSpec, WaveSpec};
use plumes::flow::plane_current::meander::MeanderSpec;
use plumes::flow::waves::{SpectrumSpec, WavesSpec};
use plumes::flow::{BlockageSpec, CurrentSpec, FlowGrid, GridShape, Water, WaterSpec};
use std::path::Path;
use world::area::Area;
use world::fields::Flow;
use world::obstacles::{BoxShape, CylinderShape, Obstacle, ObstacleSpec, Obstacles, ShapeSpec};
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::terrain::Terrain;
use world::units::Heading;

fn main() {
    divan::main();
}

fn area() -> Area {
    Area { centre: Vector2::zeros(), length_m: 1094.0, width_m: 367.0, axis: Heading::from_deg(340.0) }
}

fn bed() -> Terrain {
    Terrain::sloping_over(&area(), Heading::from_deg(250.0), 4.0, 8.0)
}

/// Two layers, two waves, log law and meander: the water off Duck.
fn water() -> Water {
    water_spec().build(&area(), &bed(), 1).expect("legal water")
}

fn water_spec() -> WaterSpec {
    let layer = |speed, heading, density| LayerSpec {
        speed_m_s: NonNegative::new(speed),
        heading_deg: HeadingDeg::new(heading),
        density_kg_m3: Positive::new(density),
    };
    let wave = |amplitude, length, period, heading| WaveSpec {
        amplitude_m: NonNegative::new(amplitude),
        length_m: Positive::new(length),
        period_s: Positive::new(period),
        heading_deg: HeadingDeg::new(heading),
        phase_deg: None,
    };
    let layers = LayeredSpec {
        layers: vec![layer(0.22, 350.0, 1020.0), layer(0.12, 158.0, 1024.0)],
        interfaces: vec![InterfaceSpec {
            depth_m: Positive::new(1.8),
            thickness_m: Positive::new(0.8),
            waves: vec![wave(0.3, 420.0, 1900.0, 250.0), wave(0.15, 260.0, 1180.0, 310.0)],
        }],
    };
    let meander = MeanderSpec {
        std_m_s: NonNegative::new(0.02),
        omega_rad_s: Positive::new(0.02),
        damping: Positive::new(0.1),
        cell_m: Positive::new(25.0),
        diffusivity_m2_s: None,
    };
    WaterSpec {
        currents: vec![CurrentSpec::new(layers), CurrentSpec::new(meander)],
        bed: Some(BedSpec { roughness_m: Positive::new(0.001), thickness_m: Positive::new(2.0) }),
        ..WaterSpec::default()
    }
}

#[divan::bench]
fn velocity(bencher: Bencher<'_, '_>) {
    let w = water();
    bencher.bench_local(|| w.velocity(black_box(&Vector3::new(40.0, -300.0, -3.0)), 1.0));
}

#[divan::bench]
fn sample(bencher: Bencher<'_, '_>) {
    let w = water();
    bencher.bench_local(|| w.sample(black_box(&Vector3::new(40.0, -300.0, -3.0)), 1.0));
}

#[divan::bench]
fn grid_refresh(bencher: Bencher<'_, '_>) {
    let w = water();
    let mut grid = FlowGrid::new(&area(), &bed(), GridShape::default());
    bencher.bench_local(|| grid.refresh(&w as &dyn Flow, 1.0));
}

/// A thousand look-ups along a plume, so that the clock's own time does not show.
#[divan::bench(counters = [divan::counter::ItemsCount::new(1000_u32)])]
fn grid_look_up(bencher: Bencher<'_, '_>) {
    let mut grid = FlowGrid::new(&area(), &bed(), GridShape::default());
    grid.refresh(&water(), 1.0);
    let places: Vec<[f32; 3]> = (0..1000)
        .map(|k| {
            let k = k as f32;
            [0.1 * k, -0.4 * k, -5.0 * (k * 0.618_034).fract()]
        })
        .collect();
    bencher.bench_local(|| {
        let all = black_box(&places).iter().map(|p| grid.sample(p[0], p[1], p[2]));
        all.fold(0.0, |sum, s| sum + s.velocity[0] + s.velocity[2] + s.dk_dz)
    });
}

/// One level of the meander: noise, two implicit sweeps, projection.
#[divan::bench]
fn meander_step(bencher: Bencher<'_, '_>) {
    let mut w = water();
    let mut t = 0.0;
    bencher.bench_local(|| {
        t += 5.0;
        w.advance(t);
    });
}

/// A wind sea of thirty-two waves.
fn sea() -> plumes::flow::waves::Waves {
    let spectrum = SpectrumSpec {
        significant_height_m: Positive::new(0.35),
        peak_period_s: Positive::new(2.6),
        heading_deg: HeadingDeg::new(135.0),
        peakedness: Positive::new(3.3),
        spreading: NonNegative::new(10.0),
        components: 32,
    };
    let spec = WavesSpec { trains: vec![], spectrum: Some(spectrum), stokes: true, mixing: NonNegative::new(0.028) };
    spec.build("waves", 10.0, 1).expect("legal waves")
}

/// What thirty-two waves cost hull, current profiler or fluorometer.
#[divan::bench(counters = [divan::counter::ItemsCount::new(32_u32)])]
fn waves_velocity(bencher: Bencher<'_, '_>) {
    let w = sea();
    bencher.bench_local(|| w.velocity(black_box(&Vector3::new(40.0, -30.0, -1.5)), 1.0));
}

/// A turned block and ten piles.
fn solids() -> Obstacles {
    let m = Positive::new;
    let build = |shape, east_m: f64, north_m: f64| {
        let spec = ObstacleSpec {
            surface: Default::default(),
            id: "o".into(),
            shape,
            east_m: Finite::new(east_m),
            north_m: Finite::new(north_m),
            base: Default::default(),
            heading_deg: HeadingDeg::new(30.0),
        };
        Obstacle::build(&spec, &bed(), Path::new("")).expect("a block or a pile")
    };
    let block = ShapeSpec::Box(BoxShape { size_m: (m(60.0), m(30.0), m(5.0)) });
    let pile = || ShapeSpec::Cylinder(CylinderShape { radius_m: m(5.0), height_m: m(9.0) });
    let piles = (0..10).map(|k| build(pile(), 60.0, -200.0 + 30.0 * f64::from(k)));
    Obstacles(piles.chain([build(block, -20.0, 50.0)]).collect())
}

/// The same water led round them, in 478 x 187 x 11 = 983 000 cells or an eighth.
fn round(cell_m: f64, steady: bool) -> Water {
    let mut spec = water_spec();
    if steady {
        spec.currents.truncate(1);
        if let Some(layered) = spec.currents[0].get_mut::<LayeredSpec>() {
            layered.interfaces[0].waves.clear();
        }
    }
    spec.blockage = Some(BlockageSpec { cell_m: Positive::new(cell_m), levels: 12, ..BlockageSpec::default() });
    spec.build_round(&area(), &bed(), &solids(), 1).expect("water round obstacles")
}

/// Cells, solid or open, and one solution from nothing.
#[divan::bench(args = [2.5, 5.0], sample_count = 3, sample_size = 1)]
fn blockage_steady(bencher: Bencher<'_, '_>, cell_m: f64) {
    bencher.bench_local(|| round(cell_m, true));
}

/// The next solution, thirty seconds on, from the one before.
#[divan::bench(args = [2.5, 5.0], sample_count = 3, sample_size = 1)]
fn blockage_next(bencher: Bencher<'_, '_>, cell_m: f64) {
    let mut w = round(cell_m, false);
    let mut t = 59.0;
    bencher.bench_local(|| {
        w.advance(t);
        t += 30.0;
    });
}

#[divan::bench]
fn blockage_velocity(bencher: Bencher<'_, '_>) {
    let w = round(5.0, false);
    bencher.bench_local(|| w.velocity(black_box(&Vector3::new(40.0, -300.0, -3.0)), 1.0));
}

#[divan::bench]
fn blockage_sample(bencher: Bencher<'_, '_>) {
    let w = round(5.0, false);
    bencher.bench_local(|| w.sample(black_box(&Vector3::new(40.0, -300.0, -3.0)), 1.0));
}
