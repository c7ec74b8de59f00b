//! Even dye stays even beside obstacles through which the water passes; there, the obstacles themselves are the walls.

use super::even::mixing;
use super::water::{plume_in, source};
use crate::flow::WaterSpec;
use crate::flow::blockage::tests::{area, block, solids};
use nalgebra::Vector3;
use world::seeds::Stream;
use world::terrain::Terrain;

/// Without blockage the obstacles are the walls. Still water, kicks of 0.4 m; distances from the sides of a turned
/// block in rings of 5 and 20 cm, each with at least 6·10⁴ filaments.
#[test]
fn beside_an_obstacle_without_blockage() {
    let bed = Terrain::Level { depth_m: 5.0 };
    let solids = solids(&[(block([6.0, 4.0, 3.0]), 4.0, -7.0, 33.0)], &bed);
    let mut spec = WaterSpec::default();
    mixing(&mut spec, 0.08, 0.01);
    let nozzle = source(0.5, 1e-6, 0.001, 0.1).at(-3.0, -13.0);
    let (water, mut plume) = plume_in(&spec, nozzle, &area(16.0, 14.0, 90.0), &bed, &solids, 1e9);
    let mut rng = Stream::new(8, "test", "rings");
    let mut drawn = |low: f64, high: f64| low + (high - low) * rng.uniform();
    // Rings outside: [0, 5) and [5, 25) cm, at the middle height of the sides.
    let ring = |p: &Vector3<f64>| {
        let d = solids.distance(p);
        ((-4.0..-3.0).contains(&p.z) && d > 0.0 && d < 0.25).then(|| usize::from(d > 0.05))
    };
    let count = |places: &mut dyn Iterator<Item = Vector3<f64>>| {
        let mut counts = [0.0_f64; 2];
        for p in places {
            assert!(solids.containing(&p).is_none());
            if let Some(r) = ring(&p) {
                counts[r] += 1.0;
            }
        }
        counts
    };
    while plume.len() < 1_500_000 {
        let p = Vector3::new(drawn(-2.0, 10.0), drawn(-13.0, -1.0), drawn(-5.0, 0.0));
        if solids.containing(&p).is_none() {
            let place = plume.grid().local(&p);
            plume.stores_mut()[0].push(place, -5.0, 0.0);
        }
    }
    let before = count(&mut plume.places());
    plume.drift_on(&water, 1.0, 0..4);
    let after = count(&mut plume.places());
    for r in 0..2 {
        // Two Poisson counts; the inner ring of 1 m by 20 m by 5 cm in 530 m³ holds 2800: 2.7 % for both.
        let noise = (1.0 / before[r] + 1.0 / after[r]).sqrt();
        let off = after[r] / before[r] - 1.0;
        assert!(off.abs() < 0.05 + 2.0 * noise, "{r}: {off}, noise {noise}");
    }
    assert_eq!(plume.len() as u64 + plume.left(), plume.released());
}
