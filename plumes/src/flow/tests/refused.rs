//! Water that cannot be is refused by the field at fault, with what would be legal.

use world::area::Area;
use world::ranges::{HeadingDeg, Positive};
use world::terrain::Terrain;

use super::kit::{meander, meander_spec, of, rough, tide, uniform};
use super::water::{duck_area, duck_layers};
use crate::flow::WaterSpec;
use crate::flow::catalogue::CurrentSpec;
use crate::flow::channel::open_channel::OpenChannelSpec;
use crate::flow::eddies::tests_eddies::{BED, channel_spec, flume};
use crate::flow::eddies::{EddiesSpec, SmallSpec};
use crate::flow::layered::LayeredSpec;
use crate::flow::plane_current::meander::MeanderSpec;
use crate::flow::plane_current::tide::TideSpec;
use crate::flow::waves::tests::{regular, train, wind_sea};

const SEA: Terrain = Terrain::Level { depth_m: 10.0 };

#[track_caller]
fn refused(spec: &WaterSpec, area: &Area, bed: &Terrain, said: &str) {
    let e = spec.build(area, bed, 7).expect_err(said).to_string();
    assert!(e.starts_with(&format!("water.{said}")), "{e}");
}

#[test]
fn impossible_currents_at_sea_are_refused() {
    let layered = |change: &dyn Fn(&mut LayeredSpec)| {
        let mut layers = duck_layers();
        change(&mut layers);
        CurrentSpec::new(layers)
    };
    let crossed = layered(&|l| {
        l.layers.push(l.layers[1].clone());
        l.interfaces.push(l.interfaces[0].clone());
        l.interfaces[1].depth_m = Positive::new(1.0);
    });
    let light_below = layered(&|l| l.layers[1].density_kg_m3 = Positive::new(1000.0));
    let over = MeanderSpec { damping: Positive::new(1.5), ..meander_spec(0.1, 0.2, 25.0) };
    let waves = |trains| CurrentSpec::new(regular(trains));
    let mut many = wind_sea();
    many.spectrum.as_mut().unwrap().components = 1000;
    for (currents, said) in [
        (
            vec![uniform(0.0, 0.0), layered(&|l| l.layers.clear())],
            "currents[1].layers: needs from 1 to 4 layers, got 0",
        ),
        (vec![layered(&|l| l.interfaces.clear())], "currents[0].interfaces: 2 layers need 1 interfaces, got 0"),
        (vec![light_below], "currents[0].layers[1].density_kg_m3: must be >= 1020"),
        (vec![crossed], "currents[0].interfaces[1].depth_m: must be > 1.8"),
        (vec![layered(&|_| ()), layered(&|_| ())], "currents[1]: only one Layered"),
        (
            vec![tide(-0.5, 90.0)],
            "currents[0].constituents[0].minor_m_s: must be from -0.3 to 0.3 (major_m_s), got -0.5",
        ),
        (vec![CurrentSpec::new(TideSpec { constituents: vec![] })], "currents[0].constituents: needs one at least"),
        (vec![meander(0.1, 0.2, 0.1)], "currents[0].cell_m: must be >= 10.94 "),
        (vec![CurrentSpec::new(over)], "currents[0].damping: must be > 0 and < 1"),
        (
            vec![waves(vec![train(0.1, 8.0, 0.0), train(2.0, 2.0, 0.0)])],
            "currents[0].trains[1].height_m: must be > 0 and at most 0.887 (waves of 2 s in 10 m",
        ),
        (vec![waves(vec![])], "currents[0]: needs trains or a spectrum, got neither"),
        (vec![CurrentSpec::new(many)], "currents[0].spectrum.components: must be from 1 to 200, got 1000"),
        (vec![waves(vec![train(0.4, 4.0, 70.0)]), waves(vec![train(0.4, 4.0, 70.0)])], "currents[1]: only one Waves"),
    ] {
        refused(&of(currents), &duck_area(), &SEA, said);
    }
    let rough_above_its_layer = WaterSpec { bed: rough(0.5, 1.0), ..WaterSpec::default() };
    refused(&rough_above_its_layer, &duck_area(), &SEA, "bed.roughness_m: must be > 0 and at most");
}

#[test]
fn impossible_channels_are_refused() {
    let fine = channel_spec(0.05, 0.0);
    let with = |eddies| OpenChannelSpec { eddies: Some(eddies), ..fine.clone() };
    let small = |finest_m| {
        let small = Some(SmallSpec { finest_m: Positive::new(finest_m) });
        with(EddiesSpec { small, ..EddiesSpec::default() })
    };
    let across = OpenChannelSpec { heading_deg: HeadingDeg::new(30.0), ..fine.clone() };
    let deep = Terrain::Level { depth_m: 0.6 };
    for (spec, bed, said) in [
        (across, BED, "heading_deg: an OpenChannel flows along the area's axis, 90 or 270 degrees, got 30"),
        (channel_spec(0.005, 0.0), BED, "mean_m_s: gives a Reynolds number of 1000, must be >= 0.01"),
        (channel_spec(0.05, 0.15), BED, "roughness_m: must be >= 0 and at most 0.1"),
        (fine.clone(), deep, "eddies: resolved eddies need a channel from 2 to 20 times as wide as deep"),
        (
            with(EddiesSpec { cells_a_depth: 4, ..EddiesSpec::default() }),
            BED,
            "eddies.cells_a_depth: must be from 8 to 32, got 4",
        ),
        (small(0.03), BED, "eddies.small.finest_m: must be from 1.95e-4 to 2.50e-2"),
        (small(1e-4), BED, "eddies.small.finest_m: must be from 1.95e-4 to 2.50e-2"),
    ] {
        refused(&of(vec![CurrentSpec::new(spec)]), &flume(2.5), &bed, &format!("currents[0].{said}"));
    }
}
