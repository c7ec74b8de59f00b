//! Functions of small numbers that cancel when written plainly: their series.
//!
//! *Source*: Taylor series.
//!
//! *Parameters*: none.
//!
//! *Deviations*: none.

use world::math;

/// (e^x − 1)/x for a gentle x, to 3e-8.
#[inline(always)]
pub(crate) fn series(x: f32) -> f32 {
    1.0 + x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0 + x * (1.0 / 120.0 + x * (1.0 / 720.0)))))
}

/// −ln(1 − x)/x for a gentle x, to 1e-6.
#[inline(always)]
pub(crate) fn current_time(x: f32) -> f32 {
    1.0 + x * (0.5 + x * (1.0 / 3.0 + x * (0.25 + x * (0.2 + x * (1.0 / 6.0)))))
}

/// (e^x − 1)/x.
pub(crate) fn expansion(x: f64) -> f64 {
    if x.abs() < 1e-2 {
        return 1.0 + x * (0.5 + x * (1.0 / 6.0 + x * (1.0 / 24.0 + x * (1.0 / 120.0 + x / 720.0))));
    }
    (math::exp(x) - 1.0) / x
}

/// ln(1 + x)/x; infinite at −1 and below, which is never reached.
pub(crate) fn logarithm(x: f64) -> f64 {
    if x.abs() < 1e-2 {
        return 1.0 - x * (0.5 - x * (1.0 / 3.0 - x * (0.25 - x * (0.2 - x * (1.0 / 6.0 - x / 7.0)))));
    }
    if x <= -1.0 {
        return f64::INFINITY;
    }
    math::ln(1.0 + x) / x
}
