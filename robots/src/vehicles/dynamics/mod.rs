//! The equation of motion of every hull. Only this room, and what puts terms into it, uses NED and FRD axes.
//!
//! A hull is a [`Body`] (mass, added mass, volume, shape at the surface) and a set of [`Terms`]: damping, lift, drives.

mod axes;
mod body;
mod equation;
mod motion;
mod surface;

pub(super) use axes::{flip, turned, wrench};
pub(super) use body::{Body, Mass, added_coriolis};
#[cfg(test)]
pub(super) use equation::HullWater;
pub(super) use equation::{Carried, Equation, Relative, Stage, Terms};
pub(super) use surface::{Envelope, cells_of};
