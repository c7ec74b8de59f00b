//! Checks that a vehicle's instruments reach bed and water where it starts and where it is sent, and that these places
//! are in the water.

use crate::scenario::fault::UnplacedFault;
use crate::scenario::schema::RobotSpec;
use nalgebra::{Vector2, Vector3};
use robots::handoff::Vertical;
use robots::sense::{AdcpSpec, AltimeterSpec, DvlSpec, Look, RangingSpec, SensorsSpec};
use robots::vehicles::Vehicle;
use world::area::Area;
use world::math;
use world::obstacles::Obstacles;
use world::terrain::Terrain;

/// A hull lower than this above the bed lies on it, m.
const ON_THE_BED_M: f64 = 0.1;

/// The surroundings of a robot.
pub(super) struct RobotSurroundings<'a> {
    pub area: &'a Area,
    pub terrain: &'a Terrain,
    pub obstacles: &'a Obstacles,
}

/// An instrument that looks up or down, and the range that it needs.
struct Sounder {
    name: &'static str,
    up: bool,
    /// Its height above the body's origin, m.
    above_m: f64,
    least_m: f64,
    most_m: f64,
    /// What happens without it.
    lacks: &'static str,
    /// The fields that set its least and greatest range.
    fields: [&'static str; 2],
}

impl Sounder {
    /// Its range at an altitude and a depth, m.
    fn range_m(&self, altitude_m: f64, depth_m: f64) -> f64 {
        if self.up { depth_m - self.above_m } else { altitude_m + self.above_m }
    }

