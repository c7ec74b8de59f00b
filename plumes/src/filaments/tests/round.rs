//! Filaments in water that flows round a block.

use super::water::{basin, plume_in, source};
use crate::flow::blockage::tests::{block, eastward, solids, spec};
use world::ranges::NonNegative;
use world::terrain::Terrain;

/// How often a filament was brought out.
fn carried(blocked: bool, heading_deg: f64, k_h_m2_s: f64) -> u64 {
    let bed = Terrain::Level { depth_m: 5.0 };
    let solids = solids(&[(block([6.0, 10.0, 5.0]), -60.0, 1.0, heading_deg)], &bed);
    let mut spec = eastward(0.3, spec(1.0, 6, 10.0));
    spec.mixing.horizontal_m2_s = NonNegative::new(k_h_m2_s);
    spec.blockage = spec.blockage.filter(|_| blocked);
    let (water, mut plume) = plume_in(&spec, source(2.5, 5.0, 0.001, 0.1), &basin(), &bed, &solids, 1e9);
    let mut past = 0;
    for n in 0..500 {
        plume.drift_on(&water, 0.5, n..n + 1);
        for p in plume.places() {
            assert!(solids.containing(&p).is_none(), "{p}");
        }
        past = plume.places().filter(|p| p.x > -50.0).count();
    }
    assert!(past > 200 || !blocked, "the plume passes the block: {past}");
    assert_eq!(plume.len() as u64 + plume.left(), plume.released());
    plume.turned_back()
}

/// A plume that meets a block head on, straight and turned, without and with eddies: no filament is inside, none is
/// lost. Without blockage, those that meet the face stay there and are brought out step by step. With blockage no
/// filament runs into a wall that lies along the cells. What remains are kicks of the eddies against walls (3 cm in a
/// step), and the corners of a turned wall beyond its staircase.
#[test]
fn filaments_go_round_a_block_by_themselves() {
    for (heading_deg, k_h, part) in [(90.0, 0.0, 0.0), (90.0, 1e-3, 0.01), (60.0, 0.0, 0.05), (60.0, 1e-3, 0.05)] {
        let run = |blocked| carried(blocked, heading_deg, k_h);
        let (with, without) = (run(true), run(false));
        assert!(without > 10_000 && with as f64 <= part * without as f64, "{with} {without}");
    }
}
