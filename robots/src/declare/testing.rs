//! Beliefs, last detection points and rules for tests.

use super::{SizF, SizT, ZoneSize};
use crate::handoff::testing::sure_of;
use crate::handoff::{Belief, BeliefGrid, Lcdp};
use nalgebra::{Vector2, Vector3};
use std::num::NonZeroUsize;
use world::ranges::Positive;

pub(super) fn v(east: f64, north: f64) -> Vector2<f64> {
    Vector2::new(east, north)
}

/// Six cells of 5 m; one of them has so much of the probability.
pub(super) fn likely(best: usize, p: f64) -> Belief {
    let (corner, axes) = (Vector3::new(-7.5, -5.0, -8.0), [Vector2::x(), Vector2::y()]);
    sure_of(BeliefGrid { corner, axes, cell_m: [5.0, 5.0, 8.0], n: [3, 2, 1] }, best, p)
}

/// The same with half of it.
pub(super) fn belief(best: usize, informed: bool, credible_95: f64) -> Belief {
    Belief { informed, credible_95, ..likely(best, 0.5) }
}

/// Last detection points (east, north), m, a second apart.
pub(super) fn list(places: &[(f64, f64)]) -> Vec<Lcdp> {
    let point = |(k, (east, north)): (usize, &(f64, f64))| Lcdp::new_at(k as f64, v(*east, *north));
    places.iter().enumerate().map(point).collect()
}

pub(super) fn n(points: usize) -> NonZeroUsize {
    NonZeroUsize::new(points).expect("some points")
}

pub(super) fn siz_t(eps_m: f64, points: usize) -> SizT {
    SizT { size: ZoneSize::Fixed(Positive::new(eps_m)), points: n(points), ..SizT::default() }
}

pub(super) fn siz_f(eps_m: f64, points: usize) -> SizF {
    SizF { size: ZoneSize::Fixed(Positive::new(eps_m)), points: n(points), ..SizF::default() }
}
