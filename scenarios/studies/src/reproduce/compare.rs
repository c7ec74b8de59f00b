//! One figure of ours, compared with the paper's.

use super::quantity::Estimate;
use super::row::{Figure, Paper, Row};
use crate::campaign::RunRow;
use crate::campaign::stats::{Interval, wilson};

/// How the paper's figure compares with ours.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// The paper has no such figure, or we have none.
    None,
    /// Inside our 95 % interval.
    Inside,
    /// Outside, but the paper's own interval (from its counts) overlaps ours.
    Meets,
    /// Outside the interval of our median, but within 95 % of our single runs: the paper's is a single run.
    AmongRuns,
    /// Outside.
    Outside,
}

impl Standing {
    /// In words.
    pub fn label(self) -> &'static str {
        match self {
            Standing::None => "-",
            Standing::Inside => "inside",
            Standing::Meets => "outside; the intervals meet",
            Standing::AmongRuns => "outside; among our single runs",
            Standing::Outside => "outside",
        }
    }
}

/// A figure of ours and of the paper.
#[derive(Clone, Debug)]
pub struct FigureComparison {
    /// The figure.
    pub figure: Figure,
    /// Our value.
    pub ours: Estimate,
    /// Wilson's interval of the paper's counts.
    pub papers_interval: Option<Interval>,
    /// How the paper's value compares.
    pub standing: Standing,
}

/// All figures of a row, from our runs of all its arms.
pub fn compare(row: &Row, runs: &[RunRow]) -> Vec<FigureComparison> {
    let ours = |f: &Figure| {
        let asked = |r: &&RunRow| {
            f.arm.as_ref().is_none_or(|arm| r.arm == *arm)
                && f.among.is_none_or(|event| event.happened(r) == Some(true))
        };
        let of: Vec<RunRow> = runs.iter().filter(asked).cloned().collect();
        f.quantity.estimate(&of)
    };
    row.figures.iter().map(|f| one(f, ours(f))).collect()
}

fn one(figure: &Figure, ours: Estimate) -> FigureComparison {
    let papers_interval = match figure.paper {
        Some(Paper::Count(k, n) | Paper::RunCount(k, n)) => Some(wilson(k, n)),
        _ => None,
    };
    let standing = match (figure.paper, ours.interval) {
        (Some(paper), Some(interval)) => {
            let value = paper.value();
            let single = matches!(paper, Paper::Run(_));
            let enough = matches!(paper, Paper::AtLeast(..)) && interval.high >= value;
            if interval.contains(value) || enough {
                Standing::Inside
            } else if papers_interval.is_some_and(|p| p.low <= interval.high && interval.low <= p.high) {
                Standing::Meets
            } else if single && ours.spread.is_some_and(|s| s.contains(value)) {
                Standing::AmongRuns
            } else {
                Standing::Outside
            }
        }
        _ => Standing::None,
    };
    FigureComparison { figure: figure.clone(), ours, papers_interval, standing }
}

#[cfg(test)]
mod tests {
    use super::super::{Measure, Quantity};
    use super::*;

    fn standing(paper: Option<Paper>, interval: Option<[f64; 2]>, spread: [f64; 2]) -> Standing {
        let of = |[low, high]: [f64; 2]| Interval { low, high };
        let figure = Figure {
            name: "f".into(),
            arm: None,
            among: None,
            quantity: Quantity::Median(Measure::ErrorM),
            paper,
            note: String::new(),
        };
        let ours = Estimate {
            n: 20,
            count: None,
            value: interval.map(|i| i[0]),
            interval: interval.map(of),
            spread: Some(of(spread)),
        };
        one(&figure, ours).standing
    }

    #[test]
    fn says_where_the_papers_figure_stands() {
        let (i, s) = (Some([5.0, 9.0]), [1.0, 30.0]);
        assert_eq!(standing(Some(Paper::Run(7.0)), i, s), Standing::Inside);
        assert_eq!(standing(Some(Paper::Run(13.0)), i, s), Standing::AmongRuns);
        assert_eq!(standing(Some(Paper::Run(31.0)), i, s), Standing::Outside);
        // A figure over many runs is not excused by the spread of single runs.
        assert_eq!(standing(Some(Paper::Value(13.0)), i, s), Standing::Outside);
        assert_eq!(standing(None, i, s), Standing::None);
        assert_eq!(standing(Some(Paper::AtLeast(4.0, 17)), i, s), Standing::Inside);
        assert_eq!(standing(Some(Paper::AtLeast(9.5, 17)), i, s), Standing::Outside);
        assert_eq!(standing(Some(Paper::Run(7.0)), None, s), Standing::None);
        // 7 of 8 is 53 to 98 %.
        let count = Some(Paper::Count(7, 8));
        assert_eq!(standing(count, Some([0.8, 0.9]), s), Standing::Inside);
        assert_eq!(standing(count, Some([0.95, 1.0]), s), Standing::Meets);
        assert_eq!(standing(count, Some([0.1, 0.3]), s), Standing::Outside);
    }
}
