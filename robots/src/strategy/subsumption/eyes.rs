//! Looks with the camera at each last detection point that Reacquire passes, and reports a source seen there.
//!
//! *Source*: Tian et al. 2013, section 6, names it as future work: pictures at every LCDP, not only at the declared
//! place.
//!
//! *Parameters*: see [`EyesSpec`]; all are ours.
//!
//! *Deviations*: the paper does not say when a picture is taken. An LCDP is known λ seconds after the vehicle has
//! left it. So the picture is taken when Reacquire, whose pattern is centred on the LCDP, comes back within
//! `within_m` of it.

use super::super::survey::{Eyes, VerifierSpec};
use crate::handoff::{Declaration, Observation, Verdict};
use crate::memory::PlumeMemory;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::sync::Arc;
use world::ranges::Positive;

/// Parameters of looking at last detection points.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct EyesSpec {
    /// The camera takes a picture within this distance of the newest LCDP, m.
    #[default(Positive::new(8.0))]
    pub within_m: Positive,
    /// Time between two pictures, s.
    #[default(Positive::new(1.0))]
    pub period_s: Positive,
    /// The test that a picture must pass.
    pub verifier: VerifierSpec,
}

/// State of looking at last detection points.
#[derive(Debug)]
pub(super) struct PointLooks {
    spec: EyesSpec,
    eyes: Arc<dyn Eyes>,
    asked_s: Option<f64>,
    asks: bool,
}

impl PointLooks {
    pub(super) fn new(spec: &EyesSpec, eyes: &Arc<dyn Eyes>) -> Self {
        Self { spec: spec.clone(), eyes: eyes.clone(), asked_s: None, asks: false }
    }

    /// Whether a picture is wanted in this tick.
    pub(super) fn asks(&self) -> bool {
        self.asks
    }

    /// Does not look in this tick.
    pub(super) fn rest(&mut self) {
        self.asks = false;
    }

    /// One tick of Reacquire; the source at the newest last detection point, if the camera has seen one near it.
    pub(super) fn step(&mut self, seen: &Observation, memory: &PlumeMemory) -> Option<Declaration> {
        self.asks = false;
        let point = memory.lcdps.newest()?;
        if (point.position - seen.estimate.position).norm() > self.spec.within_m.get() {
            return None;
        }
        if let Some(picture) = &seen.picture
            && self.eyes.shows_source(&picture.image, &self.spec.verifier)
        {
            return Some(Declaration {
                verdict: Verdict::Verified,
                ..Declaration::first(seen.t_s, point.position, "Eyes")
            });
        }
        let due = |t: f64| seen.t_s - t >= self.spec.period_s.get() - 1e-9;
        if self.asked_s.is_none_or(due) {
            (self.asked_s, self.asks) = (Some(seen.t_s), true);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::handoff::testing::seen;
    use crate::handoff::{Lcdp, Picture};
    use crate::strategy::testing::setting;
    use image::{Rgb, RgbImage};
    use nalgebra::{UnitQuaternion, Vector2, Vector3};

    /// Green water, or a red picture, which the eyes of these tests take for a source.
    fn picture(source: bool) -> Picture {
        let colour = if source { [210, 60, 60] } else { [90, 150, 140] };
        Picture {
            image: Arc::new(RgbImage::from_pixel(160, 120, Rgb(colour))),
            p_BC: Vector3::zeros(),
            R_BC: UnitQuaternion::identity(),
            view_rad: 1.0,
        }
    }

    #[test]
    fn it_looks_where_contact_was_lost_and_only_there() {
        let mut eyes = PointLooks::new(&EyesSpec::default(), &setting(8.0, false).eyes);
        let mut memory = PlumeMemory::default();
        let at = |t_s: f64, east: f64| seen(t_s, Vector2::new(east, 0.0), 90.0, None);
        assert_eq!(eyes.step(&at(0.0, 0.0), &memory), None);
        assert!(!eyes.asks(), "no point to look at");
        memory.lcdps.add(Lcdp::new_at(0.0, Vector2::new(100.0, 0.0)));
        eyes.step(&at(1.0, 80.0), &memory);
        assert!(!eyes.asks(), "20 m off");
        eyes.step(&at(2.0, 95.0), &memory);
        assert!(eyes.asks());
        eyes.step(&at(2.5, 96.0), &memory);
        assert!(!eyes.asks(), "one a second");
        let with = |source| {
            let mut o = at(3.0, 97.0);
            o.picture = Some(picture(source));
            o
        };
        assert_eq!(eyes.step(&with(false), &memory), None);
        let declared = eyes.step(&with(true), &memory).expect("a source is in the picture");
        assert_eq!(declared.position, Vector2::new(100.0, 0.0));
        assert_eq!((declared.rule, declared.verdict), ("Eyes", Verdict::Verified));
    }
}
