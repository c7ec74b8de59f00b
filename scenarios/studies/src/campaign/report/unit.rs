//! Numbers with their units, for people.

use crate::campaign::stats::Interval;

/// Unit of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// A share from 0 to 1.
    Share,
    /// Metres.
    Metres,
    /// Seconds.
    Seconds,
    /// Metres per second.
    Speed,
    /// Without a unit.
    Number,
}

impl Unit {
    /// A value in words.
    #[must_use]
    pub fn show(self, value: f64) -> String {
        match self {
            Unit::Share => format!("{:.1} %", 100.0 * value),
            Unit::Metres if value.abs() < 0.9995 => format!("{:.1} cm", 100.0 * value),
            Unit::Metres if value.abs() < 99.95 => format!("{value:.1} m"),
            Unit::Metres => format!("{value:.0} m"),
            Unit::Seconds if value.abs() < 99.95 => format!("{value:.1} s"),
            Unit::Seconds => format!("{value:.0} s"),
            Unit::Speed if value.abs() < 0.9995 => format!("{:.2} cm/s", 100.0 * value),
            Unit::Speed => format!("{value:.2} m/s"),
            Unit::Number => format!("{value:.3}"),
        }
    }

    /// An interval in words.
    #[must_use]
    pub fn show_interval(self, i: Interval) -> String {
        let (low, high) = (self.show(i.low), self.show(i.high));
        // The unit once, if both ends have the same.
        match (low.split_once(' '), high.split_once(' ')) {
            (Some((bare, unit)), Some((_, other))) if unit == other => format!("{bare} to {high}"),
            _ => format!("{low} to {high}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_read_well() {
        assert_eq!(Unit::Share.show(0.875), "87.5 %");
        assert_eq!(Unit::Metres.show(12.34), "12.3 m");
        let i = Interval {
            low: 900.4,
            high: 1001.0,
        };
        assert_eq!(Unit::Metres.show_interval(i), "900 to 1001 m");
        assert_eq!(Unit::Metres.show(0.143), "14.3 cm");
        let i = Interval {
            low: 0.5,
            high: 1.5,
        };
        assert_eq!(Unit::Metres.show_interval(i), "50.0 cm to 1.5 m");
        assert_eq!(Unit::Speed.show(0.0305), "3.05 cm/s");
    }
}
