//! Messages of a robot's instruments, each with the time of its reading.

use super::machine_messages::MachineMessages;
use super::topics;
use crate::ros::{echo_cloud, fluid_pressure, imu, nanoseconds, range, twist_stamped, vector3_stamped};
use crate::scene::frames::BODY;
use rheotaxis::frame::{NewestReadings, TimedReading};
use robots::handoff::{Attitude, RangeScan};

/// Pressure of the air at the surface, Pa: standard atmosphere.
const SURFACE_PA: f64 = 101_325.0;
/// Weight of sea water, N/m³: 1025 kg/m³ at standard gravity.
const WEIGHT_N_M3: f64 = 1025.0 * 9.806_65;

/// Adds the messages of all readings.
pub(super) fn add_readings(of: &mut MachineMessages, heard: &NewestReadings) {
    let body = of.machine.frame(BODY);
    if let Some(TimedReading { t_s, value }) = &heard.attitude {
        let attitude = Attitude {
            heading: value.heading,
            roll_rad: value.roll_rad,
            pitch_rad: value.pitch_rad,
            rates_rad_s: value.rates_rad_s,
        };
        of.add(&topics::IMU, imu(nanoseconds(*t_s), &body, &attitude.R_WB(), &value.rates_rad_s));
    }
    if let Some(TimedReading { t_s, value }) = &heard.depth {
        let pressure_Pa = SURFACE_PA + WEIGHT_N_M3 * value.depth_m;
        let cdr = fluid_pressure(nanoseconds(*t_s), &body, pressure_Pa);
        of.add(&topics::PRESSURE, cdr);
    }
    if let (Some(TimedReading { t_s, value }), Some(limits_m)) = (&heard.altimeter, of.machine.altimeter_m) {
        let (beam, height_m) = (of.machine.frame("altimeter_beam"), value.valid.then_some(value.altitude_m));
        of.add(&topics::ALTIMETER, range(nanoseconds(*t_s), &beam, 0.0, limits_m, height_m));
    }
    if let Some(scan) = &heard.ranging {
        ranging(of, scan, &body);
    }
    if let Some(TimedReading { t_s, value }) = heard.dvl.as_ref().filter(|r| r.value.valid) {
        let cdr = twist_stamped(nanoseconds(*t_s), &body, &value.v_body_m_s);
        of.add(&topics::DVL, cdr);
    }
    if let Some(TimedReading { t_s, value }) = heard.adcp.as_ref().filter(|r| r.value.valid) {
        let cdr = vector3_stamped(nanoseconds(*t_s), &body, &value.v_body_m_s);
        of.add(&topics::ADCP, cdr);
    }
}

/// The echoes of the forward ranging as points, and the nearest.
fn ranging(of: &mut MachineMessages, TimedReading { t_s, value: scan }: &TimedReading<RangeScan>, body: &str) {
    let t_ns = nanoseconds(*t_s);
    of.add(&topics::RANGING, echo_cloud(t_ns, body, scan));
    if let Some((limits_m, view_rad)) = of.machine.ranging {
        let nearest_m = scan.beams.iter().filter_map(|b| b.echo_m).min_by(f64::total_cmp);
        of.add(&topics::NEAREST, range(t_ns, &of.machine.frame("ranging"), view_rad, limits_m, nearest_m));
    }
}
