//! Eyes of the searchers: pictures through the water, and what pictures and sidescan echoes show of a source.
//!
//! `robots` does not know this crate. A strategy looks through its trait [`Eyes`], which is [`StandardEyes`] here; a
//! camera's picture is made through its trait `Imaging`, which is [`camera::Optics`] here. What looks at pictures does
//! not know what makes them.
#![forbid(unsafe_code)]

pub mod camera;
mod numbers;
pub mod sidescan;
pub mod survey;
#[cfg(test)]
mod testing;
pub mod vision;

use image::RgbImage;
use robots::strategy::{Eyes, Survey, SurveySpec, VerifierSpec};

/// The eyes of this crate.
#[derive(Clone, Copy, Debug, Default)]
pub struct StandardEyes;

impl Eyes for StandardEyes {
    fn survey(&self, spec: &SurveySpec, told: bool) -> Box<dyn Survey> {
        Box::new(survey::SurveyFlight::new(spec, told))
    }

    fn shows_source(&self, picture: &RgbImage, spec: &VerifierSpec) -> bool {
        vision::Verifier::new(spec).judge(picture).verified
    }
}
