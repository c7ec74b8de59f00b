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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn evidence_holds_the_mean_the_farthest_and_the_oldest_point() {
        let at = |t_s: f64, east: f64| Lcdp::new_at(t_s, Vector2::new(east, 3.0));
        let evidence = Evidence::from_points(&[at(9.0, 0.0), at(4.0, 2.0), at(7.0, 7.0)]);
        let expected = Evidence { points: 3, since_s: 4.0, middle_m: [3.0, 3.0], reach_m: 4.0 };
        assert_eq!(evidence, expected);
    }
}
