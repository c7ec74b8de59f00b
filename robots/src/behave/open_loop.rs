//! Drives the actuators from a time table. Each row holds until the next one, the last row until the end.
//!
//! *Source*: open-loop vehicle trials (Prestero 2001, chapter 6).
//!
//! *Parameters*: rows of time, `t_s`, s from the first tick; rudder, `rudder_deg`, °, positive to starboard; stern
//! plane, `stern_deg`, °, positive nose down; propeller, `rpm`; the end, `end_s`, s.
//!
//! *Deviations*: before the first row all actuators are at zero.

use super::{Behave, Stride};
use crate::error::{RobotError, require};
use crate::handoff::{Manoeuvre, Observation};
use crate::memory::PlumeMemory;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::{Finite, NonNegative, Positive};
use world::seeds::Stream;

/// A row of the table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeTableRow {
    /// From this time on, s.
    pub t_s: NonNegative,
    /// Rudder, °, positive to starboard.
    #[serde(default = "zero", with = "world::limits::fin_deg::<Finite>")]
    pub rudder_deg: Finite,
    /// Stern plane, °, positive nose down.
    #[serde(default = "zero", with = "world::limits::fin_deg::<Finite>")]
    pub stern_deg: Finite,
    /// Propeller, rpm.
    #[serde(with = "world::limits::rpm")]
    pub rpm: Finite,
}

fn zero() -> Finite {
    Finite::new(0.0)
}

/// The table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TimeTableParams {
    /// Rows in order of time.
    pub table: Vec<TimeTableRow>,
    /// The mission is completed at this time, s.
    pub end_s: Positive,
}

/// State of a pass through the table.
#[derive(Clone, Debug)]
pub struct TimeTable {
    params: TimeTableParams,
    began_s: f64,
    /// Rows that have begun; `None` before the first tick.
    row: Option<usize>,
}

impl TimeTable {
    /// # Errors
    /// [`RobotError::Invalid`] if the times of the rows do not grow or reach past the end.
    pub fn new(params: &TimeTableParams) -> Result<Self, RobotError> {
        let must = |holds: bool, problem: String| require(holds, "strategy.OpenLoop.table", problem);
        must(!params.table.is_empty(), "is empty; give at least one row".into())?;
        for pair in params.table.windows(2) {
            let (a, b) = (pair[0].t_s.get(), pair[1].t_s.get());
            must(b > a, format!("t_s must grow from row to row, got {b} after {a}"))?;
        }
        let last = params.table.last().map_or(0.0, |row| row.t_s.get());
        must(
            last < params.end_s.get(),
            format!("the last row begins at {last} s, not before end_s = {}", params.end_s.get()),
        )?;
        Ok(Self { params: params.clone(), began_s: 0.0, row: None })
    }
}

impl Behave for TimeTable {
    fn enter(&mut self, seen: &Observation, _: &PlumeMemory) {
        self.began_s = seen.t_s;
        self.row = None;
    }

    fn step(&mut self, seen: &Observation, _: bool, _: &mut PlumeMemory, _: &mut Stream) -> Stride {
        // A nanosecond of tolerance: the clock is a sum of steps, and the table is written in decimals.
        let t_s = seen.t_s - self.began_s + 1e-9;
        if t_s >= self.params.end_s.get() {
            return Stride::Over;
        }
        let begun = self.params.table.iter().take_while(|r| r.t_s.get() <= t_s).count();
        if self.row == Some(begun) {
            return Stride::Keep;
        }
        self.row = Some(begun);
        let row = begun.checked_sub(1).map(|i| &self.params.table[i]);
        Stride::Start(Manoeuvre::Direct {
            rudder_rad: row.map_or(0.0, |r| r.rudder_deg.get().to_radians()),
            stern_rad: row.map_or(0.0, |r| r.stern_deg.get().to_radians()),
            rpm: row.map_or(0.0, |r| r.rpm.get()),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_must_grow_and_end_before_the_end() {
        let row = |t_s| TimeTableRow { t_s: NonNegative::new(t_s), rudder_deg: zero(), stern_deg: zero(), rpm: zero() };
        for (times, legal) in [(&[][..], false), (&[2.0, 2.0], false), (&[5.0], false), (&[0.0, 4.0], true)] {
            let table = times.iter().copied().map(row).collect();
            let built = TimeTable::new(&TimeTableParams { table, end_s: Positive::new(5.0) });
            assert_eq!(built.is_ok(), legal, "{times:?}");
        }
    }
}
