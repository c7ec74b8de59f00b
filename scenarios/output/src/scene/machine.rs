//! The robots and gantries of a scenario.

use super::sensors::{SensorPlace, of_robot};
use nalgebra::{UnitQuaternion, Vector3};
use rheotaxis::scenario::{FolderFiles, GantryBlock, RobotSpec};
use robots::error::RobotError;
use robots::sense::{AltimeterSpec, FluorometerSpec, RangingSpec};
use robots::vehicles::{Description, Gantry};
use world::frames::Pose;
use world::terrain::Terrain;

/// A robot or a gantry.
#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    /// Its id in the scenario.
    pub id: String,
    /// Its name in ROS.
    pub name: String,
    /// Its URDF.
    pub description: Description,
    /// Where a gantry stands; `None` for a robot.
    pub base: Option<Pose>,
    /// Names of a gantry's slides, in the order of its states.
    pub slides: Vec<String>,
    /// Names of its probes, in the order of a scan.
    pub probes: Vec<String>,
    /// Least and greatest range of its altimeter, m.
    pub altimeter_m: Option<[f64; 2]>,
    /// Least and greatest range of its forward ranging, m, and the angle that its beams cover, rad.
    pub ranging: Option<([f64; 2], f64)>,
    /// Its instruments, those for which it has a link.
    pub sensors: Vec<SensorPlace>,
    /// Detection threshold of its chemical sensor as a share of full scale, and full scale, V.
    pub threshold: Option<(f64, f64)>,
}

impl Machine {
    pub(super) fn of_robot(spec: &RobotSpec, files: &FolderFiles) -> Result<Self, RobotError> {
        let id = spec.id.as_str();
        let ranging = spec.sensors.get::<RangingSpec>();
        let altimeter = spec.sensors.get::<AltimeterSpec>();
        let dye = spec.sensors.get::<FluorometerSpec>();
        let description = Description::of_vehicle(&spec.vehicle, files)?;
        Ok(Self {
            id: id.to_owned(),
            name: ros_name(id),
            sensors: of_robot(spec, &description),
            description,
            base: None,
            slides: Vec::new(),
            probes: Vec::new(),
            altimeter_m: altimeter.map(|a| [a.min_range_m.get(), a.max_range_m.get()]),
            ranging: ranging.map(|r| {
                let limits_m = [r.min_range_m.get(), r.max_range_m.get()];
                (limits_m, r.width_deg.get().to_radians())
            }),
            threshold: dye.map(|f| (f.threshold.get(), f.full_scale_v.get())),
        })
    }

    pub(super) fn of_gantry(block: &GantryBlock, terrain: &Terrain, files: &FolderFiles) -> Result<Self, RobotError> {
        let (id, gantry) = (block.id.as_str(), Gantry::load(&block.gantry, files)?);
        let probes = block.layout(&gantry).probes.into_iter();
        let probes: Vec<String> = probes.map(|p| p.name).collect();
        let tip = |name: &String| SensorPlace {
            kind: "probe",
            name: name.clone(),
            link: name.clone(),
            pose: Pose { p_WB: Vector3::zeros(), R_WB: UnitQuaternion::identity() },
            view_rad: None,
            height_rad: None,
            max_m: None,
        };
        Ok(Self {
            id: id.to_owned(),
            name: ros_name(id),
            description: Description::of_gantry(&block.gantry, files)?,
            base: Some(block.base(terrain)),
            slides: gantry.joint_names().map(str::to_owned).to_vec(),
            sensors: probes.iter().map(tip).collect(),
            probes,
            altimeter_m: None,
            ranging: None,
            threshold: None,
        })
    }

    /// Name of the frame of one of its links in ROS.
    pub fn frame(&self, link: &str) -> String {
        format!("{}/{link}", self.name)
    }
}

/// A machine's own name in ROS: a name there begins with a letter and has no two underscores in a row.
pub(crate) fn ros_name(id: &str) -> String {
    let mut name = String::new();
    if !id.starts_with(|c: char| c.is_ascii_alphabetic()) {
        name.push('r');
    }
    for c in id.chars() {
        if !(c == '_' && name.ends_with('_')) {
            name.push(c);
        }
    }
    name
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_can_be_names_in_ros() {
        assert_eq!(ros_name("auv0"), "auv0");
        assert_eq!(ros_name("0_auv"), "r0_auv");
        assert_eq!(ros_name("_a__b"), "r_a_b");
    }
}
