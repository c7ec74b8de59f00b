//! Numbers of which the water's formulas are made: plain ones, and numbers that carry their slopes.
//!
//! *Source*: forward differentiation, Griewank & Walther 2008, Evaluating Derivatives, ch. 3.
//!
//! *Parameters*: none.
//!
//! *Deviations*: where a formula has a kink, the slope is that of the piece that gives the value. Currents of which
//! only values are known have slopes by central differences (file `plane_current`).
//!
//! The formulas of the water stand once, over [`Number`]. With `f64` they give the values that carry the plume, with
//! [`Jet`] the gradients that act on a hull, in one evaluation in place of seven.

use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

use nalgebra::{Vector2, Vector3};
use world::math;

/// A number that the water's formulas can be evaluated with.
pub trait Number:
    Copy
    + std::fmt::Debug
    + PartialEq
    + 'static
    + From<f64>
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + SubAssign
    + MulAssign
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// The number without its slopes.
    fn value(self) -> f64;

    /// A vector at a place and a time, by the function that takes numbers of this kind.
    fn either(
        p: Vector2<Self>,
        t_s: Self,
        plain: impl FnOnce(Vector2<f64>, f64) -> Vector2<f64>,
        with_slopes: impl FnOnce(Vector2<Jet>, Jet) -> Vector2<Jet>,
    ) -> Vector2<Self>;

    /// Sine and cosine of an angle, rad.
    fn sin_cos(self) -> (Self, Self);

    /// Natural exponential.
    fn exp(self) -> Self;

    /// Natural logarithm.
    fn ln(self) -> Self;

    /// The smaller one.
    fn least(self, other: Self) -> Self {
        if other.value() < self.value() { other } else { self }
    }

    /// The greater one.
    fn greatest(self, other: Self) -> Self {
        if other.value() > self.value() { other } else { self }
    }

    /// Limited to a range.
    fn within(self, lo: Self, hi: Self) -> Self {
        self.greatest(lo).least(hi)
    }
}

impl Number for f64 {
    #[inline]
    fn value(self) -> f64 {
        self
    }

    #[inline]
    fn either(
        p: Vector2<Self>,
        t_s: Self,
        plain: impl FnOnce(Vector2<f64>, f64) -> Vector2<f64>,
        _: impl FnOnce(Vector2<Jet>, Jet) -> Vector2<Jet>,
    ) -> Vector2<Self> {
        plain(p, t_s)
    }

    #[inline]
    fn sin_cos(self) -> (Self, Self) {
        math::sin_cos(self)
    }

    #[inline]
    fn exp(self) -> Self {
        math::exp(self)
    }

    #[inline]
    fn ln(self) -> Self {
        math::ln(self)
    }
}

/// A number with its slopes east, north, up (1/m) and in time (1/s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// The number itself.
    pub value: f64,
    /// Its slopes.
    pub slopes: [f64; 4],
}

impl Jet {
    /// East, north, up and time themselves, at a place and a time.
    pub fn coordinates(p: &Vector3<f64>, t_s: f64) -> [Self; 4] {
        let values = [p.x, p.y, p.z, t_s];
        std::array::from_fn(|k| Self {
            value: values[k],
            slopes: std::array::from_fn(|other| f64::from(u8::from(other == k))),
        })
    }

    /// A function of `at`, given its value and its slope along each of them.
    pub fn known<const K: usize>(value: f64, at: [Self; K], slopes: [f64; K]) -> Self {
        at.iter().zip(slopes).fold(Self::from(value), |sum, (at, slope)| sum + at.through(0.0, slope))
    }

    /// A function of this number, given its value and its slope.
    #[inline]
    fn through(self, value: f64, slope: f64) -> Self {
        Self { value, slopes: self.slopes.map(|s| s * slope) }
    }

    /// With slopes made from those of both.
    #[inline]
    fn joined(self, other: Self, value: f64, slope: impl Fn(f64, f64) -> f64) -> Self {
        Self { value, slopes: std::array::from_fn(|k| slope(self.slopes[k], other.slopes[k])) }
    }
}

impl From<f64> for Jet {
    #[inline]
    fn from(value: f64) -> Self {
        let slopes = [0.0; 4];
        Self { value, slopes }
    }
}

impl Number for Jet {
    #[inline]
    fn value(self) -> f64 {
        self.value
    }

    #[inline]
    fn either(
        p: Vector2<Self>,
        t_s: Self,
        _: impl FnOnce(Vector2<f64>, f64) -> Vector2<f64>,
        with_slopes: impl FnOnce(Vector2<Jet>, Jet) -> Vector2<Jet>,
    ) -> Vector2<Self> {
        with_slopes(p, t_s)
    }

    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = math::sin_cos(self.value);
        (self.through(sin, cos), self.through(cos, -sin))
    }

    fn exp(self) -> Self {
        let exp = math::exp(self.value);
        self.through(exp, exp)
    }

    fn ln(self) -> Self {
        self.through(math::ln(self.value), 1.0 / self.value)
    }
}

