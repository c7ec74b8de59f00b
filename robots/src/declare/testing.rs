//! A belief and last detection points written by hand, for tests.

use crate::handoff::{Belief, BeliefGrid, Lcdp};
use nalgebra::{Vector2, Vector3};
use std::sync::Arc;

/// Six cells of 5 m; one of them has most of the probability.
pub(crate) fn belief(best: usize, informed: bool, credible_95: f64) -> Belief {
    let mut p = vec![0.1; 6];
    p[best] = 0.5;
    Belief {
        t_s: 0.0,
        updates: 1,
        informed,
        grid: Arc::new(BeliefGrid {
            corner: Vector3::new(-7.5, -5.0, -8.0),
            axes: [Vector2::x(), Vector2::y()],
            cell_m: [5.0, 5.0, 8.0],
            n: [3, 2, 1],
        }),
        p: Arc::new(p),
        best,
        entropy_nat: 1.5,
        credible_95,
        odour: None,
    }
}

/// Last detection points (east, north), m, a second apart.
pub(crate) fn list(places: &[(f64, f64)]) -> Vec<Lcdp> {
    let point = |(k, (east, north)): (usize, &(f64, f64))| Lcdp::new_at(k as f64, Vector2::new(*east, *north));
    places.iter().enumerate().map(point).collect()
}
