//! Where the instruments of a robot sit, and how far they see.

use nalgebra::{UnitQuaternion, Vector3};
use rheotaxis::scenario::RobotSpec;
use robots::sense::{
    AdcpSpec, AltimeterSpec, CameraSpec, CtdSpec, DvlSpec, FluorometerSpec, Look, RangingSpec, SidescanSpec,
};
use robots::vehicles::Description;
use std::f64::consts::FRAC_PI_2;
use world::frames::Pose;

/// An instrument in its place. Its x axis is the direction in which it looks, its z axis is up if that is level.
#[derive(Clone, Debug, PartialEq)]
pub struct SensorPlace {
    /// What it is: `camera`, `altimeter`, `ranging`, `sidescan`, `chemical`, `dvl`, `adcp`, `ctd`, `probe`.
    pub kind: &'static str,
    /// Its name: that of its link.
    pub name: String,
    /// The link in whose axes `pose` is: the body of a robot, the probe itself of a gantry.
    pub link: String,
    /// Its place and direction.
    pub pose: Pose,
    /// Full angle that it covers to both sides, rad; of a sidescan in the vertical.
    pub view_rad: Option<f64>,
    /// Full angle that it covers up and down, rad.
    pub height_rad: Option<f64>,
    /// Its greatest range, m.
    pub max_m: Option<f64>,
}

/// Those of a robot for which its vehicle has a link.
pub(super) fn of_robot(spec: &RobotSpec, description: &Description) -> Vec<SensorPlace> {
    let mut all = Vec::new();
    let mut put = |kind: &'static str, name: &str, turned, view_rad, height_rad, max_m| {
        let Some(link) = description.links.iter().find(|l| l.name == name) else {
            return;
        };
        let pose = Pose { p_WB: link.pose.p_WB, R_WB: turned };
        all.push(SensorPlace {
            kind,
            name: name.to_owned(),
            link: description.root.clone(),
            pose,
            view_rad,
            height_rad,
            max_m,
        });
    };
    let ahead = UnitQuaternion::identity();
    let [up, down] = [-FRAC_PI_2, FRAC_PI_2].map(pitched);
    let sensors = &spec.sensors;
    if sensors.get::<FluorometerSpec>().is_some() {
        put("chemical", "fluorometer", ahead, None, None, None);
    }
    if let Some(s) = sensors.get::<CameraSpec>() {
        let mount = description.links.iter().find(|l| l.name == "camera");
        let mount = mount.map_or(ahead, |l| l.pose.R_WB);
        let [pan, tilt] = [s.pan_deg, s.tilt_deg].map(|a| a.get().to_radians());
        let turned = mount * UnitQuaternion::from_euler_angles(0.0, tilt, pan);
        let view = s.view_deg.get().to_radians();
        let shape = f64::from(s.height) / f64::from(s.width);
        let height = 2.0 * world::math::atan2(shape * world::math::tan(0.5 * view), 1.0);
        put("camera", "camera", turned, Some(view), Some(height), None);
    }
    if let Some(s) = sensors.get::<AltimeterSpec>() {
        put("altimeter", "altimeter", down, None, None, Some(s.max_range_m.get()));
    }
    if let Some(s) = sensors.get::<RangingSpec>() {
        let [view, height] = [s.width_deg, s.height_deg].map(|a| Some(a.get().to_radians()));
        put("ranging", "ranging", ahead, view, height, Some(s.max_range_m.get()));
    }
    if let Some(s) = sensors.get::<SidescanSpec>() {
        let aperture = Some(s.aperture_deg.get().to_radians());
        put("sidescan", "sidescan", ahead, aperture, None, Some(s.range_m.get()));
    }
    if let Some(s) = sensors.get::<DvlSpec>() {
        put("dvl", "dvl", down, None, None, Some(s.max_altitude_m.get()));
    }
    if let Some(s) = sensors.get::<AdcpSpec>() {
        let look = match s.look {
            Look::Up => up,
            Look::Down => down,
        };
        let far_m = s.dead_zone_m.get() + s.cell_m.get();
        put("adcp", "adcp", look, None, None, Some(far_m));
    }
    if sensors.get::<CtdSpec>().is_some() {
        put("ctd", "ctd", ahead, None, None, None);
    }
    all
}

/// A turn of the nose down, rad.
fn pitched(down_rad: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_axis_angle(&Vector3::y_axis(), down_rad)
}