impl Neg for Jet {
    type Output = Self;

    #[inline]
    fn neg(self) -> Self {
        self.through(-self.value, -1.0)
    }
}

impl Add for Jet {
    type Output = Self;

    #[inline]
    fn add(self, other: Self) -> Self {
        self.joined(other, self.value + other.value, |a, b| a + b)
    }
}

impl Sub for Jet {
    type Output = Self;

    #[inline]
    fn sub(self, other: Self) -> Self {
        self.joined(other, self.value - other.value, |a, b| a - b)
    }
}

impl Mul for Jet {
    type Output = Self;

    #[expect(clippy::suspicious_arithmetic_impl, reason = "the rule of the product adds")]
    #[inline]
    fn mul(self, other: Self) -> Self {
        let of_product = |a: f64, b: f64| a * other.value + self.value * b;
        self.joined(other, self.value * other.value, of_product)
    }
}

impl Div for Jet {
    type Output = Self;

    #[inline]
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        let per = 1.0 / other.value;
        self.joined(other, quotient, |a, b| (a - quotient * b) * per)
    }
}

impl Add<f64> for Jet {
    type Output = Self;

    #[inline]
    fn add(self, other: f64) -> Self {
        let value = self.value + other;
        Self { value, ..self }
    }
}

impl Sub<f64> for Jet {
    type Output = Self;

    #[inline]
    fn sub(self, other: f64) -> Self {
        let value = self.value - other;
        Self { value, ..self }
    }
}

impl Mul<f64> for Jet {
    type Output = Self;

    #[inline]
    fn mul(self, other: f64) -> Self {
        self.through(self.value * other, other)
    }
}

impl Div<f64> for Jet {
    type Output = Self;

    #[inline]
    fn div(self, other: f64) -> Self {
        self.through(self.value / other, 1.0 / other)
    }
}

impl AddAssign for Jet {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Jet {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

impl MulAssign for Jet {
    #[inline]
    fn mul_assign(&mut self, other: Self) {
        *self = *self * other;
    }
}

/// A known vector (east, north) as many times as a number says.
#[inline]
pub(crate) fn times<N: Number>(v: Vector2<f64>, by: N) -> Vector2<N> {
    Vector2::new(by * v.x, by * v.y)
}

/// A known vector (east, north) without slopes.
#[inline]
pub(crate) fn still<N: Number>(v: Vector2<f64>) -> Vector2<N> {
    Vector2::new(v.x.into(), v.y.into())
}

/// The product of two vectors (east, north).
#[inline]
pub(crate) fn dot<N: Number>(a: Vector2<N>, b: Vector2<N>) -> N {
    a.x * b.x + a.y * b.y
}

/// The same with a known vector.
#[inline]
pub(crate) fn along<N: Number>(v: Vector2<f64>, p: Vector2<N>) -> N {
    p.x * v.x + p.y * v.y
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A formula with every operation.
    fn formula<N: Number>([x, y, z, t]: [N; 4]) -> N {
        let (sin, cos) = (x * 0.7 - t * 0.3 + 0.2).sin_cos();
        let mut all = (sin * y + cos / (z * z + 1.0)) * (y * 0.1).exp() - (z * z + 2.0).ln() / 3.0;
        let squares = N::either(
            Vector2::new(x, y),
            t,
            |p, _| p.component_mul(&p),
            |p, _| p.map(|v| Jet::known(v.value * v.value, [v], [2.0 * v.value])),
        );
        all += squares.x;
        all -= -y.within(N::from(-1.0), N::from(0.5));
        all *= z.greatest(N::from(-4.0)).least(N::from(8.0));
        all
    }

    #[test]
    fn slopes_are_those_of_differences_and_values_those_of_plain_numbers() {
        for (p, t_s) in [
            (Vector3::new(1.0, -0.4, 2.0), 3.0),
            (Vector3::new(-0.3, 2.0, -1.5), 0.1),
            (Vector3::new(0.0, -3.0, -7.0), 40.0),
        ] {
            let jet = formula(Jet::coordinates(&p, t_s));
            let at = [p.x, p.y, p.z, t_s];
            assert_eq!(jet.value.to_bits(), formula(at).to_bits());
            for k in 0..4 {
                let moved = |by: f64| {
                    let mut at = at;
                    at[k] += by;
                    formula(at)
                };
                let difference = (moved(1e-5) - moved(-1e-5)) / 2e-5;
                // Rounding: 1e-15 of values up to 100 over 2e-5; the third derivative times 1e-10.
                assert!((jet.slopes[k] - difference).abs() < 1e-7, "{k} at {p}");
            }
        }
    }
}
