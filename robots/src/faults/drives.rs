//! Alters the set-points of faulty drives after the pilot has set them.
//!
//! *Source*: none; the kinds of fault are those that reports of vehicles name: a fin that jams, a propeller that turns
//! too slowly, a drive without power.
//!
//! *Parameters*: those of the scenario, [`FaultSpec`].
//!
//! *Deviations*: a drive still follows its altered set-point with its own lag and within its own limits. So one that
//! sticks stays at its last set-point, which it may reach a moment later.

use super::drive_spec::DriveFault;
use super::span::Span;
use super::spec::{FaultSpec, FaultSubject};
use crate::handoff::{Actuation, DriveUnit, NamedDrive};
use bevy_ecs::prelude::Component;
use world::clock::Clock;

/// The faults of a robot's drives.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct DriveFaults(Vec<Failing>);

/// A drive that fails.
#[derive(Clone, Debug, PartialEq)]
struct Failing {
    span: Span,
    /// Its place among the set-points, its unit, and its set-point at which it does nothing.
    place: usize,
    unit: DriveUnit,
    idle: f64,
    how: DriveFault,
    /// Its last set-point.
    last: Option<f64>,
}

impl DriveFaults {
    /// Those among the faults of a robot with these drives; steps take `dt_s`.
    ///
    /// # Panics
    /// If the vehicle has no drive of a name: `mistakes` finds that before a run.
    pub fn new(faults: &[FaultSpec], dt_s: f64, drives: &[NamedDrive]) -> Self {
        let failing = |fault: &FaultSpec| match fault.what.subject() {
            FaultSubject::Drive(name, how) => {
                let place = drives.iter().position(|d| d.name == name).unwrap_or_else(|| {
                    panic!("a fault is of the drive {name}, which the vehicle has not; check the scenario")
                });
                Some(Failing {
                    span: fault.span(dt_s),
                    place,
                    unit: drives[place].unit,
                    idle: drives[place].idle,
                    how,
                    last: None,
                })
            }
            FaultSubject::Instrument(..) => None,
        };
        Self(faults.iter().filter_map(failing).collect())
    }

    /// Alters the set-points of this step.
    pub fn alter(&mut self, clock: &Clock, set: &mut Actuation) {
        for fault in self.0.iter_mut().filter(|f| !f.span.is_over(clock)) {
            let mut value = set.drive(fault.place).expect("it is a drive of the vehicle that takes these set-points");
            if fault.span.holds(clock) {
                value = match &fault.how {
                    DriveFault::Stuck => fault.last.unwrap_or(value),
                    DriveFault::StuckAt(at) => match fault.unit {
                        DriveUnit::Fin => at.get().to_radians(),
                        DriveUnit::Rpm | DriveUnit::Own => at.get(),
                    },
                    DriveFault::Weak(share) => fault.idle + (value - fault.idle) * share.get(),
                    DriveFault::Dead => fault.idle,
                };
            }
            *set = set.with_drive(fault.place, value);
            fault.last = Some(value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::fault;
    use super::super::{DriveSpec, Faulty, FinFault, PropellerFault};
    use super::*;
    use crate::handoff::{ActuatorCommand, DriveCommand};
    use world::ranges::{Finite, Fraction};

    /// Rudder, stern plane and propeller in ten steps of 1 s in which the pilot asks for ever more.
    fn flown(faults: &[FaultSpec]) -> Vec<ActuatorCommand> {
        let mut faults = DriveFaults::new(faults, 1.0, &NamedDrive::fins());
        let step = |step: u64| {
            let t = step as f64;
            let mut set =
                Actuation::Fins(ActuatorCommand { rudder_rad: 0.01 * t, stern_rad: -0.01 * t, rpm: 100.0 * t });
            faults.alter(&Clock { step, dt_s: 1.0 }, &mut set);
            match set {
                Actuation::Fins(set) => set,
                _ => unreachable!("fins stay fins"),
            }
        };
        (0..10).map(step).collect()
    }

    #[test]
    fn a_drive_fails_in_its_time_and_no_other_with_it() {
        let healthy = flown(&[]);
        for (what, held) in [
            (Faulty::Rudder(FinFault::Stuck), [0.02; 4]),
            (Faulty::Rudder(FinFault::StuckAt(Finite::new(180.0 / 4.0))), [std::f64::consts::FRAC_PI_4; 4]),
            (Faulty::Rudder(FinFault::Dead), [0.0; 4]),
            (Faulty::Rudder(FinFault::Weak(Fraction::new(0.5))), [0.015, 0.02, 0.025, 0.03]),
        ] {
            let set = flown(&[fault(3.0, Some(7.0), what.clone())]);
            for (t, (now, well)) in set.iter().zip(&healthy).enumerate() {
                let want = if (3..7).contains(&t) { held[t - 3] } else { well.rudder_rad };
                assert!((now.rudder_rad - want).abs() < 1e-12, "{what:?} at {t}");
                assert_eq!((now.stern_rad, now.rpm), (well.stern_rad, well.rpm));
            }
        }
    }

    #[test]
    fn several_drives_fail_and_one_after_the_other() {
        let set = flown(&[
            fault(2.0, Some(4.0), Faulty::Propeller(PropellerFault::Dead)),
            fault(4.0, None, Faulty::Propeller(PropellerFault::Stuck)),
            fault(5.0, None, Faulty::SternPlane(FinFault::Stuck)),
        ]);
        let rpm: Vec<f64> = set.iter().map(|s| s.rpm).collect();
        // What sticks does so at the set-point that the fault before left.
        assert_eq!(rpm[..5], [0.0, 100.0, 0.0, 0.0, 0.0]);
        assert_eq!(rpm[5..], [0.0; 5]);
        assert!(set[5..].iter().all(|s| s.stern_rad == -0.04));
        // One that sticks at once does so where it is first set.
        let at_once = flown(&[fault(0.0, None, Faulty::Propeller(PropellerFault::Stuck))]);
        assert!(at_once.iter().all(|s| s.rpm == 0.0));
    }

    #[test]
    fn a_weak_thruster_is_weak_from_where_it_does_nothing() {
        let thruster = NamedDrive { name: "thruster".into(), unit: DriveUnit::Own, idle: 1500.0 };
        let set = |how| {
            let what = Faulty::Drive(DriveSpec { link: "thruster".into(), how });
            let drives = [thruster.clone()];
            let mut faults = DriveFaults::new(&[fault(0.0, None, what)], 1.0, &drives);
            let mut set = Actuation::Drives(DriveCommand::new(&[1900.0]));
            faults.alter(&Clock { step: 0, dt_s: 1.0 }, &mut set);
            set.drive(0).expect("it has one")
        };
        assert_eq!(set(DriveFault::Weak(Fraction::new(0.5))), 1700.0);
        assert_eq!(set(DriveFault::Dead), 1500.0);
        assert_eq!(set(DriveFault::StuckAt(Finite::new(1600.0))), 1600.0);
    }
}
