//! How long the rows of an experiment still take, from the wall times of the runs that have ended.

use crate::campaign::RunRow;
use std::num::NonZero;
use std::sync::{Mutex, PoisonError};
use world::cost::duration;

/// What is known of a row.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct RowProgress {
    /// Runs planned and runs ended.
    planned: u64,
    ended: u64,
    /// Wall time of those that have ended, s.
    wall_s: f64,
}

impl RowProgress {
    /// Wall time of the runs that have not ended, s; `None` before the first has.
    fn left_s(self) -> Option<f64> {
        let left = self.planned.saturating_sub(self.ended);
        match (left, self.ended) {
            (0, _) => Some(0.0),
            (_, 0) => None,
            (left, ended) => Some(left as f64 * self.wall_s / ended as f64),
        }
    }
}

/// The clock of an experiment with several rows; runs are heard from all threads.
#[derive(Debug)]
pub struct TimeLeft {
    rows: Mutex<Vec<RowProgress>>,
    threads: usize,
}

impl TimeLeft {
    /// For rows of so many planned runs; `jobs` as on the command line, 0 means one for each core.
    pub fn new(planned: impl Iterator<Item = u64>, jobs: usize) -> Self {
        let cores = || std::thread::available_parallelism().map_or(1, NonZero::get);
        let of_row = |planned| RowProgress { planned, ..RowProgress::default() };
        Self { rows: Mutex::new(planned.map(of_row).collect()), threads: if jobs == 0 { cores() } else { jobs } }
    }

    /// Runs at the same time.
    pub fn threads(&self) -> u64 {
        self.threads as u64
    }

    /// Notes a run of row `k` that has ended, and how many the row is now planned to have.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn heard(&self, k: usize, run: &RunRow, planned: u64) {
        let mut rows = self.rows.lock().unwrap_or_else(PoisonError::into_inner);
        rows[k].planned = planned;
        rows[k].ended += 1;
        rows[k].wall_s += run.spin_up_wall_s + run.mission_wall_s;
    }

    /// Time until all rows are done, in words; `None` as long as a row has not been measured.
    pub fn describe(&self) -> Option<String> {
        let rows = self.rows.lock().unwrap_or_else(PoisonError::into_inner);
        let left: Option<Vec<f64>> = rows.iter().map(|r| r.left_s()).collect();
        Some(duration(left?.iter().sum::<f64>() / self.threads as f64))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_left_follows_from_the_runs_of_each_row() {
        let left = TimeLeft::new([4, 10].into_iter(), 2);
        let run = |spin_up_wall_s, mission_wall_s| RunRow { spin_up_wall_s, mission_wall_s, ..RunRow::default() };
        left.heard(0, &run(1.0, 3.0), 4);
        assert_eq!(left.describe(), None);
        // Three of 4 s and nine of 20 s, two at a time.
        left.heard(1, &run(0.0, 20.0), 10);
        assert_eq!(left.describe().as_deref(), Some("96 s"));
        // A row that is done leaves nothing; one that is to have fewer runs leaves less.
        for _ in 0..3 {
            left.heard(0, &run(0.0, 4.0), 4);
        }
        left.heard(1, &run(0.0, 40.0), 3);
        assert_eq!(left.describe().as_deref(), Some("15 s"));
    }
}
