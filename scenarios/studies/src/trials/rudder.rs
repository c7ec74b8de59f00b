//! The rudder of a vehicle: what turns it as one, how far it goes, and where it is.

use robots::actuate::AutopilotSpec;
use robots::handoff::{Actuation, ActuatorCommand, DriveCommand, DriveEffect};
use robots::vehicles::Vehicle;

/// Least share of the strongest fin at which a fin counts as a part of the rudder.
const LEAST: f64 = 1e-3;

/// Fins that turn a vehicle. Its angle is positive to starboard.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rudder {
    /// Greatest angle, rad.
    pub(super) limit_rad: f64,
    /// Of a vehicle of a folder: the drives that are fins, and how far each goes for 1 rad of rudder.
    fins: Vec<(usize, f64)>,
    /// Its drives that push.
    thrusters: Vec<usize>,
}

impl Rudder {
    /// The rudder of a vehicle; `None` if no fin of it turns it.
    pub(super) fn fitted(craft: &Vehicle) -> Option<Self> {
        let plant = match craft {
            Vehicle::Finned(_) => {
                return Some(Self {
                    limit_rad: AutopilotSpec::default().fin_limit_deg.get().to_radians(),
                    fins: Vec::new(),
                    thrusters: Vec::new(),
                });
            }
            Vehicle::Kinematic(_) => return None,
            Vehicle::Described(vehicle) => vehicle.plant(),
        };
        let turns = |does: &DriveEffect| match does {
            // FLU: to starboard is a negative moment about z.
            DriveEffect::Lifts(arm) => -arm[5],
            _ => 0.0,
        };
        let drives = || plant.drives.iter().enumerate();
        let strongest = drives().map(|(_, d)| turns(&d.does).abs()).fold(0.0, f64::max);
        let fins: Vec<(usize, f64)> = drives()
            .map(|(k, d)| (k, turns(&d.does) / strongest.max(f64::MIN_POSITIVE)))
            .filter(|(_, share)| share.abs() > LEAST)
            .collect();
        let limit = |(k, share): &(usize, f64)| plant.drives[*k].limits[1] / share.abs();
        Some(Self {
            limit_rad: fins.iter().map(limit).reduce(f64::min)?,
            fins,
            thrusters: drives().filter(|(_, d)| matches!(d.does, DriveEffect::Pushes(..))).map(|(k, _)| k).collect(),
        })
    }

    /// Set-points with the rudder at an angle and the propellers as in `thrust`; the rest stays as the autopilot has it.
    pub(super) fn held(&self, set: Actuation, angle_rad: f64, thrust: &Actuation) -> Actuation {
        match (set, thrust) {
            (Actuation::Fins(set), Actuation::Fins(thrust)) => {
                Actuation::Fins(ActuatorCommand { rudder_rad: angle_rad, rpm: thrust.rpm, ..set })
            }
            (Actuation::Drives(set), Actuation::Drives(thrust)) => {
                let more = angle_rad - self.mean(set.all());
                let turned = |set: DriveCommand, (k, share): &(usize, f64)| set.with(*k, set.all()[*k] + share * more);
                let turned = self.fins.iter().fold(set, turned);
                let pushing = |set: DriveCommand, k: &usize| set.with(*k, thrust.all()[*k]);
                Actuation::Drives(self.thrusters.iter().fold(turned, pushing))
            }
            (other, _) => other,
        }
    }

    /// Where it is, rad.
    pub(super) fn angle_rad(&self, craft: &Vehicle) -> f64 {
        match craft {
            Vehicle::Finned(vehicle) => vehicle.actuators().rudder_rad,
            Vehicle::Kinematic(_) => 0.0,
            Vehicle::Described(vehicle) => self.mean(vehicle.states()),
        }
    }

    /// The angle of all fins as one: what they do as stern planes cancels, because they are alike on both sides.
    fn mean(&self, states: &[f64]) -> f64 {
        let squares: f64 = self.fins.iter().map(|(_, share)| share * share).sum();
        let sum: f64 = self.fins.iter().map(|(k, share)| share * states[*k]).sum();
        sum / squares
    }
}
