//! Messages of instruments: attitude, pressure, range, velocity.
//!
//! *Source*: ROS 2 common_interfaces (Jazzy); REP 145 (a quantity that is not measured has -1 as its first
//! covariance), REP 117 (a range beyond the greatest is +∞, below the least -∞).
//! *Parameters*: none.
//! *Deviations*: other covariances and variances are zero, which means "unknown" in ROS.

use super::cdr::{Header, cdr, xyz};
use nalgebra::{UnitQuaternion, Vector3};

/// An `Imu`: the attitude of a frame in east, north, up, and its rates, rad/s. The acceleration is marked as not
/// measured.
pub fn imu(t_ns: u64, frame: &str, attitude: &UnitQuaternion<f64>, rates: &Vector3<f64>) -> Vec<u8> {
    const UNKNOWN: [f64; 9] = [0.0; 9];
    const NOT_MEASURED: [f64; 9] = [-1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let q: [f64; 4] = attitude.coords.into();
    cdr(&(Header::new(t_ns, frame), (q, UNKNOWN), (xyz(rates), UNKNOWN), ([0.0; 3], NOT_MEASURED)))
}

/// A `FluidPressure` of an absolute pressure, Pa.
pub fn fluid_pressure(t_ns: u64, frame: &str, pressure_Pa: f64) -> Vec<u8> {
    cdr(&(Header::new(t_ns, frame), pressure_Pa, 0.0))
}

/// A `TwistStamped` of a velocity, m/s; its angular part is zero.
pub fn twist_stamped(t_ns: u64, frame: &str, linear: &Vector3<f64>) -> Vec<u8> {
    cdr(&(Header::new(t_ns, frame), xyz(linear), [0.0; 3]))
}

/// A `Range` by sound along the x axis of a frame: the full opening angle of the cone, rad, the least and the greatest
/// range, m, and the range, m, or `None` if nothing was heard.
pub fn range(t_ns: u64, frame: &str, view_rad: f64, limits_m: [f64; 2], range_m: Option<f64>) -> Vec<u8> {
    const ULTRASOUND: u8 = 0;
    let range = range_m.map_or(f32::INFINITY, |m| m as f32);
    let variance: f32 = 0.0;
    cdr(&(Header::new(t_ns, frame), ULTRASOUND, view_rad as f32, limits_m.map(|m| m as f32), range, variance))
}

#[cfg(test)]
mod tests {
    use super::super::messages::tests::{HEADER, T_NS, is, p, q};
    use super::*;

    const ATTITUDE: &str = "0000000000000000 0000000000000000 333333333333e33f 9a9999999999e93f";
    const PLACE: &str = "000000000000f03f 0000000000000440 00000000000008c0";

    #[test]
    fn acceleration_is_marked_as_not_measured() {
        let unknown = "00".repeat(9 * 8);
        let none = "00".repeat(8 * 8);
        let zero = "00".repeat(3 * 8);
        is(
            &imu(T_NS, "world", &q(), &p()),
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
        let heard = |range_m| range(T_NS, "world", 0.0, [0.5, 30.0], range_m);
        // The kind of sound, zero, is in the padding of the header.
        let limits = "0000003f 0000f041";
        is(&heard(Some(2.0)), &format!("{HEADER} 00000000 {limits} 00000040 00000000"));
        is(&heard(None), &format!("{HEADER} 00000000 {limits} 0000807f 00000000"));
    }
}
