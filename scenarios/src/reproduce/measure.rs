//! What a run has to say for itself: events and measures, by the names row files use.

use crate::campaign::RunRow;
use crate::campaign::report::Unit;
use serde::{Deserialize, Serialize};

/// Something that happened in a run, or not.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Event {
    /// It succeeded as the scenario defines it.
    Success,
    /// A source was declared, wherever.
    Declared,
    /// Of the runs that declared: the error is more along the flow than across.
    MostlyAlong,
    /// The belief's best cell came to be the source's, and stayed to the end.
    CorrectCell,
}

impl Event {
    /// Whether it happened; none where the run cannot say.
    #[must_use]
    pub fn of(self, r: &RunRow) -> Option<bool> {
        match self {
            Event::Success => Some(r.success),
            Event::Declared => Some(r.declared_s.is_some()),
            Event::MostlyAlong => {
                (r.error_along_m.zip(r.error_across_m)).map(|(a, b)| a.abs() > b.abs())
            }
            Event::CorrectCell => Some(r.correct_cell_s.is_some()),
        }
    }
}

/// A number of a run. Errors are of declarations, against the nearest true source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Error, m.
    ErrorM,
    /// Size of the error along the flow, m.
    ErrorAlongM,
    /// Size of the error across the flow, m.
    ErrorAcrossM,
    /// Way from the first detection to the declared source, m.
    TracedM,
    /// Time of the declaration, s.
    DeclaredS,
    /// Time from the oldest last detection point that a declaration rests on to the declaration, s.
    IdentificationS,
    /// That time over the intervals between those points, s.
    LcdpIntervalS,
    /// Way travelled, m, in runs that did not fail.
    TravelledM,
    /// Time from the end of a gantry's sweep to its stop, s.
    TrackedS,
    /// A gantry's speed along its path from the end of the sweep to its stop, m/s.
    SpeedMS,
    /// A gantry's net-to-gross displacement ratio from the end of the sweep to its stop.
    Ngdr,
    /// The same speed in the half of the way nearer to the source less that in the farther half, m/s.
    NearGainMS,
    /// Mean distance from the source's line along the flow in the farther half less that in the nearer, m.
    OffsetGainM,
    /// Time at which the belief's best cell came to be the source's for good, s.
    CorrectCellS,
}

impl Measure {
    /// Its unit.
    #[must_use]
    pub fn unit(self) -> Unit {
        match self {
            Measure::DeclaredS
            | Measure::IdentificationS
            | Measure::LcdpIntervalS
            | Measure::TrackedS
            | Measure::CorrectCellS => Unit::Seconds,
            Measure::SpeedMS | Measure::NearGainMS => Unit::Speed,
            Measure::Ngdr => Unit::Number,
            _ => Unit::Metres,
        }
    }

    /// Of a run; none where it has none.
    #[must_use]
    pub fn of(self, r: &RunRow) -> Option<f64> {
        let less = |a: Option<f64>, b: Option<f64>| a.zip(b).map(|(a, b)| a - b);
        match self {
            Measure::ErrorM => r.error_m,
            Measure::ErrorAlongM => r.error_along_m.map(f64::abs),
            Measure::ErrorAcrossM => r.error_across_m.map(f64::abs),
            Measure::TracedM => r.traced_m,
            Measure::DeclaredS => r.declared_s,
            Measure::IdentificationS => less(r.declared_s, r.zone_since_s),
            Measure::LcdpIntervalS => (less(r.declared_s, r.zone_since_s).zip(r.zone_points))
                .and_then(|(s, n)| (n > 1.0).then(|| s / (n - 1.0))),
            Measure::TravelledM => r.error.is_none().then_some(r.travelled_m),
            Measure::TrackedS => less(r.declared_s, r.sweep_s),
            Measure::SpeedMS => r.speed_m_s,
            Measure::Ngdr => r.ngdr,
            Measure::NearGainMS => less(r.near_speed_m_s, r.far_speed_m_s),
            Measure::OffsetGainM => less(r.far_offset_m, r.near_offset_m),
            Measure::CorrectCellS => r.correct_cell_s,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::campaign::report::sample::row;

    #[test]
    fn identification_counts_from_the_zones_oldest_point() {
        let found = RunRow {
            declared_s: Some(900.0),
            zone_points: Some(6.0),
            zone_since_s: Some(400.0),
            ..row(0, Some((1.0, 1.0)))
        };
        assert_eq!(Measure::IdentificationS.of(&found), Some(500.0));
        // Six points, five intervals.
        assert_eq!(Measure::LcdpIntervalS.of(&found), Some(100.0));
        // One point has none; a rule on other things has no points; nothing declared, nothing measured.
        let one = RunRow {
            zone_points: Some(1.0),
            ..found
        };
        assert_eq!(Measure::LcdpIntervalS.of(&one), None);
        for other in [row(0, Some((1.0, 1.0))), row(1, None)] {
            assert_eq!(Measure::IdentificationS.of(&other), None);
            assert_eq!(Measure::LcdpIntervalS.of(&other), None);
        }
    }
}
