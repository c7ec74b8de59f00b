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
use super::spec::{FaultSpec, Of};
use crate::handoff::Actuation;
use bevy_ecs::prelude::Component;
use world::clock::Clock;

/// Unit in which a scenario gives the set-points of a drive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unit {
    /// Degrees; the set-point itself is in rad.
    Fin,
    /// Revolutions per minute.
    Rpm,
}

/// A drive: its name, its unit, its set-point.
pub(super) type Drive<'a> = (&'static str, Unit, &'a mut f64);

/// The drives of a vehicle that can fail, by the names that faults use.
pub(super) fn drives(set: &mut Actuation) -> Vec<Drive<'_>> {
    match set {
        Actuation::Fins(set) => vec![
            ("rudder", Unit::Fin, &mut set.rudder_rad),
            ("stern_plane", Unit::Fin, &mut set.stern_rad),
            ("propeller", Unit::Rpm, &mut set.rpm),
        ],
        // It moves as its helm asks, and has nothing that could fail.
        Actuation::Rates(_) => Vec::new(),
    }
}

/// The faults of a robot's drives.
#[derive(Component, Clone, Debug, Default, PartialEq)]
pub struct DriveFaults(Vec<Failing>);

/// A drive that fails.
#[derive(Clone, Debug, PartialEq)]
struct Failing {
    span: Span,
    drive: String,
    how: DriveFault,
    /// Its last set-point.
    last: Option<f64>,
}

impl DriveFaults {
    /// Those among the faults of a robot; steps take `dt_s`.
    #[must_use]
    pub fn new(faults: &[FaultSpec], dt_s: f64) -> Self {
        let failing = |fault: &FaultSpec| match fault.what.of() {
            Of::Drive(drive, how) => Some(Failing {
                span: fault.span(dt_s),
                drive: drive.to_string(),
                how,
                last: None,
            }),
            Of::Instrument(..) => None,
        };
        Self(faults.iter().filter_map(failing).collect())
    }

    /// Alters the set-points of this step.
    ///
    /// # Panics
    /// If the vehicle has no drive of a name: `mistakes` finds that before a run.
    pub fn alter(&mut self, clock: &Clock, set: &mut Actuation) {
        for fault in self.0.iter_mut().filter(|f| !f.span.is_over(clock)) {
            let (_, unit, value) = (drives(set).into_iter())
                .find(|(name, ..)| *name == fault.drive)
                .unwrap_or_else(|| {
                    panic!(
                        "a fault is of the drive {}, which the vehicle has not; check the scenario",
                        fault.drive
                    )
                });
            if fault.span.holds(clock) {
                *value = match &fault.how {
                    DriveFault::Stuck => fault.last.unwrap_or(*value),
                    DriveFault::StuckAt(at) => match unit {
                        Unit::Fin => at.get().to_radians(),
                        Unit::Rpm => at.get(),
                    },
                    DriveFault::Weak(share) => *value * share.get(),
                    DriveFault::Dead => 0.0,
                };
            }
            fault.last = Some(*value);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::fault;
    use super::super::{Faulty, FinFault, PropellerFault};
    use super::*;
    use crate::handoff::{ActuatorCommand, RateCommand};
    use world::ranges::{Finite, Fraction};

    /// Rudder, stern plane and propeller in ten steps of 1 s in which the pilot asks for ever more.
    fn flown(faults: &[FaultSpec]) -> Vec<ActuatorCommand> {
        let mut faults = DriveFaults::new(faults, 1.0);
        let step = |step: u64| {
            let t = step as f64;
            let mut set = Actuation::Fins(ActuatorCommand {
                rudder_rad: 0.01 * t,
                stern_rad: -0.01 * t,
                rpm: 100.0 * t,
            });
            faults.alter(&Clock { step, dt_s: 1.0 }, &mut set);
            match set {
                Actuation::Fins(set) => set,
                Actuation::Rates(_) => unreachable!("fins stay fins"),
            }
        };
        (0..10).map(step).collect()
    }

    #[test]
    fn a_drive_fails_in_its_time_and_no_other_with_it() {
        let healthy = flown(&[]);
        for (what, held) in [
            (Faulty::Rudder(FinFault::Stuck), [0.02; 4]),
            (
                Faulty::Rudder(FinFault::StuckAt(Finite::new(180.0 / 4.0))),
                [std::f64::consts::FRAC_PI_4; 4],
            ),
            (Faulty::Rudder(FinFault::Dead), [0.0; 4]),
            (
                Faulty::Rudder(FinFault::Weak(Fraction::new(0.5))),
                [0.015, 0.02, 0.025, 0.03],
            ),
        ] {
            let set = flown(&[fault(3.0, Some(7.0), what.clone())]);
            for (t, (now, well)) in set.iter().zip(&healthy).enumerate() {
                let want = if (3..7).contains(&t) {
                    held[t - 3]
                } else {
                    well.rudder_rad
                };
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
    }

    #[test]
    fn a_drive_that_sticks_at_once_sticks_where_it_is_first_set() {
        let set = flown(&[fault(0.0, None, Faulty::Propeller(PropellerFault::Stuck))]);
        assert!(set.iter().all(|s| s.rpm == 0.0));
    }

    #[test]
    fn a_kinematic_vehicle_has_no_drives() {
        assert!(drives(&mut Actuation::Rates(RateCommand::default())).is_empty());
    }
}
