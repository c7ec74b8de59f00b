//! Data acquisition unit: turns a scan into signals above clean water, and knows the place of each probe.
//!
//! *Source*: Webster et al. 2012 (Bioinspir. Biomim. 7:036023), section 4, Fig. 7 (data acquisition unit), Fig. 6.
//!
//! *Parameters*: none of its own; range of the output and places of the probes come from the machine.
//!
//! *Deviations*: from here on, signals are counted from the bottom of the range (-5 V in clean water), so that ratios
//! of signals are ratios of concentrations; the paper does not say how it forms 30 % of a voltage that may be
//! negative. The steering probes are the leftmost and the rightmost, whatever their names. A single probe is both, so
//! that nothing is ever stronger on one side.

use super::data::{Sample, Spike};
use crate::error::{RobotError, require};
use crate::handoff::{GantryLayout, JointReadings, MAX_PROBES, ProbeScan};
use nalgebra::Vector2;

/// Least distance across between the steering probes, m: probes nearer than this smell the same filament.
const APART_M: f64 = 1e-3;

/// The unit.
#[derive(Clone, Debug)]
pub struct Acquisition {
    range_v: [f64; 2],
    offsets_m: Vec<Vector2<f64>>,
    /// The leftmost probe.
    pub left: usize,
    /// The rightmost probe.
    pub right: usize,
}

impl Acquisition {
    /// The unit of a machine.
    ///
    /// # Errors
    /// [`RobotError::Invalid`] if of several probes no two are apart across the stream, or there are too many.
    pub fn new(layout: &GantryLayout) -> Result<Self, RobotError> {
        let must = |holds: bool, problem: String| require(holds, "tracker.probes", problem);
        let n = layout.probes.len();
        must((1..=MAX_PROBES).contains(&n), format!("a tracker needs 1 to {MAX_PROBES} probes; the head has {n}"))?;
        let offsets_m: Vec<_> = layout.probes.iter().map(|p| p.offset_m.xy()).collect();
        let (mut left, mut right) = (0, 0);
        for (i, o) in offsets_m.iter().enumerate() {
            if o.y > offsets_m[left].y {
                left = i;
            }
            if o.y < offsets_m[right].y {
                right = i;
            }
        }
        must(
            n == 1 || offsets_m[left].y - offsets_m[right].y >= APART_M,
            "no two probes are apart across the stream: bilateral steering needs a left and a right one".into(),
        )?;
        Ok(Self { range_v: layout.range_v, offsets_m, left, right })
    }

    /// Number of probes.
    pub fn count(&self) -> usize {
        self.offsets_m.len()
    }

    /// The signals of a scan.
    pub fn sample(&self, scan: &ProbeScan, joints: &JointReadings) -> Sample {
        assert!(
            scan.count == self.count(),
            "a scan of {} probes for a head of {}: sensors and tracker were assembled from different layouts",
            scan.count,
            self.count()
        );
        let [bottom, top] = self.range_v;
        let mut above_v = [0.0; MAX_PROBES];
        for (above, volts) in above_v.iter_mut().zip(scan.volts).take(scan.count) {
            assert!(
                volts.is_finite(),
                "a probe reads {volts} V at {} s: the sensor broke before the tracker",
                scan.t_s
            );
            *above = volts.clamp(bottom, top) - bottom;
        }
        Sample { t_s: scan.t_s, head_m: joints.position_m, speed_m_s: joints.speed_m_s, above_v, count: scan.count }
    }

    /// A spike of `probe` in the sample `of`.
    pub fn spike(&self, of: &Sample, probe: usize) -> Spike {
        Spike { t_s: of.t_s, probe, magnitude_v: of.above_v[probe], place_m: of.head_m + self.offsets_m[probe] }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{layout, scan};
    use super::*;
    use nalgebra::Vector3;

    #[test]
    fn signals_count_from_clean_water_and_places_from_the_head() {
        let a = Acquisition::new(&layout()).expect("legal");
        assert_eq!((a.left, a.right, a.count()), (0, 1, 3));
        let joints = JointReadings { position_m: Vector2::new(0.5, -0.1), ..Default::default() };
        let s = a.sample(&scan(1.0, [-5.0, -4.5, 7.0]), &joints);
        assert_eq!(s.above_v[..3], [0.0, 0.5, 10.0]);
        let spike = a.spike(&s, 1);
        assert_eq!(spike.magnitude_v, 0.5);
        assert!((spike.place_m - Vector2::new(0.5, -0.1625)).norm() < 1e-12);
    }

    #[test]
    fn a_single_probe_is_both_sides_and_several_must_be_apart() {
        let mut one = layout();
        one.probes.truncate(1);
        let a = Acquisition::new(&one).expect("a centre");
        assert_eq!((a.left, a.right), (0, 0));
        one.probes.clear();
        let e = Acquisition::new(&one).expect_err("none").to_string();
        assert_eq!(e, "tracker.probes: a tracker needs 1 to 8 probes; the head has 0");
        let mut line = layout();
        for p in &mut line.probes {
            p.offset_m = Vector3::new(0.0, 0.0, p.offset_m.z);
        }
        assert!(Acquisition::new(&line).is_err());
    }
}
