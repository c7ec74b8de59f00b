//! Angles, and the compass heading: a unit of its own, because its meaning is easily mistaken.

use crate::math;
use nalgebra::Vector2;
use serde::{Deserialize, Deserializer, Serialize};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Standard gravity used throughout, m/s².
pub const GRAVITY_M_S2: f64 = 9.81;

/// Density of sea water where none is given, kg/m³.
pub const SEA_WATER_KG_M3: f64 = 1025.0;

/// kg/m³ in one µg/L.
pub const KG_M3_PER_UG_L: f64 = 1e-6;

/// Without its whole turns: an angle in [0, 2π), but for rounding.
fn within_a_turn(angle_rad: f64) -> f64 {
    // Nearly all angles are within a turn of the range. There it is known what the floor below would say: no quotient
    // is rounded up to a whole number. Angles next to zero are left to the floor, for which they may be none.
    if (0.0..TAU).contains(&angle_rad) {
        // Of a negative zero, the plain way makes a positive one.
        angle_rad + 0.0
    } else if (-TAU..=-1e-300).contains(&angle_rad) {
        angle_rad + TAU
    } else if (TAU..2.0 * TAU).contains(&angle_rad) {
        angle_rad - TAU
    } else {
        angle_rad - TAU * (angle_rad / TAU).floor()
    }
}

/// Wraps an angle to (−π, π].
pub fn wrap_pi(angle_rad: f64) -> f64 {
    let a = within_a_turn(angle_rad);
    if a > PI { a - TAU } else { a }
}

/// Wraps an angle to [0, 2π).
pub fn wrap_tau(angle_rad: f64) -> f64 {
    let a = within_a_turn(angle_rad);
    if a >= TAU { 0.0 } else { a }
}

/// Compass direction: radians clockwise from north, kept in [0, 2π).
///
/// A flow's heading is where the water *goes*; up-flow is [`Heading::opposite`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Heading(#[serde(deserialize_with = "any_turn")] f64);

/// Reads an angle, which may have whole turns too many.
fn any_turn<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    f64::deserialize(from).map(wrap_tau)
}

impl Heading {
    /// From radians clockwise from north.
    pub fn from_rad(rad: f64) -> Self {
        Self(wrap_tau(rad))
    }

    /// From degrees clockwise from north.
    pub fn from_deg(deg: f64) -> Self {
        Self::from_rad(deg.to_radians())
    }

    /// Direction of an (east, north) vector; north for the zero vector.
    pub fn from_vector(v: Vector2<f64>) -> Self {
        Self::from_rad(math::atan2(v.x, v.y))
    }

    /// Radians clockwise from north, in [0, 2π).
    pub fn rad(self) -> f64 {
        self.0
    }

    /// Degrees clockwise from north, in [0, 360).
    pub fn deg(self) -> f64 {
        self.0.to_degrees()
    }

    /// Yaw in ENU, radians anticlockwise from east, in (−π, π].
    pub fn yaw(self) -> f64 {
        wrap_pi(FRAC_PI_2 - self.0)
    }

    /// Unit vector (east, north).
    pub fn unit(self) -> Vector2<f64> {
        let (s, c) = math::sin_cos(self.0);
        Vector2::new(s, c)
    }

    /// Turned clockwise by `rad` (anticlockwise if negative).
    #[must_use]
    pub fn turned(self, rad: f64) -> Self {
        Self::from_rad(self.0 + rad)
    }

    /// The reverse direction.
    #[must_use]
    pub fn opposite(self) -> Self {
        self.turned(PI)
    }

    /// Signed turn from `self` to `other`, clockwise positive, in (−π, π].
    pub fn turn_to(self, other: Self) -> f64 {
        wrap_pi(other.0 - self.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn heading_and_yaw_are_inverse() {
        for deg in [0.0, 45.0, 90.0, 180.0, 270.0, 359.0] {
            let h = Heading::from_deg(deg);
            assert!(h.turn_to(Heading::from_rad(FRAC_PI_2 - h.yaw())).abs() < 1e-12);
            assert!(h.turn_to(Heading::from_vector(h.unit())).abs() < 1e-12);
        }
        assert!((Heading::from_deg(90.0).unit() - Vector2::new(1.0, 0.0)).norm() < 1e-12);
    }

    #[test]
    fn within_a_turn_of_the_range_the_floor_is_known() {
        let plain = |a: f64| a - TAU * (a / TAU).floor();
        let same = |a: f64| assert_eq!(within_a_turn(a).to_bits(), plain(a).to_bits(), "{a:e}");
        for edge in [0.0, 1e-310, 1e-300, 1e-17, 1.0, PI, TAU, 2.0 * TAU, 3.0 * TAU, 1e17] {
            let (mut down, mut up) = (edge, edge);
            for _ in 0..50 {
                for a in [down, up, -down, -up] {
                    same(a);
                }
                (down, up) = (down.next_down(), up.next_up());
            }
        }
        let mut random = crate::seeds::Stream::new(1, "test", "angles");
        for _ in 0..200_000 {
            let (a, small) = (random.uniform() * 8.0 * TAU - 4.0 * TAU, random.normal());
            for a in [a, small, small * 1e-12, TAU + small * 1e-14] {
                same(a);
            }
        }
        assert!(within_a_turn(f64::NAN).is_nan() && within_a_turn(f64::INFINITY).is_nan());
    }

    #[test]
    fn turns_wrap_the_short_way() {
        let turn = Heading::from_deg(350.0).turn_to(Heading::from_deg(20.0));
        assert!((turn.to_degrees() - 30.0).abs() < 1e-9);
        assert_eq!(wrap_pi(-PI), PI);
        assert_eq!(wrap_tau(-1e-20), 0.0);
    }
}
