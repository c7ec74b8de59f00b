//! Messages of instruments: attitude, pressure, range, velocity.
//!
//! *Source*: ROS 2 common_interfaces (Jazzy); REP 145 (a quantity that is not measured has -1 as its first
//! covariance), REP 117 (a range beyond the greatest is +∞, below the least -∞).
//! *Parameters*: none.
//! *Deviations*: other covariances and variances are zero, which means "unknown" in ROS.

use super::cdr::{Header, cdr, xyz};
use nalgebra::{UnitQuaternion, Vector3};
use serde::Serialize;

/// Attitude and rates, for an `Imu`.
#[derive(Clone, Copy, Debug)]
pub struct Imu<'a> {
    /// Time, ns.
    pub t_ns: u64,
    /// Frame of the rates.
    pub frame: &'a str,
    /// Attitude of that frame in east, north, up.
    pub attitude: UnitQuaternion<f64>,
    /// Angular velocity, rad/s.
    pub rates: Vector3<f64>,
}

impl Imu<'_> {
    /// As CDR. The acceleration is marked as not measured.
    #[must_use]
    pub fn cdr(&self) -> Vec<u8> {
        const UNKNOWN: [f64; 9] = [0.0; 9];
        const NOT_MEASURED: [f64; 9] = [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
        let q: [f64; 4] = self.attitude.coords.into();
        cdr(&(Header::new(self.t_ns, self.frame), (q, UNKNOWN), (xyz(&self.rates), UNKNOWN), ([0.0; 3], NOT_MEASURED)))
    }
}

/// A `FluidPressure` of an absolute pressure, Pa.
#[must_use]
pub fn fluid_pressure(t_ns: u64, frame: &str, pressure_Pa: f64) -> Vec<u8> {
    cdr(&(Header::new(t_ns, frame), pressure_Pa, 0.0))
}

/// A `TwistStamped` of a velocity, m/s; its angular part is zero.
#[must_use]
pub fn twist_stamped(t_ns: u64, frame: &str, linear: &Vector3<f64>) -> Vec<u8> {
    cdr(&(Header::new(t_ns, frame), xyz(linear), [0.0; 3]))
}

/// A range by sound along the x axis of a frame, for a `Range`.
#[derive(Clone, Copy, Debug)]
pub struct Range<'a> {
    /// Time, ns.
    pub t_ns: u64,
    /// The frame.
    pub frame: &'a str,
    /// Full opening angle of the cone, rad.
    pub view_rad: f64,
    /// Least and greatest range, m.
    pub limits_m: [f64; 2],
    /// The range, m; `None` if nothing was heard.
    pub range_m: Option<f64>,
}

impl Range<'_> {
    /// As CDR.
    #[must_use]
    pub fn cdr(&self) -> Vec<u8> {
        #[derive(Serialize)]
        struct Message<'a> {
            header: Header<'a>,
            radiation_type: u8,
            field_of_view: f32,
            limits: [f32; 2],
            range: f32,
            variance: f32,
        }
        const ULTRASOUND: u8 = 0;
        cdr(&Message {
            header: Header::new(self.t_ns, self.frame),
            radiation_type: ULTRASOUND,
            field_of_view: self.view_rad as f32,
            limits: self.limits_m.map(|m| m as f32),
            range: self.range_m.map_or(f32::INFINITY, |m| m as f32),
            variance: 0.0,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::messages::tests::{HEADER, T_NS, is, p, q};
    use super::*;

    const ATTITUDE: &str = "0000000000000000 0000000000000000 333333333333e33f 9a9999999999e93f";
    const PLACE: &str = "000000000000f03f 0000000000000440 00000000000008c0";

    #[test]
    fn acceleration_is_marked_as_not_measured() {
        let imu = Imu { t_ns: T_NS, frame: "world", attitude: q(), rates: p() };
        let unknown = "00".repeat(9 * 8);
        let none = "00".repeat(8 * 8);
        let zero = "00".repeat(3 * 8);
        is(
            &imu.cdr(),
            &format!("{HEADER} 00000000 {ATTITUDE} {unknown} {PLACE} {unknown} {zero} 000000000000f0bf {none}"),
        );
    }

    #[test]
    fn pressure_and_velocity_keep_their_bytes() {
        is(&fluid_pressure(T_NS, "world", 2.5), &format!("{HEADER} 00000000 0000000000000440 0000000000000000"));
        is(&twist_stamped(T_NS, "world", &p()), &format!("{HEADER} 00000000 {PLACE} {}", "00".repeat(3 * 8)));
    }

    #[test]
    fn nothing_heard_is_infinitely_far() {
        let heard = Range { t_ns: T_NS, frame: "world", view_rad: 0.0, limits_m: [0.5, 30.0], range_m: Some(2.0) };
        // The kind of sound, zero, is in the padding of the header.
        let limits = "0000003f 0000f041";
        is(&heard.cdr(), &format!("{HEADER} 00000000 {limits} 00000040 00000000"));
        let deaf = Range { range_m: None, ..heard };
        is(&deaf.cdr(), &format!("{HEADER} 00000000 {limits} 0000807f 00000000"));
    }
}
