//! Simple water, sources and plumes for the exact tests.

use crate::filaments::plume::{Plume, PlumeSettings};
use crate::flow::grid::GridShape;
use crate::flow::tests::water::{duck, duck_area, duck_bed};
use crate::flow::{Water, WaterSpec};
use crate::release::{ReleaseSpec, SourceSpec};
use nalgebra::{Vector2, Vector3};
use std::ops::Range;
use world::area::Area;
use world::digest::Digest;
use world::fields::{Flow, Mixing};
use world::obstacles::Obstacles;
use world::ranges::{Finite, NonNegative, Positive};
use world::terrain::Terrain;
use world::units::Heading;

/// Water given by two functions of height: eastward speed, and (K_h, K_z).
pub(in crate::filaments) struct Given<U, K>(pub(in crate::filaments) U, pub(in crate::filaments) K);

impl<U, K> Flow for Given<U, K>
where
    U: Fn(f64) -> f64 + Send + Sync,
    K: Fn(f64) -> (f64, f64) + Send + Sync,
{
    fn velocity(&self, p: &Vector3<f64>, _: f64) -> Vector3<f64> {
        Vector3::new((self.0)(p.z), 0.0, 0.0)
    }

    fn mixing(&self, p: &Vector3<f64>, _: f64) -> Mixing {
        let (k_h_m2_s, k_z_m2_s) = (self.1)(p.z);
        Mixing { k_h_m2_s, k_z_m2_s }
    }
}

/// A basin of 200 m by 100 m, with its long side eastward, centred at the datum.
pub(in crate::filaments) fn basin() -> Area {
    Area { centre: Vector2::zeros(), length_m: 200.0, width_m: 100.0, axis: Heading::from_deg(90.0) }
}

/// A source at the west end, east = −90 m.
pub(in crate::filaments) fn source(height_m: f64, rate_hz: f64, growth_m2_s: f64, size_m: f64) -> SourceSpec {
    SourceSpec {
        id: "s1".into(),
        east_m: Finite::new(-90.0),
        north_m: Finite::new(0.0),
        height_m: Some(Finite::new(height_m)),
        depth_m: None,
        rate_g_s: Positive::new(1.0),
        release: ReleaseSpec {
            rate_hz: Positive::new(rate_hz),
            initial_size_m: Positive::new(size_m),
            growth_m2_s: NonNegative::new(growth_m2_s),
            vertical_size_limit_m: None,
            poisson: true,
            ..ReleaseSpec::default()
        },
    }
}

/// A source that releases nothing. What is poured is so large, m, and does not grow.
pub(in crate::filaments) fn silent(size_m: f64) -> SourceSpec {
    source(1.0, 1e-9, 0.0, size_m)
}

impl SourceSpec {
    /// The same at another place.
    pub(in crate::filaments) fn at(self, east_m: f64, north_m: f64) -> Self {
        Self { east_m: Finite::new(east_m), north_m: Finite::new(north_m), ..self }
    }
}

/// A plume of that source in the basin; the flow is evaluated once.
pub(in crate::filaments) fn plume(spec: SourceSpec, terrain: &Terrain) -> Plume {
    let settings = PlumeSettings { grid: GridShape::default(), refresh_s: 1e9 };
    Plume::new(&[spec], &basin(), terrain, 11, settings).expect("a legal source")
}

/// A plume of a source that releases nothing, in water of some depth.
pub(in crate::filaments) fn no_plume(depth_m: f64) -> Plume {
    plume(silent(0.1), &Terrain::Level { depth_m })
}

/// Water, and a plume in it on the grid that the water asks for. Both go round solids.
pub(in crate::filaments) fn plume_in(
    spec: &WaterSpec,
    source: SourceSpec,
    area: &Area,
    bed: &Terrain,
    solids: &Obstacles,
    refresh_s: f64,
) -> (Water, Plume) {
    let water = spec.build_round(area, bed, solids, 5).unwrap();
    let settings = PlumeSettings { grid: spec.grid_shape(area, bed.deepest_m()), refresh_s };
    let plume = Plume::new(&[source], area, bed, 3, settings).unwrap().carried_by(water.small());
    let plume = plume.with_obstacles(solids.clone()).unwrap().led_round(water.blocked()).unwrap();
    (water, plume)
}

/// The water off Duck, and a source that releases so many filaments a second.
pub(in crate::filaments) fn off_duck(rate_hz: f64) -> (Water, Plume) {
    let water = duck().build(&duck_area(), &duck_bed(), 7).unwrap();
    let settings = PlumeSettings { refresh_s: 10.0, grid: GridShape::fitting(&duck_area()) };
    let spec = source(0.2, rate_hz, 0.001, 0.03);
    (water, Plume::new(&[spec], &duck_area(), &duck_bed(), 3, settings).unwrap())
}

impl Plume {
    /// Takes these steps of `dt_s`.
    pub(in crate::filaments) fn drift_on(&mut self, water: &dyn Flow, dt_s: f64, steps: Range<u32>) {
        for n in steps {
            self.drift(water, f64::from(n) * dt_s, f64::from(n + 1) * dt_s);
        }
    }

    /// Where the filaments are.
    pub(in crate::filaments) fn places(&self) -> impl Iterator<Item = Vector3<f64>> + '_ {
        self.iter().map(|f| Vector3::new(f[0], f[1], f[2]))
    }

    pub(in crate::filaments) fn digest(&self) -> String {
        let mut digest = Digest::default();
        self.digest_into(&mut digest);
        digest.hex()
    }
}

/// Adds `n` filaments at time 0, as if released; the k-th is at `at(k)` of the world.
pub(in crate::filaments) fn pour(plume: &mut Plume, n: usize, bed: f64, mut at: impl FnMut(usize) -> [f64; 3]) {
    for k in 0..n {
        let place = plume.grid.local(&at(k).into());
        plume.stores_mut()[0].push(place, bed as f32, 0.0);
    }
}

/// Mean and variance.
pub(super) fn moments(values: impl Iterator<Item = f64> + Clone) -> (f64, f64) {
    let n = values.clone().count() as f64;
    let mean = values.clone().sum::<f64>() / n;
    (mean, values.map(|v| (v - mean) * (v - mean)).sum::<f64>() / (n - 1.0))
}
