//! The rudder of a vehicle: what turns it as one, how far it goes, and where it is.

use robots::handoff::{Actuation, DriveEffect};
use robots::vehicles::{Vehicle, VehicleDrive};

/// Least share of the strongest fin at which a fin counts as a part of the rudder.
const LEAST: f64 = 1e-3;

/// Fins that turn a vehicle. Its angle is positive to starboard.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Rudder {
    /// Greatest angle, rad.
    pub(super) limit_rad: f64,
    /// The drives that are fins, and how far each goes for 1 rad of rudder.
    fins: Vec<(usize, f64)>,
    /// Its drives that push.
    thrusters: Vec<usize>,
}

impl Rudder {
    /// The rudder of a vehicle; `None` if no fin of it turns it.
    pub(super) fn fitted(craft: &Vehicle) -> Option<Self> {
        let drives = craft.drives();
        let turns = |drive: &VehicleDrive| match drive.does {
            // FLU: to starboard is a negative moment about z.
            DriveEffect::Lifts(arm) => -arm[5],
            _ => 0.0,
        };
        let strongest = drives.iter().map(|d| turns(d).abs()).fold(0.0, f64::max);
        let all = || drives.iter().enumerate();
        let fins: Vec<(usize, f64)> = all()
            .map(|(k, d)| (k, turns(d) / strongest.max(f64::MIN_POSITIVE)))
            .filter(|(_, share)| share.abs() > LEAST)
            .collect();
        let limit = |(k, share): &(usize, f64)| drives[*k].limits[1] / share.abs();
        Some(Self {
            limit_rad: fins.iter().map(limit).reduce(f64::min)?,
            fins,
            thrusters: all().filter(|(_, d)| matches!(d.does, DriveEffect::Pushes(..))).map(|(k, _)| k).collect(),
        })
    }

    /// Set-points with the rudder at an angle and the propellers as in `thrust`; the rest stays as the autopilot has it.
    pub(super) fn held(&self, set: Actuation, angle_rad: f64, thrust: &Actuation) -> Actuation {
        let of = |set: &Actuation, k: usize| set.drive(k).expect("it is one of its drives");
        let more = angle_rad - self.mean(|k| of(&set, k));
        let turned = |set: Actuation, (k, share): &(usize, f64)| set.with_drive(*k, of(&set, *k) + share * more);
        let turned = self.fins.iter().fold(set, turned);
        self.thrusters.iter().fold(turned, |set, k| set.with_drive(*k, of(thrust, *k)))
    }

    /// Where it is, rad.
    pub(super) fn angle_rad(&self, craft: &Vehicle) -> f64 {
        let states = craft.states();
        self.mean(|k| states[k])
    }

    /// The angle of all fins as one: what they do as stern planes cancels, because they are alike on both sides.
    fn mean(&self, state: impl Fn(usize) -> f64) -> f64 {
        let squares: f64 = self.fins.iter().map(|(_, share)| share * share).sum();
        let sum: f64 = self.fins.iter().map(|(k, share)| share * state(*k)).sum();
        sum / squares
    }
}
