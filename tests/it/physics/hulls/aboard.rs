//! Instruments aboard other hulls: where the URDF puts them, in every scenario.

use super::kit::{folder, shipped};
use crate::common::{set, short};
use rheotaxis::scenario::FolderFiles;
use rheotaxis::trial::Trial;
use robots::handoff::Readings;
use robots::sense::Sensors;
use robots::vehicles::{SHIPPED, Vehicle, VehicleSpec};
use std::path::Path;

#[test]
fn every_shipped_vehicle_has_a_mount_for_every_instrument() {
    for vehicle in SHIPPED {
        let spec = VehicleSpec::Shipped(vehicle.folder.into());
        let craft = Vehicle::load(&spec, &FolderFiles(Path::new(""))).expect("shipped");
        assert!(craft.doubts().is_empty(), "{}: {:?}", vehicle.folder, craft.doubts());
        for sensor in world::registry::Registry::default().entries::<Sensors>() {
            // A pair sits beside the mount of the single one.
            let name = if sensor.name == "fluorometers_aside" { "fluorometer" } else { sensor.name };
            assert!(craft.mount(name).is_some(), "{}: {name}", vehicle.folder);
        }
    }
}

/// The altimeter reads more by as much as its link is raised.
#[test]
fn an_instrument_reads_from_where_its_link_is() {
    let (_, urdf) = shipped("bluerov2_heavy");
    let joint = urdf.find("altimeter_joint").expect("its joint");
    let origin = joint + urdf[joint..].find("<origin xyz=\"").expect("its place") + 13;
    let place = urdf[origin..].split('"').next().expect("numbers");
    let numbers: Vec<f64> = place.split_whitespace().map(|n| n.parse().expect("a number")).collect();
    let raised = format!("{} {} {}", numbers[0], numbers[1], numbers[2] + 0.25);
    let other = [&urdf[..origin], &raised, &urdf[origin + place.len()..]].concat();
    let file = robots::vehicles::ShippedVehicle::named("bluerov2_heavy").expect("shipped").file;
    let reads = |urdf: &str| {
        let dir = folder(file, ("bluerov2_heavy.urdf", urdf));
        let hull = format!("File(\"{}\")", dir.path().join("hull").display());
        let values = [("robots[0].vehicle", hull.as_str()), ("robots[0].start.speed_m_s", "0.5")];
        let loaded = short("uniform_channel", 0.0, 1800.0);
        let loaded = set(loaded, &values);
        let mut trial = Trial::assemble(&loaded, 1).expect("a run");
        let mut first = None;
        while first.is_none() && trial.step() {
            let world = &mut trial.simulation.world;
            let readings = world.query::<&Readings>().single(world).expect("a robot");
            first = readings.altimeter.as_ref().filter(|r| r.valid).map(|r| r.altitude_m);
        }
        first.expect("a reading")
    };
    let difference = reads(&other) - reads(&urdf);
    // The reading has noise, the same in both runs but for its rounding.
    assert!((difference - 0.25).abs() < 0.02, "{difference}");
}
