//! The two sides of the up-flow direction.

/// A side, looking up-flow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left of up-flow.
    Left,
    /// Right of up-flow.
    Right,
}

impl Side {
    /// +1 to the right (clockwise), -1 to the left.
    pub fn sign(self) -> f64 {
        match self {
            Side::Left => -1.0,
            Side::Right => 1.0,
        }
    }

    /// The side of a signed distance or turn, right positive.
    pub fn from_rightward(rightward: f64) -> Self {
        if rightward < 0.0 { Side::Left } else { Side::Right }
    }

    /// The other one.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Side::Left => Side::Right,
            Side::Right => Side::Left,
        }
    }
}
