//! Alters the readings of faulty instruments after all instruments have made theirs.
//!
//! *Source*: none; the kinds of fault are those of the common taxonomy of sensor faults: no output, stuck, bias, drift.
//!
//! *Parameters*: those of the scenario, [`FaultSpec`].
//!
//! *Deviations*: an instrument that is not silent keeps its rate and its failures to measure. A stuck one repeats its
//! last reading, one that never read its first. A bias is added to the finished reading, behind noise and
//! quantisation; what is marked invalid stays as it is. A range beyond the ranging's own is no echo. Numbers that
//! instruments of other crates write into `other` have no faults.

use super::reading_fault::ReadingFault;
use super::span::Span;
use super::spec::{FaultSpec, FaultSubject, Faulty};
use crate::handoff::{Beam, ChemicalReading, RangeScan, Readings};
use crate::sense::{FluorometerSpec, SensorsSpec};
use bevy_ecs::prelude::Component;
use world::clock::Clock;

/// The faults of a robot's instruments.
#[derive(Component, Clone, Debug, Default)]
pub struct SensorFaults {
    faults: Vec<(Span, Faulty, ReadingFault)>,
    /// Its scale.
    fluorometer: Option<Box<FluorometerSpec>>,
    /// The last reading of each instrument. Apart, because most robots have no faults.
    last: Box<Readings>,
}

impl SensorFaults {
    /// Those among the faults of a robot with these instruments; steps take `dt_s`.
    pub fn new(faults: &[FaultSpec], sensors: &SensorsSpec, dt_s: f64) -> Self {
        Self {
            faults: (faults.iter())
                .filter_map(|fault| match fault.what.subject() {
                    FaultSubject::Instrument(_, amiss) => Some((fault.span(dt_s), fault.what.clone(), amiss)),
                    FaultSubject::Drive(..) => None,
                })
                .collect(),
            fluorometer: sensors.get().cloned().map(Box::new),
            last: Box::default(),
        }
    }

    /// Alters the readings of this step.
    pub fn alter(&mut self, clock: &Clock, readings: &mut Readings) {
        if self.faults.is_empty() {
            return;
        }
        for (span, what, amiss) in &self.faults {
            if span.holds(clock) {
                let lasted_s = span.lasted_s(clock);
                alter(what, amiss, lasted_s, self.fluorometer.as_deref(), readings, &self.last);
            }
        }
        remember(&mut self.last, readings);
    }
}

fn alter(
    what: &Faulty,
    amiss: &ReadingFault,
    lasted_s: f64,
    fluorometer: Option<&FluorometerSpec>,
    now: &mut Readings,
    last: &Readings,
) {
    let off = amiss.off(lasted_s);
    match what {
        Faulty::Fluorometer(_) => one(amiss, &mut now.chemical, &last.chemical, |r| {
            if let Some(spec) = fluorometer {
                *r = more_dye(r, off, spec);
            }
        }),
        Faulty::Compass(_) => one(amiss, &mut now.attitude, &last.attitude, |r| {
            r.heading = r.heading.turned(off.to_radians());
        }),
        Faulty::Depth(_) => one(amiss, &mut now.depth, &last.depth, |r| r.depth_m += off),
        Faulty::Altimeter(_) => one(amiss, &mut now.altimeter, &last.altimeter, |r| {
            if r.valid {
                r.altitude_m = (r.altitude_m + off).max(0.0);
            }
        }),
        Faulty::Ranging(_) => one(amiss, &mut now.ranging, &last.ranging, |r| farther(r, off)),
        Faulty::Dvl(_) => one(amiss, &mut now.dvl, &last.dvl, |r| {
            if r.valid {
                r.v_body_m_s.x += off;
            }
        }),
        Faulty::Adcp(_) => one(amiss, &mut now.adcp, &last.adcp, |r| {
            if r.valid {
                r.v_body_m_s.x += off;
            }
        }),
        Faulty::Ctd(_) => one(amiss, &mut now.ctd, &last.ctd, |r| {
            r.density_kg_m3 = (r.density_kg_m3 + off).max(0.0);
        }),
        Faulty::Sidescan(_) => one(amiss, &mut now.sidescan, &last.sidescan, |_| {}),
        Faulty::Camera(_) => one(amiss, &mut now.picture, &last.picture, |_| {}),
        Faulty::Fixes(_) => one(amiss, &mut now.lbl, &last.lbl, |r| {
            r.position += amiss.displaced(lasted_s);
        }),
        Faulty::Rudder(_) | Faulty::SternPlane(_) | Faulty::Propeller(_) | Faulty::Drive(_) => {}
    }
}

/// Alters the reading of one instrument, if it made one in this step.
fn one<T: Clone>(amiss: &ReadingFault, now: &mut Option<T>, last: &Option<T>, wrong: impl FnOnce(&mut T)) {
    match (amiss, now.as_mut(), last) {
        (ReadingFault::Silent, ..) => *now = None,
        (ReadingFault::Stuck, Some(now), Some(last)) => now.clone_from(last),
        (ReadingFault::Stuck, ..) | (_, None, _) => {}
        (_, Some(now), _) => wrong(now),
    }
}

/// A fluorometer's reading with more dye than there is, µg/L.
fn more_dye(r: &ChemicalReading, by_ug_l: f64, spec: &FluorometerSpec) -> ChemicalReading {
    let of_full_scale = (r.of_full_scale + by_ug_l / spec.full_scale_ug_l.get()).clamp(0.0, 1.0);
    let volts = of_full_scale * spec.full_scale_v.get();
    ChemicalReading { volts, of_full_scale, detected: of_full_scale > spec.threshold.get() }
}

/// Every echo farther away, m.
fn farther(scan: &mut RangeScan, by_m: f64) {
    let moved =
        |beam: &Beam| Beam { echo_m: (beam.echo_m).map(|m| (m + by_m).max(0.0)).filter(|m| *m <= scan.max_m), ..*beam };
    scan.beams = scan.beams.iter().map(moved).collect();
}

/// Keeps what was read now.
fn remember(last: &mut Readings, now: &Readings) {
    fn keep<T: Clone>(last: &mut Option<T>, now: &Option<T>) {
        if now.is_some() {
            last.clone_from(now);
        }
    }
    keep(&mut last.chemical, &now.chemical);
    keep(&mut last.dvl, &now.dvl);
    keep(&mut last.adcp, &now.adcp);
    keep(&mut last.attitude, &now.attitude);
    keep(&mut last.depth, &now.depth);
    keep(&mut last.ctd, &now.ctd);
    keep(&mut last.altimeter, &now.altimeter);
    keep(&mut last.lbl, &now.lbl);
    keep(&mut last.ranging, &now.ranging);
    keep(&mut last.sidescan, &now.sidescan);
    keep(&mut last.picture, &now.picture);
}

#[cfg(test)]
#[path = "instruments_tests.rs"]
mod tests;
