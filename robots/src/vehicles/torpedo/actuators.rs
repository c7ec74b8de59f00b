//! Fins and propeller of a torpedo follow their set-points with a lag, within their limits.
//!
//! *Source:* first-order lags of the REMUS 100 model (Fossen 2021; see `coefficients.rs`).
//!
//! *Parameters:* `lag_s` of fins and propeller, `limit_deg`, `limit_rpm`.
//!
//! *Deviations:* none.

use super::coefficients::Coefficients;
use crate::handoff::ActuatorCommand;
use crate::vehicles::dynamics::Carried;

/// State of the actuators: what they would do if it was commanded.
pub(super) type Actuators = ActuatorCommand;

impl Carried for Actuators {
    fn moved(&self, rate: &Self, h: f64) -> Self {
        Self {
            rudder_rad: self.rudder_rad + rate.rudder_rad * h,
            stern_rad: self.stern_rad + rate.stern_rad * h,
            rpm: self.rpm + rate.rpm * h,
        }
    }
}

impl Actuators {
    /// The nearest state that the vehicle's actuators can reach.
    pub(super) fn limited(self, c: &Coefficients) -> Self {
        let (fin, rpm) = (c.fin_limit_rad, c.spec.propeller.limit_rpm.get());
        Self {
            rudder_rad: self.rudder_rad.clamp(-fin, fin),
            stern_rad: self.stern_rad.clamp(-fin, fin),
            rpm: self.rpm.clamp(-rpm, rpm),
        }
    }

    /// The commanded state, limited unless the limits act on the state.
    pub(super) fn asked(command: &ActuatorCommand, c: &Coefficients) -> Self {
        if c.spec.published { *command } else { command.limited(c) }
    }

    /// Rate of change of each towards the command, per second.
    pub(super) fn rate(&self, asked: &Self, c: &Coefficients) -> Self {
        let fin_s = c.spec.fins.lag_s.get();
        Self {
            rudder_rad: (asked.rudder_rad - self.rudder_rad) / fin_s,
            stern_rad: (asked.stern_rad - self.stern_rad) / fin_s,
            rpm: (asked.rpm - self.rpm) / c.spec.propeller.lag_s.get(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::remus100;
    use super::*;

    #[test]
    fn commands_beyond_the_limits_are_cut() {
        let c = remus100(false);
        let asked = Actuators::asked(&ActuatorCommand { rudder_rad: 1.0, stern_rad: -1.0, rpm: 9000.0 }, &c);
        assert!((asked.rudder_rad.to_degrees() - 15.0).abs() < 1e-12);
        assert!((asked.stern_rad.to_degrees() + 15.0).abs() < 1e-12);
        assert_eq!(asked.rpm, 1525.0);
    }
}
