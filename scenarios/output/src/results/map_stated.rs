//! How sure a robot's map was when the robot declared, and whether that was true: one statement a run.
//!
//! A map that states probability p should be right in a share p of runs (calibration, Murphy & Winkler 1977, Applied
//! Statistics 26, 41). A run counts once, because the maps of one run are not independent.

use super::{Position, SourceTruth};
use robots::handoff::Belief;
use serde::Serialize;

/// The distance round the best cell whose probability is stated besides that of the cell itself, m.
pub const NEAR_M: f64 = 5.0;

/// What a map stated at one time, and whether it was true.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MapStated {
    /// Time of the map, s.
    pub t_s: f64,
    /// Whether that is when the robot first declared; otherwise it is the end of a run without a declaration.
    pub at_declaration: bool,
    /// Centre of the most probable cell.
    pub best: Position,
    /// Stated probability of that cell.
    pub cell_p: f64,
    /// Stated probability of a source within 5 m of its centre (horizontally). Within a cell it is spread evenly.
    pub near_p: f64,
    /// Whether that cell holds a true source; `None` in a scenario without one.
    pub cell_true: Option<bool>,
    /// Whether a true source is within 5 m of its centre (horizontally).
    pub near_true: Option<bool>,
}

impl MapStated {
    /// From a map and the true sources.
    pub fn from_belief(map: &Belief, at_declaration: bool, sources: &[SourceTruth]) -> Self {
        let best = map.grid.centre(map.best).xy();
        let any = |yes: &dyn Fn(&SourceTruth) -> bool| (!sources.is_empty()).then(|| sources.iter().any(yes));
        Self {
            t_s: map.t_s,
            at_declaration,
            best: best.into(),
            cell_p: map.p[map.best],
            near_p: map.within(best, NEAR_M),
            cell_true: any(&|s| map.grid.cell(&s.position) == Some(map.best)),
            near_true: any(&|s| (s.position.xy() - best).norm() <= NEAR_M),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::{belief, source};
    use nalgebra::{Vector2, Vector3};
    use robots::handoff::BeliefGrid;
    use std::sync::Arc;
    use world::area::Area;
    use world::units::Heading;

    /// Cells of 2.5 by 4 m, two layers, with probability 1/2 in each layer of one column.
    fn column() -> Belief {
        let area =
            Area { centre: Vector2::new(50.0, 50.0), length_m: 100.0, width_m: 100.0, axis: Heading::from_deg(90.0) };
        let grid = BeliefGrid::over(&area, 0.0, 10.0, [40, 25, 2]);
        let best = grid.index([8, 12, 0]);
        let mut p = vec![0.0; grid.len()];
        p[best] = 0.5;
        p[grid.index([8, 12, 1])] = 0.5;
        Belief { best, p: Arc::new(p), grid: Arc::new(grid), ..belief(50.0) }
    }

    fn at(p: Vector3<f64>) -> SourceTruth {
        SourceTruth { position: p, ..source() }
    }

    #[test]
    fn the_cell_is_one_of_space_and_the_distance_one_of_the_plane() {
        let map = column();
        let middle = map.grid.centre(map.best);
        let said = MapStated::from_belief(&map, true, &[at(middle)]);
        assert_eq!((said.cell_p, said.near_p), (0.5, 1.0));
        assert_eq!((said.cell_true, said.near_true), (Some(true), Some(true)));
        let above = MapStated::from_belief(&map, true, &[at(middle + Vector3::new(0.0, 0.0, 5.0))]);
        assert_eq!((above.cell_true, above.near_true), (Some(false), Some(true)));
        let beside = [4.9, 5.1].map(|m| {
            let said = MapStated::from_belief(&map, true, &[at(middle + Vector3::new(m, 0.0, 0.0))]);
            (said.cell_true, said.near_true)
        });
        let no = Some(false);
        assert_eq!(beside, [(no, Some(true)), (no, no)]);
        let none = MapStated::from_belief(&map, false, &[]);
        assert_eq!((none.cell_true, none.near_true), (None, None));
    }

    #[test]
    fn an_even_map_has_the_discs_share_of_its_area() {
        let mut map = column();
        map.p = Arc::new(vec![1.0 / map.p.len() as f64; map.p.len()]);
        let said = MapStated::from_belief(&map, true, &[]);
        // A disc of 25π m² in 10⁴ m²; a part of a cell is 0.16 m², and some 60 of them lie on its edge.
        let disc = 25.0 * std::f64::consts::PI / 1e4;
        assert!((said.near_p / disc - 1.0).abs() < 0.02, "{}", said.near_p);
    }
}
