//! Moments, law and correlation of the structure, and its place in a plume.

use super::{PlaceInFilament, Sheet, Structure};
use crate::error::PlumeError;
use crate::filaments::tests::flume;
use crate::flow::catalogue::CurrentSpec;
use crate::flow::eddies::tests_eddies;
use crate::flow::tests::kit::of;
use crate::simd::dispatch::InstructionSet;
use nalgebra::Vector3;
use world::fields::Concentration;
use world::math;

const RELEASED: f64 = 47.0;

/// Concentrations over their mean on lines through many filaments, a line a row.
fn records(dilution: f64, sheet: Sheet, across_m: f64, step_m: f32) -> Vec<Vec<f64>> {
    let structure = Structure { share: 1.0, released_kg_m3: RELEASED, key: 5 };
    let mean = RELEASED / dilution;
    let on_line = |number| {
        let at = |k: u16| {
            let along = f32::from(k) * step_m - 0.01;
            let place = PlaceInFilament { number, away_m: [along, 0.3 * along, 0.002], sheet };
            structure.sensed(mean, &place, across_m) / mean
        };
        (0..50).map(at).collect()
    };
    (0..2000).map(on_line).collect()
}

fn moments(records: &[Vec<f64>]) -> [f64; 3] {
    let n = (records.len() * records[0].len()) as f64;
    let mean = records.iter().flatten().sum::<f64>() / n;
    let about = |power| records.iter().flatten().map(|c| (c - mean).powi(power)).sum::<f64>() / n;
    [mean, about(2), about(3)]
}

/// ∫c² over a slab that has diffused, by sums, beside the mean over its mass.
#[test]
fn a_sheet_keeps_the_mean_over_its_mass() {
    for mixed in [1e-4, 1e-2, 1.0, 280.0, 320.0, 1e4] {
        let spread = 2.0 * f64::sqrt(mixed);
        let cell = (1.0 + 8.0 * spread) / 40_000.0;
        let c = |k: f64| {
            let x = (k + 0.5) * cell;
            0.5 * (math::erf((x + 0.5) / spread) - math::erf((x - 0.5) / spread))
        };
        let want: f64 = (0..40_000).map(|k| 2.0 * cell * c(f64::from(k)).powi(2)).sum();
        let got = Sheet { thickness_m: 1e-3, mixed }.mean_share();
        assert!((got / want - 1.0).abs() < 1e-3, "{mixed}: {got} {want}");
    }
    assert_eq!(Sheet { thickness_m: 1e-3, mixed: 0.0 }.mean_share(), 1.0);
}

#[test]
fn variance_is_what_stirring_makes_and_mixing_leaves() {
    let sheet = |mixed| Sheet { thickness_m: 1e-3, mixed };
    // Nothing diffused, and a probe that is a point: (C0 − C̄)/C̄.
    assert!((sheet(0.0).seen(20.0, 1.0, 0.0).variance - 19.0).abs() < 1e-12);
    assert!((sheet(0.0).seen(20.0, 0.1, 0.0).variance - 1.9).abs() < 1e-12);
    // Mixed down to the mean.
    assert_eq!(sheet(1e4).seen(20.0, 1.0, 0.0).variance, 0.0);
    // A probe sees less of it, over a longer way: half of the variance in 2.56 integral scales of 0.5 mm.
    let wide = sheet(0.0).seen(20.0, 1.0, 1.28e-3);
    assert!((wide.variance / 19.0 - 0.5).abs() < 1e-2 && (wide.scale_m - 1e-3).abs() < 2e-5, "{wide:?}");
}

/// Mean and variance to sampling errors, the third moment of a gamma law (2v²) or of all or nothing.
#[test]
fn one_point_has_the_law() {
    let far = Sheet { thickness_m: 1e-4, mixed: 0.3 };
    for (dilution, sheet, across_m) in [(300.0, far, 5e-4), (30.0, far, 1e-3)] {
        let v = sheet.seen(dilution, 1.0, across_m).variance;
        let [mean, variance, third] = moments(&records(dilution, sheet, across_m, 0.003));
        assert!((mean - 1.0).abs() < 0.03, "{dilution}: {mean}");
        assert!((variance / v - 1.0).abs() < 0.08, "{dilution}: {variance} {v}");
        assert!((third / (2.0 * v * v) - 1.0).abs() < 0.25, "{dilution}: {third} {v}");
    }
    let unmixed = Sheet { thickness_m: 5e-3, mixed: 0.0 };
    let all = records(4.0, unmixed, 0.0, 0.02);
    let released = all.iter().flatten().filter(|c| **c > 3.9).count() as f64 / 1e5;
    let nothing = all.iter().flatten().filter(|c| **c < 0.1).count() as f64 / 1e5;
    assert!((released - 0.25).abs() < 0.02 && (nothing - 0.75).abs() < 0.02, "{released} {nothing}");
    assert!(all.iter().flatten().all(|c| *c <= 4.0 + 1e-9));
}