    /// What is wrong at a range, if anything: the field, and a text.
    fn blind(&self, range_m: f64) -> Option<(&'static str, String)> {
        let side = if self.up { "surface" } else { "bed" };
        let range_m = range_m.max(0.0);
        if range_m < self.least_m {
            let why = format!(
                "{range_m:.2} m from the {side}, nearer than the {:.2} m that its {} needs: {}",
                self.least_m, self.name, self.lacks
            );
            Some((self.fields[0], why))
        } else if range_m > self.most_m {
            let why = format!(
                "{range_m:.1} m from the {side}, farther than the {} m that its {} reaches: {}",
                self.most_m, self.name, self.lacks
            );
            Some((self.fields[1], why))
        } else {
            None
        }
    }
}

/// The altimeter, the Doppler log and the current profiler, if they are fitted.
fn sounders(sensors: &SensorsSpec, vehicle: &Vehicle) -> Vec<Sounder> {
    let above_m = |name: &str| vehicle.mount(name).map_or(0.0, |pose| pose.p_WB.z);
    let mut all = Vec::new();
    all.extend(sensors.get::<AltimeterSpec>().map(|s| Sounder {
        name: "altimeter",
        up: false,
        above_m: above_m("altimeter"),
        least_m: s.min_range_m.get(),
        most_m: s.max_range_m.get(),
        lacks: "it cannot keep its altitude",
        fields: ["min_range_m", "max_range_m"],
    }));
    all.extend(sensors.get::<DvlSpec>().map(|s| Sounder {
        name: "dvl",
        up: false,
        above_m: above_m("dvl"),
        least_m: s.min_altitude_m.get(),
        most_m: s.max_altitude_m.get(),
        lacks: "it has no bottom lock and does not know how it moves",
        fields: ["min_altitude_m", "max_altitude_m"],
    }));
    all.extend(sensors.get::<AdcpSpec>().map(|s| Sounder {
        name: "adcp",
        up: s.look == Look::Up,
        above_m: above_m("adcp"),
        least_m: (s.dead_zone_m.get() + s.cell_m.get()) / math::cos(s.beam_angle_deg.get().to_radians()),
        most_m: f64::INFINITY,
        lacks: "its measuring cell is not in the water, and it does not know the flow",
        fields: ["dead_zone_m", "dead_zone_m"],
    }));
    all
}

/// Finds heights at which an instrument is out of range, and heights outside the water.
pub(super) fn view(
    i: usize,
    robot: &RobotSpec,
    vehicle: &Vehicle,
    place: &RobotSurroundings,
    found: &mut Vec<UnplacedFault>,
) {
    let depths_m = depths(place);
    let (least_m, most_m) = depths_m;
    let verticals = robot.strategy.about().wishes.verticals;
    let sounders = sounders(&robot.sensors, vehicle);
    for (field, vertical) in &verticals {
        let path = format!("robots[{i}].strategy.{field}");
        if let Some(problem) = nowhere(*vertical, least_m, most_m) {
            found.push(UnplacedFault::warning(path, problem).hint("keep it between bed and surface"));
            continue;
        }
        for s in &sounders {
            // A vehicle that keeps a depth needs no altimeter.
            if s.name == "altimeter" && matches!(vertical, Vertical::Depth(_)) {
                continue;
            }
            let blind = [least_m, most_m].map(|m| s.blind(range_at(s, *vertical, m)));
            // In a part of the area the last known flow will do, but the bed is needed everywhere.
            if s.name == "adcp" && blind.iter().any(Option::is_none) {
                continue;
            }
            if let Some((limit, why)) = blind.iter().flatten().next() {
                let part = if blind.iter().all(Option::is_some) { "" } else { "in a part of the area " };
                let problem = format!("{part}this keeps the vehicle {why}");
                let hint = format!("choose another height, or change {limit} of sensors.{}", s.name);
                found.push(UnplacedFault::warning(&path, problem).hint(hint));
            }
        }
    }
    start(i, robot, &sounders, place, &verticals, depths_m, found);
}

/// Checks the place where the robot starts.
fn start(
    i: usize,
    robot: &RobotSpec,
    sounders: &[Sounder],
    place: &RobotSurroundings,
    verticals: &[(String, Vertical)],
    (least_m, most_m): (f64, f64),
    found: &mut Vec<UnplacedFault>,
) {
    let p = robot.start.p_W(place.terrain);
    let path = format!("robots[{i}].start");
    let id = robot.id.as_str();
    let altitude_m = p.z - place.terrain.bed_z(p.x, p.y);
    // A start on or under the bed, or in the air, is reported elsewhere.
    if p.z > 0.0 || altitude_m < ON_THE_BED_M {
        return;
    }
    for s in sounders {
        let kept = verticals.first().map(|(_, vertical)| *vertical);
        // The flow is needed only when the vehicle has reached the height it is sent to.
        let cured = kept.is_some_and(|v| [least_m, most_m].iter().all(|m| s.blind(range_at(s, v, *m)).is_none()));
        let unneeded = s.name == "altimeter" && !matches!(kept, Some(Vertical::Altitude(_)));
        if unneeded || s.name == "adcp" && cured {
            continue;
        }
        let along = if s.up { Vector3::z() } else { -Vector3::z() };
        let from = p + Vector3::z() * s.above_m;
        let open_m = s.range_m(altitude_m, -p.z).max(0.0);
        let range_m = place.obstacles.ray(&from, &along, open_m).unwrap_or(open_m);
        if let Some((limit, why)) = s.blind(range_m) {
            let problem = format!("robot \"{id}\" starts {why}");
            let hint = format!("start it elsewhere, or give sensors.{} another {limit}", s.name);
            found.push(UnplacedFault::warning(&path, problem).hint(hint));
        }
    }
    if let Some(ranging) = robot.sensors.get::<RangingSpec>() {
        let ahead = robot.start.heading_deg.heading().unit();
        let least_m = ranging.min_range_m.get();
        let mount_m = robot.start.p_W(place.terrain);
        if let Some(m) = place.obstacles.ray(&mount_m, &Vector3::new(ahead.x, ahead.y, 0.0), least_m)
            && m < least_m
        {
            let problem = format!(
                "robot \"{id}\" starts {m:.2} m in front of an obstacle, nearer than the {least_m} m that its ranging \
                 needs: it does not see it"
            );
            found.push(UnplacedFault::warning(&path, problem).hint("start it elsewhere, or turn it away"));
        }
    }
}

/// The range of a sounder in water of that depth, m.
fn range_at(s: &Sounder, vertical: Vertical, water_m: f64) -> f64 {
    match vertical {
        Vertical::Altitude(m) => s.range_m(m, water_m - m),
        Vertical::Depth(m) => s.range_m(water_m - m, m),
    }
}

/// Why a height lies outside the water, if it does.
fn nowhere(vertical: Vertical, least_m: f64, most_m: f64) -> Option<String> {
    let (m, out) = match vertical {
        Vertical::Altitude(m) => (m, "above the surface"),
        Vertical::Depth(m) => (m, "below the bed"),
    };
    let water = if most_m - least_m < 0.005 {
        format!("the water is {most_m:.2} m deep")
    } else {
        format!("the water is {least_m:.2} to {most_m:.2} m deep")
    };
    if m >= most_m {
        Some(format!("{m} m is {out}: {water}"))
    } else if m >= least_m {
        Some(format!("{m} m is {out} in a part of the area: {water}"))
    } else {
        None
    }
}

/// Least and greatest depth of the area, m. The bed is a plane, so both are at corners.
fn depths(place: &RobotSurroundings) -> (f64, f64) {
    let half = Vector2::new(place.area.length_m, place.area.width_m) / 2.0;
    let corners = [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)]
        .map(|(a, b)| place.area.world(Vector2::new(a * half.x, b * half.y)))
        .map(|p| -place.terrain.bed_z(p.x, p.y));
    let least_m = corners.into_iter().fold(f64::INFINITY, f64::min);
    let most_m = corners.into_iter().fold(0.0, f64::max);
    (least_m, most_m)
}

