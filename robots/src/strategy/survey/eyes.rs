//! What a strategy asks of those who look at pings and pictures. It knows them by these traits alone.

use super::spec::SurveySpec;
use super::verifier_spec::VerifierSpec;
use crate::behave::Stride;
use crate::handoff::{Declaration, Observation, Vertical};
use image::RgbImage;
use std::fmt::Debug;
use world::units::Heading;

/// Looks at pings and pictures.
pub trait Eyes: Debug + Send + Sync {
    /// Surveys of places, one after the other. `told`: the places were told, which is surer than declared.
    fn survey(&self, spec: &SurveySpec, told: bool) -> Box<dyn Survey>;

    /// Whether a picture shows a source that gives off dye.
    fn shows_source(&self, picture: &RgbImage, spec: &VerifierSpec) -> bool;
}

/// Passes over a place with sidescan and camera, and the verdict on it.
pub trait Survey: Debug + Send + Sync {
    /// Begins with a declared place; `along` is the direction of the lines, up-flow.
    fn enter(&mut self, declaration: Declaration, seen: &Observation, along: Heading);

    /// One tick. `arrived` says whether the guidance has reached the end of the last line.
    fn step(&mut self, seen: &Observation, arrived: bool) -> Progress;

    /// Height for the passes; `None` while no passes are flown.
    fn vertical(&self) -> Option<Vertical>;

    /// Whether a picture is wanted in this tick.
    fn picture(&self) -> bool;
}

/// Result of a step after a declaration.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// Continue with this answer for the guidance.
    Go(Stride),
    /// The survey is over: the declaration again, with its verdict.
    Over(Declaration),
}
