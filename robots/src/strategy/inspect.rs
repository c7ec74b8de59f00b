//! Inspection: surveys told places one after the other and says of each whether a source is there.
//!
//! *Source*: ours; targets that another search has left, looked at again: as the sidescan's contacts are by Tian et al.
//! 2013, section 5, and by identification missions in general.
//!
//! *Parameters*: see [`InspectSpec`].
//!
//! *Deviations*: a vehicle that hovers holds over the place for its pictures (`survey/holds.rs` of the crate `eyes`):
//! over the middle of each line that others fly, or, if pictures are added up, over the points that show what is still
//! unseen. Each place is declared when the vehicle has come within [`NEAR_M`] of it, by the rule `told`, and declared
//! again with the survey's verdict. The mission is completed after the last place, on the spot.

use super::about::About;
use super::setting::Setting;
use super::spec::{Strategy, StrategyParams};
use super::survey::{AfterDeclaration, Eyes, PostDeclaration, Progress, SurveySpec};
use super::wishes::VerticalSpec;
use super::wishes::Wishes;
use crate::behave::Stride;
use crate::error::{RobotError, require};
use crate::handoff::{Behaviour, Decision, Declaration, Goal, Manoeuvre, Observation, Outcome, Vertical};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::ranges::{Finite, Positive};
use world::registry::Listed;
use world::seeds::Stream;

/// The survey begins within this distance of a place, m: room for a turn before the first line.
const NEAR_M: f64 = 40.0;
/// Rule name of the declarations.
const TOLD: &str = "told";

/// The places and how they are surveyed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InspectSpec {
    /// The places, in the order in which they are visited; at least one.
    pub places: Vec<ToldSpec>,
    /// How each is surveyed.
    pub survey: SurveySpec,
    /// Speed over ground, m/s.
    #[serde(default = "speed")]
    pub speed_m_s: Positive,
    /// Altitude or depth between the places.
    #[serde(default = "vertical")]
    pub vertical: VerticalSpec,
}

fn speed() -> Positive {
    Positive::new(1.5)
}

fn vertical() -> VerticalSpec {
    VerticalSpec::Altitude(Positive::new(2.5))
}

/// A told place.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ToldSpec {
    /// East, m.
    pub east_m: Finite,
    /// North, m.
    pub north_m: Finite,
}

impl Listed for InspectSpec {
    const ENTRY: Entry = Entry {
        name: "Inspect",
        what: "surveys told places one after the other and says of each: verified, rejected or cannot tell",
        source: "ours, on the verification of Tian et al. 2013, section 5",
    };
}

impl StrategyParams for InspectSpec {
    fn build(&self, setting: &Setting) -> Result<Box<dyn Strategy>, RobotError> {
        Ok(Box::new(Inspect::new(self, &*setting.eyes)?))
    }

    fn about(&self) -> About {
        About {
            declares_at_most: self.places.len(),
            needs: self.survey.needs("survey"),
            wishes: Wishes::mission(self.speed_m_s, self.vertical).survey("survey", &self.survey),
            ..About::no_search()
        }
    }
}

/// State of the inspection.
#[derive(Debug)]
pub struct Inspect {
    places: Vec<Vector2<f64>>,
    vertical: Vertical,
    post: PostDeclaration,
    /// The place that is next or being surveyed.
    now: usize,
    surveying: bool,
    goal: Goal,
    outcome: Option<Outcome>,
}

impl Inspect {
    /// # Errors
    /// [`RobotError::Invalid`] without places, or if the survey's parts contradict each other.
    pub fn new(spec: &InspectSpec, eyes: &dyn Eyes) -> Result<Self, RobotError> {
        require(!spec.places.is_empty(), "strategy.places", "must have at least 1 place, got 0")?;
        spec.survey.check("strategy.survey")?;
        let place = |p: &ToldSpec| Vector2::new(p.east_m.get(), p.north_m.get());
        let vertical = spec.vertical.into();
        let after = AfterDeclaration::Survey(Box::new(spec.survey.clone()));
        Ok(Self {
            places: spec.places.iter().map(place).collect(),
            vertical,
            post: PostDeclaration::new(&after, eyes, true)?,
            now: 0,
            surveying: false,
            goal: Goal::none_yet(vertical, spec.speed_m_s.get()),
            outcome: None,
        })
    }

    /// One step of the survey; at its end, the declaration with its verdict.
    fn survey(&mut self, seen: &Observation) -> Option<Declaration> {
        let arrived = seen.guidance.done && seen.guidance.goal_id == self.goal.id;
        match self.post.step(seen, arrived) {
            Progress::Go(stride) => {
                stride.turn(&mut self.goal, self.post.vertical().unwrap_or(self.vertical));
                None
            }
            Progress::Over(declaration) => {
                self.surveying = false;
                self.now += 1;
                self.go();
                Some(declaration)
            }
        }
    }

    /// Sets out for the next place, or ends the mission.
    fn go(&mut self) {
        match self.places.get(self.now) {
            Some(point) => {
                let point = *point;
                let to = Manoeuvre::GoToPoint { point, radius_m: None };
                Stride::Start(to).turn(&mut self.goal, self.vertical);
            }
            None => self.outcome = Some(Outcome::Completed),
        }
    }
}

impl Strategy for Inspect {
    fn step(&mut self, seen: &Observation, _: &mut Stream) -> Decision {
        let mut declared = None;
        if seen.guidance.aborted && self.outcome.is_none() {
            self.outcome = Some(Outcome::Aborted);
        } else if self.goal.id == 0 {
            self.go();
        }
        if self.outcome.is_none() {
            if self.surveying {
                declared = self.survey(seen);
            } else if let Some(place) = self.places.get(self.now)
                && (place - seen.estimate.position).norm() <= NEAR_M
            {
                let up_flow = seen.estimate.flow.map(|f| f.up_flow());
                let along = up_flow.unwrap_or(seen.area.axis);
                let told = Declaration::first(seen.t_s, *place, TOLD);
                let (told, _) = self.post.enter(told, seen, along);
                declared = Some(told);
                self.surveying = true;
            }
        }
        let behaviour = match (self.outcome, self.surveying) {
            (Some(_), _) => Behaviour::Done,
            (None, true) => Behaviour::Survey,
            (None, false) => Behaviour::GoTo,
        };
        Decision {
            declared,
            picture: behaviour == Behaviour::Survey && self.post.picture(),
            outcome: self.outcome,
            ..Decision::new(behaviour, self.goal)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strategy::testing::Blind;

    #[test]
    fn without_places_or_with_a_part_that_is_wrong_it_is_refused() {
        let told = ToldSpec { east_m: Finite::new(0.0), north_m: Finite::new(0.0) };
        let wrong = SurveySpec { sidescan: None, ..SurveySpec::default() };
        for (places, survey, says) in [
            (vec![], SurveySpec::default(), "strategy.places: must have at least 1 place, got 0"),
            (vec![told], wrong, "strategy.survey.verify: "),
        ] {
            let spec = InspectSpec { places, survey, speed_m_s: speed(), vertical: vertical() };
            let said = Inspect::new(&spec, &Blind).unwrap_err().to_string();
            assert!(said.starts_with(says), "{said}");
        }
    }
}
