//! Filaments in water that flows round a block.

use super::water::{basin, source};
use crate::filaments::plume::{Plume, PlumeSettings};
use crate::flow::BlockageSpec;
use crate::flow::blockage::tests::{block, eastward, solids};
use nalgebra::Vector3;
use world::obstacles::Obstacles;
use world::ranges::{NonNegative, Positive};
use world::terrain::Terrain;

fn in_the_way(bed: &Terrain, heading_deg: f64) -> Obstacles {
    solids(&[(block([6.0, 10.0, 5.0]), -60.0, 1.0, heading_deg)], bed)
}

/// How often a filament was brought out.
fn carried(blocked: bool, heading_deg: f64, k_h_m2_s: f64) -> u64 {
    let bed = Terrain::Level { depth_m: 5.0 };
    let solids = in_the_way(&bed, heading_deg);
    let blockage = BlockageSpec {
        cell_m: Positive::new(1.0),
        levels: 6,
        margin_m: NonNegative::new(10.0),
        ..BlockageSpec::default()
    };
    let mut spec = eastward(0.3, blockage.clone());
    spec.mixing.horizontal_m2_s = NonNegative::new(k_h_m2_s);
    let water = if blocked { spec.build_round(&basin(), &bed, &solids, 1) } else { spec.build(&basin(), &bed, 1) };
    let water = water.unwrap();
    let settings = PlumeSettings { grid: blockage.grid_shape(), refresh_s: 1e9 };
    let mut plume = Plume::new(&[source(2.5, 5.0, 0.001, 0.1)], &basin(), &bed, 1, settings)
        .unwrap()
        .with_obstacles(solids.clone())
        .unwrap()
        .led_round(water.blocked())
        .unwrap();
    let mut past = 0;
    for n in 0..500 {
        plume.drift(&water, f64::from(n) * 0.5, f64::from(n + 1) * 0.5);
        for f in plume.iter() {
            let p = Vector3::new(f[0], f[1], f[2]);
            assert!(solids.containing(&p).is_none(), "{p}");
        }
        past = plume.iter().filter(|f| f[0] > -50.0).count();
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
