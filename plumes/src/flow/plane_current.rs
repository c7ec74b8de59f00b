//! Currents that are the same at all depths: a velocity, and its slopes where the current knows them.

pub mod meander;
pub mod tide;
pub mod uniform;

use dyn_clone::DynClone;
use nalgebra::Vector2;
use world::limits::range::stream_m_s;

use crate::flow::number::{Jet, Number};

/// A current that is the same at all depths; the bed slows it. [`FreeWater::add`](crate::flow::FreeWater::add) takes it
/// in. Every copy of the water copies it, so large tables belong behind an [`Arc`](std::sync::Arc).
pub trait PlaneCurrent: std::fmt::Debug + DynClone + Send + Sync {
    /// (east, north) at (east, north) `p` at time `t_s`, m/s.
    fn velocity(&self, p: Vector2<f64>, t_s: f64) -> Vector2<f64>;

    /// The same with its slopes, for a place and a time that carry theirs. The slopes are those of central differences,
    /// unless the current gives its own: a formula over [`Number`] gives both.
    fn with_slopes(&self, p: Vector2<Jet>, t_s: Jet) -> Vector2<Jet> {
        /// Small compared with a current's scales, large compared with rounding at places of 10³ m; m and s.
        const H: f64 = 1e-3;
        let (place, now_s) = (p.map(|v| v.value), t_s.value);
        let at = |dx: f64, dy: f64, dt: f64| self.velocity(place + Vector2::new(dx, dy), now_s + dt);
        let back = H.min(now_s);
        let slopes = [
            (at(H, 0.0, 0.0) - at(-H, 0.0, 0.0)) / (2.0 * H),
            (at(0.0, H, 0.0) - at(0.0, -H, 0.0)) / (2.0 * H),
            (at(0.0, 0.0, H) - at(0.0, 0.0, -back)) / (H + back),
        ];
        let here = self.velocity(place, now_s);
        Vector2::from_fn(|d, _| Jet::known(here[d], [p.x, p.y, t_s], slopes.map(|s| s[d])))
    }

    /// Brings inner state up to `t_s`, s, as [`Flow::advance`](world::fields::Flow::advance) does.
    fn advance(&mut self, _t_s: f64) {}
}

dyn_clone::clone_trait_object!(PlaneCurrent);

/// A current in the water.
#[derive(Clone, Debug)]
pub(super) struct CurrentEntry {
    /// Its name in scenarios.
    pub(super) name: &'static str,
    /// Whether another crate made it. Parameters of the others were checked; of this one, every value is.
    pub(super) is_own: bool,
    pub(super) current: Box<dyn PlaneCurrent>,
}

impl CurrentEntry {
    /// What is wrong with it at a place and a time.
    pub(super) fn fault(&self, p: Vector2<f64>, t_s: f64) -> Option<String> {
        if self.is_own { self.fault_of(self.current.velocity(p, t_s), p, t_s) } else { None }
    }

    /// What is wrong with a velocity that it gave.
    fn fault_of(&self, v: Vector2<f64>, p: Vector2<f64>, t_s: f64) -> Option<String> {
        let most = stream_m_s.1;
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
        let current = &*self.current;
        let v = N::either(p, t_s, |p, t_s| current.velocity(p, t_s), |p, t_s| current.with_slopes(p, t_s));
        if self.is_own {
            let fault = self.fault_of(v.map(Number::value), p.map(Number::value), t_s.value());
            assert!(fault.is_none(), "{}", fault.unwrap_or_default());
        }
        v
    }
}
