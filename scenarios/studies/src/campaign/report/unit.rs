//! Numbers with their units, for people: one unit for all values of a column.

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
    /// The scale in which some values are shown together: their largest decides.
    pub fn scale(self, values: impl IntoIterator<Item = f64>) -> Scale {
        let sizes = values.into_iter().map(f64::abs);
        let sizes = sizes.filter(|v| v.is_finite() && *v > 0.0);
        let (least, most) = sizes.fold((f64::INFINITY, 0.0f64), |(low, high), v| (low.min(v), high.max(v)));
        let scale = |factor, name, decimals| Scale { factor, name, decimals };
        // Three digits of the largest, and one more if the least has no two.
        let finer = |decimals: usize| decimals + usize::from(least * 10f64.powi(decimals as i32) < 9.5);
        match self {
            Unit::Share => scale(100.0, "%", 1),
            Unit::Metres if most < 0.9995 => scale(100.0, "cm", 1),
            Unit::Metres if most < 9.995 => scale(1.0, "m", 2),
            Unit::Metres if most < 99.95 => scale(1.0, "m", finer(1)),
            Unit::Metres => scale(1.0, "m", finer(0)),
            Unit::Seconds if most < 99.95 => scale(1.0, "s", 1),
            Unit::Seconds => scale(1.0, "s", finer(0)),
            Unit::Speed if most < 0.9995 => scale(100.0, "cm/s", 2),
            Unit::Speed => scale(1.0, "m/s", 2),
            Unit::Number => scale(1.0, "", 3),
        }
    }
}

/// How the values of a column are shown: a unit and a number of decimals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    factor: f64,
    name: &'static str,
    decimals: usize,
}

impl Scale {
    /// A value without its unit.
    pub fn number(&self, value: f64) -> String {
        let text = format!("{:.*}", self.decimals, self.factor * value);
        match text.strip_prefix('-') {
            // What rounds to zero has no sign.
            Some(bare) if bare.bytes().all(|b| b == b'0' || b == b'.') => bare.to_string(),
            _ => text,
        }
    }

    /// A value with its unit.
    pub fn show(&self, value: f64) -> String {
        format!("{} {}", self.number(value), self.name).trim_end().to_string()
    }

    /// An interval without its unit.
    pub fn numbers(&self, i: Interval) -> String {
        format!("{} to {}", self.number(i.low), self.number(i.high))
    }

    /// An interval with its unit.
    pub fn show_interval(&self, i: Interval) -> String {
        format!("{} to {}", self.number(i.low), self.show(i.high))
    }

    /// The head of a column: what it is, and its unit.
    pub fn head(&self, what: &str) -> String {
        match self.name {
            "" => what.to_string(),
            unit => format!("{what}, {unit}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_read_well() {
        let alone = |unit: Unit, v: f64| unit.scale([v]).show(v);
        assert_eq!(alone(Unit::Share, 0.875), "87.5 %");
        assert_eq!(alone(Unit::Metres, 12.34), "12.3 m");
        assert_eq!(alone(Unit::Metres, 0.143), "14.3 cm");
        assert_eq!(alone(Unit::Seconds, 1234.5), "1234 s");
        assert_eq!(alone(Unit::Speed, 0.0305), "3.05 cm/s");
        assert_eq!(alone(Unit::Number, 2.0), "2.000");
    }

    /// Values that are compared have one unit, which the largest of them needs.
    #[test]
    fn what_stands_in_one_column_has_one_unit() {
        let both = |low, high| {
            let scale = Unit::Metres.scale([low, high]);
            (scale.head("error"), scale.numbers(Interval { low, high }), scale.show_interval(Interval { low, high }))
        };
        let said = |head: &str, bare: &str, whole: &str| (head.to_string(), bare.to_string(), whole.to_string());
        assert_eq!(both(-0.972, 1.1), said("error, m", "-0.97 to 1.10", "-0.97 to 1.10 m"));
        assert_eq!(both(0.5, 0.6), said("error, cm", "50.0 to 60.0", "50.0 to 60.0 cm"));
        assert_eq!(both(900.4, 1001.0), said("error, m", "900 to 1001", "900 to 1001 m"));
        assert_eq!(both(-0.001, 150.0), said("error, m", "0.0 to 150.0", "0.0 to 150.0 m"));
        assert_eq!(Unit::Number.scale([f64::NAN]).head("n"), "n");
    }
}
