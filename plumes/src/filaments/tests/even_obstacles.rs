//! Even dye stays even beside obstacles through which the water passes; there, the obstacles themselves are the walls.

use super::even::mixing;
use super::water::source;
use crate::filaments::plume::{Plume, PlumeSettings};
use crate::flow::WaterSpec;
use crate::flow::blockage::tests::{area, block, solids};
use nalgebra::Vector3;
use world::ranges::Finite;
use world::seeds::Stream;
use world::terrain::Terrain;

/// Without blockage the obstacles are the walls. Still water, kicks of 0.4 m; distances from the sides of a turned
/// block in rings of 5 and 20 cm, each with at least 6·10⁴ filaments.
#[test]
fn beside_an_obstacle_without_blockage() {
    let bed = Terrain::Level { depth_m: 5.0 };
    let solids = solids(&[(block([6.0, 4.0, 3.0]), 4.0, -7.0, 33.0)], &bed);
    let area = area(16.0, 14.0, 90.0);
    let mut spec = WaterSpec::default();
    mixing(&mut spec, 0.08, 0.01);
    let water = spec.build(&area, &bed, 1).unwrap();
    let settings = PlumeSettings {
        grid: crate::flow::GridShape { cell_m: 4.0, margin_m: 2.0, ..Default::default() },
        refresh_s: 1e9,
    };
    let mut nozzle = source(0.5, 1e-6, 0.001, 0.1);
    (nozzle.east_m, nozzle.north_m) = (Finite::new(-3.0), Finite::new(-13.0));
    let mut plume = Plume::new(&[nozzle], &area, &bed, 3, settings).unwrap().with_obstacles(solids.clone()).unwrap();
    let mut rng = Stream::new(8, "test", "rings");
    let mut drawn = |low: f64, high: f64| low + (high - low) * rng.uniform();
    // Rings outside: [0, 5) and [5, 25) cm, at the middle height of the sides.
    let ring = |p: &Vector3<f64>| {
        let d = solids.distance(p);
        ((-4.0..-3.0).contains(&p.z) && d > 0.0 && d < 0.25).then(|| usize::from(d > 0.05))
    };
    let (mut before, mut after) = ([0.0_f64; 2], [0.0_f64; 2]);
    let mut poured = 0;
    while poured < 1_500_000 {
        let p = Vector3::new(drawn(-2.0, 10.0), drawn(-13.0, -1.0), drawn(-5.0, 0.0));
        if solids.containing(&p).is_some() {
            continue;
        }
        if let Some(r) = ring(&p) {
            before[r] += 1.0;
        }
        let place = plume.grid().local(&p);
        plume.stores_mut()[0].push(place, -5.0, 0.0);
        poured += 1;
    }
    for n in 0..4 {
        plume.drift(&water, f64::from(n), f64::from(n + 1));
    }
    for f in plume.iter() {
        let p = Vector3::new(f[0], f[1], f[2]);
        assert!(solids.containing(&p).is_none());
        if let Some(r) = ring(&p) {
            after[r] += 1.0;
        }
    }
    for r in 0..2 {
        // Two Poisson counts; the inner ring of 1 m by 20 m by 5 cm in 530 m³ holds 2800: 2.7 % for both.
        let noise = (1.0 / before[r] + 1.0 / after[r]).sqrt();
        let off = after[r] / before[r] - 1.0;
        assert!(off.abs() < 0.05 + 2.0 * noise, "{r}: {off}, noise {noise}");
    }
    assert_eq!(plume.len() as u64 + plume.left(), plume.released());
}
