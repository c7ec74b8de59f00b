//! Transcendental functions with the same bits on every machine.
//!
//! The platform's C library chooses code by CPU and version, so the last bit of `f64::sin` may differ between machines,
//! and a chaotic run then diverges. All code inside a tick uses these functions (pure-Rust `libm`); clippy's
//! `disallowed-methods` enforces it. `sqrt` is exact everywhere.

macro_rules! via_libm {
    ($($(#[$doc:meta])* $name:ident($($arg:ident),+) = $libm:path;)*) => {
        $($(#[$doc])* #[inline] #[must_use] pub fn $name($($arg: f64),+) -> f64 { $libm($($arg),+) })*
    };
}

via_libm! {
    /// Sine of an angle in radians.
    sin(x) = libm::sin;
    /// Cosine of an angle in radians.
    cos(x) = libm::cos;
    /// Tangent of an angle in radians.
    tan(x) = libm::tan;
    /// Arcsine, radians.
    asin(x) = libm::asin;
    /// Arccosine, radians.
    acos(x) = libm::acos;
    /// Arctangent, radians.
    atan(x) = libm::atan;
    /// Four-quadrant arctangent of y / x, radians.
    atan2(y, x) = libm::atan2;
    /// Natural exponential.
    exp(x) = libm::exp;
    /// Natural logarithm.
    ln(x) = libm::log;
    /// x to the power y.
    powf(x, y) = libm::pow;
    /// Cube root.
    cbrt(x) = libm::cbrt;
    /// Hyperbolic tangent.
    tanh(x) = libm::tanh;
    /// Hyperbolic sine.
    sinh(x) = libm::sinh;
    /// Hyperbolic cosine.
    cosh(x) = libm::cosh;
    /// Error function.
    erf(x) = libm::erf;
    /// Logarithm of the gamma function.
    ln_gamma(x) = libm::lgamma;
}

/// Sine and cosine of an angle in radians.
#[inline]
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}
