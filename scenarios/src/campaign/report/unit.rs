//! Numbers with their units, for people.

use crate::campaign::stats::Interval;

/// Unit of a quantity.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// From 0 to 1.
    Share,
    /// m.
    Metres,
    /// s.
    Seconds,
}

impl Unit {
    /// A value for people.
    #[must_use]
    pub fn show(self, value: f64) -> String {
        match self {
            Unit::Share => format!("{:.1} %", 100.0 * value),
            Unit::Metres if value.abs() < 99.95 => format!("{value:.1} m"),
            Unit::Metres => format!("{value:.0} m"),
            Unit::Seconds => format!("{value:.0} s"),
        }
    }

    /// An interval for people.
    #[must_use]
    pub fn show_interval(self, i: Interval) -> String {
        let bare = |v| {
            self.show(v)
                .split(' ')
                .next()
                .unwrap_or_default()
                .to_string()
        };
        format!("{} to {}", bare(i.low), self.show(i.high))
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
    }
}
