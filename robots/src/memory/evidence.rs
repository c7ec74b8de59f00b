//! Summarises the last detection points that a declaration rests on.

use crate::handoff::{Evidence, Lcdp};
use nalgebra::Vector2;

impl Evidence {
    /// The evidence of these points.
    ///
    /// # Panics
    /// If there is no point.
    pub fn from_points<'a>(points: impl IntoIterator<Item = &'a Lcdp>) -> Self {
        let all: Vec<&Lcdp> = points.into_iter().collect();
        assert!(!all.is_empty(), "a declaration rests on no point: its rule must need at least one");
        let middle = all.iter().map(|p| p.position).sum::<Vector2<f64>>() / all.len() as f64;
        let reach = |m: f64, p: &&Lcdp| m.max((p.position - middle).norm());
        Self {
            points: all.len() as u32,
            since_s: all.iter().fold(f64::INFINITY, |t, p| t.min(p.t_s)),
            middle_m: middle.into(),
            reach_m: all.iter().fold(0.0, reach),
        }
    }
}