/// Integral scale along a line, to where the correlation vanishes.
#[test]
fn it_is_correlated_over_the_sheets_thickness() {
    for sheet in [Sheet { thickness_m: 4e-3, mixed: 0.0 }, Sheet { thickness_m: 5e-4, mixed: 0.2 }] {
        let want = sheet.seen(6.0, 1.0, 5e-4);
        let step_m = 0.25 * want.scale_m;
        let rows = records(6.0, sheet, 5e-4, step_m as f32);
        let [mean, variance, _] = moments(&rows);
        let correlation = |lag: usize| {
            let pairs = rows.iter().flat_map(|row| row.iter().zip(&row[lag..]));
            let (n, sum) = pairs.fold((0.0, 0.0), |(n, sum), (a, b)| (n + 1.0, sum + (a - mean) * (b - mean)));
            sum / n / variance
        };
        // The line goes 0.3 across to 1 along.
        let scale_m = step_m * f64::sqrt(1.09) * (0.5 + (1..30).map(correlation).sum::<f64>());
        assert!((scale_m / want.scale_m - 1.0).abs() < 0.15, "{scale_m} {want:?}");
    }
}

/// In the flume: without structure a probe is given the concentration to the bit; with it, as much in the mean. The mean
/// over many keys stands for time.
#[test]
fn the_mean_field_stays() {
    let water = tests_eddies::water(2.5, 2);
    let developed = |share| {
        let mut plume = flume::structured(share, 2.5, 2).with_buoyancy(&water).unwrap();
        for n in 0..240 {
            plume.drift_on(&water, 0.25, n..n + 1);
        }
        plume
    };
    let (smooth, mut rough) = (developed(0.0), developed(1.0));
    let places: Vec<_> = smooth.iter().step_by(40).map(|[x, y, z, ..]| Vector3::new(x, y, z)).collect();
    assert!(places.len() > 20);
    let mut felt = 0;
    for p in &places {
        let mean = rough.concentration(p);
        assert_eq!(smooth.sensed(p, 5e-4).to_bits(), smooth.concentration(p).to_bits());
        assert!((mean / smooth.concentration(p) - 1.0).abs() < 0.01);
        let key = rough.stores[0].structure.unwrap().key;
        let (mut sum, mut squares, n) = (0.0, 0.0, 400);
        for more in 0..n {
            rough.stores_mut()[0].structure.as_mut().unwrap().key = key + more;
            let c = rough.sensed(p, 5e-4) / mean;
            // Filaments that overlap at the nozzle are denser than what was released; there nothing fluctuates.
            assert!(c >= 0.0 && c * mean <= mean.max(rough.stores[0].structure.unwrap().released_kg_m3) * 1.000_1);
            (sum, squares) = (sum + c, squares + c * c);
        }
        let of_mean = sum / n as f64;
        let error = (squares / n as f64 - of_mean * of_mean).sqrt() / (n as f64).sqrt();
        assert!((of_mean - 1.0).abs() <= 4.5 * error + 1e-9, "{p:?}: {of_mean} ± {error}");
        felt += usize::from(error > 0.02);
        rough.stores_mut()[0].structure.as_mut().unwrap().key = key;
        let bits = rough.sensed(p, 5e-4).to_bits();
        let mut other = rough.clone();
        other.path = InstructionSet::Portable;
        assert_eq!(other.sensed(p, 5e-4).to_bits(), bits, "on every path");
    }
    assert!(felt > places.len() / 3, "{felt} of {} places have structure", places.len());
}

#[test]
fn a_probe_must_not_average_over_eddies() {
    // Twenty times as fast, the finest eddies are 0.1 mm.
    let fast = of(vec![CurrentSpec::new(tests_eddies::channel_spec(1.0, 0.0))]);
    let fast = fast.build(&tests_eddies::flume(2.5), &tests_eddies::BED, 2).unwrap();
    let PlumeError::Invalid { field, .. } = flume::structured(1.0, 2.5, 2).with_buoyancy(&fast).unwrap_err();
    assert_eq!(field, "sources[0].release.structure");
}
