//! Shared by tests of strategies: a setting, eyes, and a decision with what its strategy shows then.

use super::{Eyes, Setting, Strategy, Survey, SurveySpec, VerifierSpec};
use crate::handoff::testing::area;
use crate::handoff::{Decision, Observation, Shown};
use image::RgbImage;
use std::ops::Deref;
use std::sync::Arc;
use world::obstacles::Obstacles;
use world::seeds::Stream;
use world::terrain::Terrain;

/// Eyes for tests that fly no survey: a picture with anything bright red shows a source.
#[derive(Debug)]
pub(crate) struct Blind;

impl Eyes for Blind {
    fn survey(&self, _: &SurveySpec, _: bool) -> Box<dyn Survey> {
        unreachable!("no survey is tested here")
    }

    fn shows_source(&self, picture: &RgbImage, _: &VerifierSpec) -> bool {
        picture.pixels().any(|p| p.0[0] > 200)
    }
}

/// The usual area over a level bed, with nothing charted.
pub(crate) fn setting(depth_m: f64, maps: bool) -> Setting {
    Setting { area: area(), bed: Terrain::Level { depth_m }, chart: Obstacles::default(), maps, eyes: Arc::new(Blind) }
}

/// A strategy's tick. It is read like the decision.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Ticked {
    decision: Decision,
    pub(crate) shown: Shown,
}

impl Ticked {
    /// One tick of a strategy.
    pub(crate) fn step(strategy: &mut dyn Strategy, seen: &Observation, rng: &mut Stream) -> Self {
        let decision = strategy.step(seen, rng);
        Self { decision, shown: strategy.shown() }
    }
}

impl Deref for Ticked {
    type Target = Decision;

    fn deref(&self) -> &Decision {
        &self.decision
    }
}
