//! The plume is the same wherever the datum lies: filaments are single precision, charts are in metres from an equator.

use super::water::{plume_in, source};
use crate::flow::blockage::tests::{block, solids};
use crate::flow::catalogue::CurrentSpec;
use crate::flow::eddies::tests_eddies::channel_spec;
use crate::flow::tests::kit::{layer, meander, two_layers, uniform, wave};
use crate::flow::waves::tests::train;
use crate::flow::waves::{TrainSpec, WavesSpec};
use crate::flow::{BlockageSpec, WaterSpec};
use nalgebra::{Vector2, Vector3};
use world::area::Area;
use world::fields::{Concentration, Flow};
use world::obstacles::Obstacles;
use world::ranges::{NonNegative, Positive};
use world::terrain::Terrain;
use world::units::Heading;

/// What is looked at: a basin of 40 m by 20 m and 5 m depth, or a flume.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Case {
    Open,
    Solids,
    Blocked,
    Flume,
}

const PLACES: [[f64; 2]; 3] = [[0.0, 0.0], [500_000.0, 4_649_776.0], [-1e7, 1.9e7]];

fn currents(case: Case) -> Vec<CurrentSpec> {
    match case {
        Case::Flume => vec![CurrentSpec::new(channel_spec(0.05, 0.0))],
        Case::Solids | Case::Blocked => vec![uniform(0.2, 90.0)],
        Case::Open => {
            let waves = vec![wave(0.3, 50.0, 100.0, 90.0, None)];
            let layers = two_layers([layer(0.2, 90.0, 1020.0), layer(0.2, 90.0, 1024.0)], 2.0, 0.5, waves);
            let train = TrainSpec { phase_deg: None, ..train(0.2, 4.0, 90.0) };
            let waves = WavesSpec { trains: vec![train], spectrum: None, stokes: true, mixing: NonNegative::new(0.0) };
            vec![CurrentSpec::new(layers), meander(0.02, 0.05, 5.0), CurrentSpec::new(waves)]
        }
    }
}

/// Filaments about the middle of the area, and what is felt beside some of them.
fn cloud(case: Case, centre: Vector2<f64>) -> (u64, Vec<Vector3<f64>>, Vec<f64>) {
    let flume = case == Case::Flume;
    let (length_m, width_m, depth_m) = if flume { (2.5, 1.07, 0.2) } else { (40.0, 20.0, 5.0) };
    let area = Area { centre, length_m, width_m, axis: Heading::from_deg(90.0) };
    let bed = Terrain::Level { depth_m };
    let blockage = (case == Case::Blocked).then(|| BlockageSpec {
        cell_m: Positive::new(1.0),
        levels: 6,
        margin_m: NonNegative::new(5.0),
        ..BlockageSpec::default()
    });
    let mut spec = WaterSpec { currents: currents(case), blockage, ..WaterSpec::default() };
    if !flume {
        spec.mixing.horizontal_m2_s = NonNegative::new(0.005);
    }
    let solids = match case {
        Case::Open | Case::Flume => Obstacles::default(),
        _ => solids(&[(block([3.0, 4.0, 5.0]), centre.x - 10.0, centre.y + 0.5, 20.0)], &bed),
    };
    let start_m = if flume { -0.9 } else { -17.0 };
    let nozzle = source(if flume { 0.1 } else { 2.5 }, 5.0, 0.0005, 0.02).at(centre.x + start_m, centre.y);
    let (mut water, mut plume) = plume_in(&spec, nozzle, &area, &bed, &solids, 2.0);
    for n in 0..if flume { 150 } else { 600 } {
        water.advance(0.25 * f64::from(n));
        plume.drift_on(&water, 0.25, n..n + 1);
    }
    let all: Vec<Vector3<f64>> = plume.places().collect();
    let felt = all.iter().step_by(20).map(|p| plume.concentration(&(p + Vector3::new(0.01, 0.02, 0.0))));
    let felt = felt.collect();
    let local = all.iter().map(|p| p - centre.push(0.0)).collect();
    (plume.left(), local, felt)
}

#[test]
fn a_plume_does_not_depend_on_where_the_datum_is() {
    for case in [Case::Open, Case::Solids, Case::Blocked, Case::Flume] {
        let [here, near, far] = PLACES.map(|p| cloud(case, p.into()));
        assert!(here.1.len() > 100 && here.2.iter().any(|c| *c > 0.0), "{case:?}");
        for there in [near, far] {
            // Places of 1e7 m are doubles of 2e-9 m, so that some filaments are another float, and a few of those turn
            // at a wall where the others pass.
            let n = here.1.len();
            assert!(there.1.len().abs_diff(n) * 100 <= n && there.0.abs_diff(here.0) * 100 <= n as u64, "{case:?}");
            let off = (here.1.iter().zip(&there.1)).filter(|(a, b)| (*a - *b).norm() > 1e-3).count();
            assert!(off * 50 <= n, "{case:?}: {off} of {n} filaments are elsewhere");
            let sum = |felt: &[f64]| felt.iter().sum::<f64>();
            assert!((sum(&there.2) / sum(&here.2) - 1.0).abs() < 0.02, "{case:?}");
        }
    }
}
