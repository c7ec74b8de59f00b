//! Curves of an arm: the share not yet declared over time, and the share of errors up to a distance.

use crate::campaign::RunRow;
use crate::campaign::stats::{Ecdf, Interval, Survival};

/// Steps of a curve that are kept; more would not be visible.
const MOST: usize = 1000;

/// From `x` on, the curve has the value `y`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Time, s, or distance, m.
    pub x: f64,
    /// Share.
    pub y: f64,
    /// Its pointwise 95 % interval.
    pub interval: Interval,
}

/// A step curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Name of the arm.
    pub arm: String,
    /// Its steps in order, at most 1000 of them, evenly selected.
    pub points: Vec<Point>,
    /// Where it ends.
    pub end: f64,
    /// Number of trials.
    pub n: u64,
}

/// Share of runs that have not yet declared, over mission time. A run that ends without declaring leaves the curve at
/// that time; failed runs are left out.
pub(super) fn not_yet_declared(arm: &str, rows: &[&RunRow]) -> Curve {
    let sound = rows.iter().filter(|r| r.error.is_none());
    let survival = Survival::new(sound.map(|r| match r.declared_s {
        Some(t) => (t, true),
        None => (r.mission_s, false),
    }));
    let points = (survival.steps.iter()).map(|s| Point { x: s.t_s, y: s.share, interval: s.interval });
    Curve { arm: arm.to_string(), points: thinned(points.collect()), end: survival.end_s, n: survival.n }
}

/// Share of all runs whose declaration is at most this far from the source.
pub(super) fn errors(arm: &str, rows: &[&RunRow]) -> Curve {
    let ecdf = Ecdf::new(rows.iter().filter_map(|r| r.error_m), rows.len() as u64);
    let (y, interval) = ecdf.share_at(-1.0);
    let mut points = vec![Point { x: 0.0, y, interval }];
    points.extend(ecdf.steps().into_iter().map(|(x, y, interval)| Point { x, y, interval }));
    Curve {
        arm: arm.to_string(),
        points: thinned(points),
        end: ecdf.values().last().copied().unwrap_or(0.0),
        n: ecdf.n(),
    }
}

/// The first, the last, and evenly selected points between.
fn thinned(points: Vec<Point>) -> Vec<Point> {
    let n = points.len();
    if n <= MOST {
        return points;
    }
    (0..MOST).map(|k| points[k * (n - 1) / (MOST - 1)]).collect()
}

#[cfg(test)]
mod tests {
    use super::super::sample::row;
    use super::*;

    #[test]
    fn long_curves_keep_their_ends() {
        let rows: Vec<RunRow> = (0..5000).map(|k| row(k, Some((k as f64, 0.0)))).collect();
        let rows: Vec<&RunRow> = rows.iter().collect();
        for curve in [not_yet_declared("a", &rows), errors("a", &rows)] {
            assert_eq!(curve.points.len(), MOST);
            assert_eq!(curve.points[0].x, 0.0);
            assert_eq!(curve.points[MOST - 1].x, curve.end);
            assert!(curve.points.windows(2).all(|w| w[0].x < w[1].x || w[1].x == 0.0));
        }
    }

    #[test]
    fn failed_runs_are_in_no_survival_curve_but_in_the_shares_of_errors() {
        let failed = RunRow { error: Some("x".into()), mission_s: 0.0, ..row(1, None) };
        let found = row(0, Some((3.0, 4.0)));
        let rows = [&found, &failed];
        assert_eq!(not_yet_declared("a", &rows).n, 1);
        let errors = errors("a", &rows);
        assert_eq!((errors.n, errors.points[1].x, errors.points[1].y), (2, 5.0, 0.5));
    }
}
