//! The final state of a robot's source map, compared with the truth and with the robot's declaration: a map may be
//! certain of a wrong cell.

use super::{Position, SourceTruth};
use nalgebra::Vector2;
use robots::handoff::{Belief, Declaration, Verdict};
use serde::Serialize;
use std::fmt::Write as _;

/// A map is certain of a cell from this probability on.
const SURE: f64 = 0.9;
/// Two places count as different if their distance is at least this many cells.
const CELLS_OFF: f64 = 3.0;

/// The end of a robot's map.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MapEnd {
    /// Centre of the most probable cell.
    pub best: Position,
    /// Its probability.
    pub probability: f64,
    /// Horizontal distance to the nearest true source, m; `None` in a scenario without one.
    pub off_m: Option<f64>,
    /// The same distance in cells, along the axis on which there are more.
    pub off_cells: Option<f64>,
    /// Horizontal distance to the nearest standing declaration of a source, m; `None` without one.
    pub from_declared_m: Option<f64>,
    /// A remark if the map is certain of a cell that is many cells from the source or from the declaration.
    pub remark: Option<String>,
}

impl MapEnd {
    /// From the last map (only it knows its cells), the robot's declarations and the true sources.
    pub fn from_belief(last: &Belief, declarations: &[Declaration], sources: &[SourceTruth]) -> Self {
        let (grid, probability) = (&last.grid, last.p[last.best]);
        let best = grid.centre(last.best).xy();
        let cells = |p: Vector2<f64>| {
            let along = |a: usize| ((p - best).dot(&grid.axes[a]) / grid.cell_m[a]).abs();
            along(0).max(along(1))
        };
        let nearest = |places: &mut dyn Iterator<Item = Vector2<f64>>| {
            places.min_by(|a, b| (a - best).norm().total_cmp(&(b - best).norm()))
        };
        let source = nearest(&mut sources.iter().map(|s| s.position.xy()));
        let stands = |d: &&Declaration| d.verdict != Verdict::Rejected && !d.at_edge();
        let declared = nearest(&mut declarations.iter().filter(stands).map(|d| d.position));
        let off = |p: Option<Vector2<f64>>| p.map(|p| (p - best).norm());
        let elsewhere = |p: Option<Vector2<f64>>| off(p).filter(|_| p.is_some_and(|p| cells(p) >= CELLS_OFF));
        let mut remark = format!("the map is sure ({probability:.3}) of a cell");
        let bare = remark.len();
        if probability >= SURE {
            if let Some(m) = elsewhere(source) {
                write!(remark, " {m:.0} m from the source").expect(TEXT);
            }
            if let Some(m) = elsewhere(declared) {
                let and = if remark.len() > bare { " and" } else { "" };
                write!(remark, "{and} {m:.0} m from what was declared").expect(TEXT);
            }
        }
        Self {
            best: best.into(),
            probability,
            off_m: off(source),
            off_cells: source.map(cells),
            from_declared_m: off(declared),
            remark: (remark.len() > bare).then_some(remark),
        }
    }
}

const TEXT: &str = "writing to a String succeeds";

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{belief, source};
    use std::sync::Arc;

    /// A map with probability `p` in the cell of a place and the rest in all others.
    fn sure_of(place: Vector2<f64>, p: f64) -> Belief {
        let mut b = belief(50.0);
        b.best = b.grid.cell(&place.push(0.0)).unwrap();
        let others = (1.0 - p) / (b.p.len() - 1) as f64;
        b.p = Arc::new((0..b.p.len()).map(|i| if i == b.best { p } else { others }).collect());
        b
    }

    fn declared(at: Vector2<f64>) -> Declaration {
        Declaration::first(1.0, at, "along_flow")
    }

    #[test]
    fn it_says_when_a_map_is_sure_of_a_wrong_cell_and_nothing_else() {
        let s = source();
        // Cells of 27 by 24 m; the place is four cells away.
        let (here, away) = (s.position.xy(), s.position.xy() + Vector2::new(60.0, -85.0));
        let end = |sure_at, p, at: Option<Vector2<f64>>| {
            let declared: Vec<_> = at.map(declared).into_iter().collect();
            MapEnd::from_belief(&sure_of(sure_at, p), &declared, std::slice::from_ref(&s))
        };
        let wrong = end(away, 0.99, Some(here));
        let m = wrong.off_m.unwrap();
        assert!(m > 80.0 && wrong.off_cells.unwrap() >= 3.0, "{wrong:?}");
        let said = wrong.remark.unwrap();
        for says in ["(0.990)", &format!("{m:.0} m from the source"), &format!("{m:.0} m from what was declared")] {
            assert!(said.contains(says), "{said}");
        }
        // Declared where the map says: only the truth disagrees.
        let said = end(away, 0.99, Some(away)).remark.unwrap();
        assert!(said.contains("from the source") && !said.contains("declared"), "{said}");
        // Of a map that is right or unsure there is nothing to say.
        assert_eq!(end(here, 0.99, Some(here)).remark, None);
        assert_eq!(end(away, 0.5, None).remark, None);
        assert_eq!(MapEnd::from_belief(&sure_of(away, 0.99), &[], &[]).off_m, None);
    }
}