#[cfg(test)]
mod tests {
    use crate::testing::{CHANNEL, NOTHING, told, told_once};

    const START: &str = "robots[0].start";
    const VERTICAL: &str = "robots[0].strategy.vertical";

    #[test]
    fn a_start_in_a_dead_zone_is_told() {
        let at = |height: &str| format!("(east_m: 150, north_m: -30, {height}, heading_deg: 0, speed_m_s: 1.5)");
        let low = told(CHANNEL, &[(START, &at("altitude_m: 0.3"))]);
        assert!(low[0].starts_with("robots[0].start: robot \"auv0\" starts 0.2"), "{low:?}");
        let deep = told(CHANNEL, &[("terrain.depth_m", "60"), (START, &at("depth_m: 2"))]);
        for (said, says) in [
            (&low[0], "nearer than the 0.30 m that its altimeter needs"),
            (&low[1], "nearer than the 0.50 m that its dvl needs"),
            (&deep[0], "farther than the 30 m that its altimeter reaches"),
        ] {
            assert!(said.contains(says), "{said}");
        }
        assert_eq!([low.len(), deep.len()], [2; 2]);
    }

    #[test]
    fn a_height_at_which_an_instrument_is_blind_is_told() {
        let low = told(CHANNEL, &[(VERTICAL, "Altitude(0.35)")]);
        assert_eq!(low.len(), 2, "{low:?}");
        assert!(low.iter().all(|s| s.starts_with(&format!("{VERTICAL}: this keeps the vehicle 0.2"))), "{low:?}");
        // Half a metre below the surface the upward profiler has no room for its cell.
        let high = told_once(CHANNEL, &[(VERTICAL, "Depth(0.5)")]);
        assert!(high.contains("of the") || high.contains("from the surface"), "{high}");
    }

    #[test]
    fn heights_outside_the_water_are_told() {
        assert_eq!(told(CHANNEL, &[]), NOTHING);
        for (vertical, says) in [("Altitude(30)", "30 m is above"), ("Depth(11)", "11 m is below the bed")] {
            let said = told_once(CHANNEL, &[(VERTICAL, vertical)]);
            assert!(said.starts_with(&format!("{VERTICAL}: {says}")) && said.ends_with("10.00 m deep"), "{said}");
        }
        let slope = "Slope(shoreward_heading_deg: 0, shallow_m: 4, deep_m: 20)";
        let part = told(CHANNEL, &[("terrain", slope), (VERTICAL, "Depth(6)")]);
        let says = "6 m is below the bed in a part of the area: the water is 4.00 to 20.00 m deep";
        assert!(part.iter().any(|s| s.ends_with(says)), "{part:?}");
    }
}
