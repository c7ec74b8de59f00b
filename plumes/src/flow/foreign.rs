//! Currents of other crates, of which the water knows values only.

use nalgebra::Vector2;
use std::sync::Arc;
use world::limits::range::stream_m_s;

use crate::flow::number::Number;

/// A current that is the same at all depths and known at all times; [`Water::add`](crate::flow::Water::add) takes one in.
pub trait PlaneCurrent: std::fmt::Debug + Send + Sync {
    /// (east, north) at (east, north) `p` at time `t_s`, m/s.
    fn velocity(&self, p: Vector2<f64>, t_s: f64) -> Vector2<f64>;

    /// Whether it never changes.
    fn is_steady(&self) -> bool {
        false
    }
}

/// Such a current, with its name in scenarios.
#[derive(Clone, Debug)]
pub(super) struct ForeignCurrent {
    pub(super) name: &'static str,
    pub(super) current: Arc<dyn PlaneCurrent>,
}

impl ForeignCurrent {
    /// What is wrong with it at a place and a time.
    pub(super) fn fault(&self, p: Vector2<f64>, t_s: f64) -> Option<String> {
        let (most, v) = (stream_m_s.1, self.current.velocity(p, t_s));
        // This form also refuses what is not a number.
        let wrong = !v.iter().all(|v| v.abs() <= most);
        wrong.then(|| {
            format!(
                "the current {} flows at ({}, {}) m/s at east {} m, north {} m, {t_s} s: both must be within ±{most}; \
                 correct the current",
                self.name, v.x, v.y, p.x, p.y
            )
        })
    }

    /// Its velocity in numbers that may ask for its slopes, m/s.
    ///
    /// # Panics
    /// If it flows faster than water does. A plume in such water would take steps without end.
    pub(super) fn velocity<N: Number>(&self, p: Vector2<N>, t_s: N) -> Vector2<N> {
        /// Small compared with a current's scales, large compared with rounding at places of 10³ m; m and s.
        const H: f64 = 1e-3;
        let (place, now_s) = (Vector2::new(p.x.value(), p.y.value()), t_s.value());
        let fault = self.fault(place, now_s);
        assert!(fault.is_none(), "{}", fault.unwrap_or_default());
        let here = self.current.velocity(place, now_s);
        let part = |d: usize| {
            N::known(here[d], [p.x, p.y, t_s], || {
                let at = |dx: f64, dy: f64, dt: f64| self.current.velocity(place + Vector2::new(dx, dy), now_s + dt)[d];
                let back = H.min(now_s);
                [
                    (at(H, 0.0, 0.0) - at(-H, 0.0, 0.0)) / (2.0 * H),
                    (at(0.0, H, 0.0) - at(0.0, -H, 0.0)) / (2.0 * H),
                    (at(0.0, 0.0, H) - at(0.0, 0.0, -back)) / (H + back),
                ]
            })
        };
        Vector2::new(part(0), part(1))
    }
}
