//! Vehicles that are built once, for robots that begin again and again in one ocean.

use crate::scenario::FolderFiles;
use bevy_ecs::prelude::Resource;
use robots::error::RobotError;
use robots::handoff::Capabilities;
use robots::vehicles::{Vehicle, VehicleSpec};
use std::path::Path;

/// Vehicles as they were before their first step, with what they can do. To read a URDF, and to find the greatest speed
/// of a hull, takes most of the time in which a robot begins.
#[derive(Resource, Debug, Default)]
pub(crate) struct VehiclePool(Vec<Built>);

#[derive(Debug)]
struct Built {
    spec: VehicleSpec,
    turn_m: f64,
    craft: Vehicle,
    able: Capabilities,
}

impl VehiclePool {
    /// A vehicle with its capabilities, as [`build`] gives it; built only the first time. Paths of `spec` are relative
    /// to `base_dir`, which must always be the same.
    ///
    /// # Errors
    /// If it cannot be built.
    pub(super) fn take(
        &mut self,
        spec: &VehicleSpec,
        turn_m: f64,
        base_dir: &Path,
    ) -> Result<(Vehicle, Capabilities), RobotError> {
        let known = |b: &&Built| b.spec == *spec && b.turn_m == turn_m;
        if let Some(built) = self.0.iter().find(known) {
            return Ok((built.craft.clone(), built.able));
        }
        let (craft, able) = build(spec, turn_m, base_dir)?;
        self.0.push(Built { spec: spec.clone(), turn_m, craft: craft.clone(), able });
        Ok((craft, able))
    }
}

/// A vehicle with its capabilities; `turn_m` is the radius of the tightest turn under the robot's guidance.
pub(super) fn build(spec: &VehicleSpec, turn_m: f64, base_dir: &Path) -> Result<(Vehicle, Capabilities), RobotError> {
    let craft = Vehicle::load(spec, &FolderFiles(base_dir))?;
    let able = craft.capabilities(turn_m);
    Ok((craft, able))
}

#[cfg(test)]
mod tests {
    use super::*;
    use robots::vehicles::RemusSpec;

    #[test]
    fn a_vehicle_is_built_once_for_each_description() {
        let mut yard = VehiclePool::default();
        let here = Path::new("");
        let remus = VehicleSpec::Remus100(RemusSpec::default());
        let rover = VehicleSpec::Shipped("bluerov2".into());
        for _ in 0..3 {
            let (craft, able) = yard.take(&remus, 11.5, here).unwrap();
            let (fresh, fresh_able) = build(&remus, 11.5, here).unwrap();
            assert_eq!(format!("{craft:?}"), format!("{fresh:?}"));
            assert_eq!(able, fresh_able);
            assert!(yard.take(&rover, 11.5, here).unwrap().1.hovers);
        }
        assert_eq!(yard.0.len(), 2);
        // Another radius is another answer.
        assert_eq!(yard.take(&remus, 14.0, here).unwrap().1.turning_radius_m, 14.0);
        assert_eq!(yard.0.len(), 3);
        assert!(yard.take(&VehicleSpec::Shipped("no such".into()), 1.0, here).is_err());
        assert_eq!(yard.0.len(), 3);
    }
}
