//! An arc of a path, with what does not change along it.
//!
//! *Source*: as for the path.
//!
//! *Parameters*: none of its own.
//!
//! *Deviations*: none.

use nalgebra::Vector2;
use std::f64::consts::{FRAC_PI_2, TAU};
use world::units::{Heading, wrap_tau};

/// Place and direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// (east, north), m.
    pub position: Vector2<f64>,
    /// Direction of motion.
    pub heading: Heading,
}

/// An arc from a pose on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Arc {
    start: Pose,
    /// +1 clockwise, -1 anticlockwise.
    turn: f64,
    radius_m: f64,
    /// (east, north), m.
    pub(super) centre: Vector2<f64>,
    /// Direction from the centre to the start.
    outward: Heading,
}

impl Arc {
    pub(super) fn new(start: Pose, turn: f64, radius_m: f64) -> Self {
        let centre = start.position + side(start.heading, turn) * radius_m;
        Self { start, turn, radius_m, centre, outward: Heading::from_vector(start.position - centre) }
    }

    /// Direction of motion after `s_m` metres.
    pub(super) fn heading(&self, s_m: f64) -> Heading {
        self.start.heading.turned(self.turn * s_m / self.radius_m)
    }

    /// Pose after `s_m` metres.
    pub(super) fn pose_at(&self, s_m: f64) -> Pose {
        let heading = self.heading(s_m);
        Pose { position: self.centre + side(heading, self.turn).scale(-self.radius_m), heading }
    }

    /// Length along it, if it is `length_m` long, from its start to the point nearest to `p`, in [0, circumference), m.
    pub(super) fn foot(&self, p: Vector2<f64>, length_m: f64) -> f64 {
        let to = Heading::from_vector(p - self.centre);
        let s = wrap_tau(self.turn * (to.rad() - self.outward.rad())) * self.radius_m;
        // Just behind the start is behind, not a whole circle ahead.
        let behind = s - TAU * self.radius_m;
        if s > length_m && -behind < s - length_m { behind } else { s }
    }
}

/// Unit vector to the side of a turn: right for clockwise.
pub(super) fn side(heading: Heading, turn: f64) -> Vector2<f64> {
    heading.turned(turn * FRAC_PI_2).unit()
}
