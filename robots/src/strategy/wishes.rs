//! What a strategy will ask of its vehicle, as far as its parameters tell: heights, speeds, how much it declares.

use super::map_and_plan::MapAndPlanSpec;
use super::spec::{StrategySpec, VerticalSpec};
use super::subregions::RegionsSpec;
use super::survey::{AfterDeclaration, SurveySpec};
use crate::handoff::Vertical;
use world::ranges::Positive;

/// Heights and speeds, each with the path of its field from the strategy's block.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wishes {
    /// Altitudes and depths.
    pub verticals: Vec<(String, Vertical)>,
    /// Speeds over ground, m/s.
    pub speeds_m_s: Vec<(String, f64)>,
}

impl Wishes {
    fn mission(speed_m_s: Positive, vertical: VerticalSpec) -> Self {
        Self {
            verticals: vec![("vertical".to_string(), vertical.into())],
            speeds_m_s: vec![("speed_m_s".to_string(), speed_m_s.get())],
        }
    }

    fn survey(mut self, path: &str, survey: &SurveySpec) -> Self {
        let passes = [
            ("sidescan", survey.sidescan.as_ref().map(|s| s.altitude_m)),
            ("camera", survey.camera.as_ref().map(|c| c.altitude_m)),
        ];
        for (name, altitude_m) in passes {
            self.verticals.extend(altitude_m.map(|m| {
                let at = format!("{path}.{name}.altitude_m");
                (at, Vertical::Altitude(m.get()))
            }));
        }
        self
    }

    fn after(self, after: &AfterDeclaration) -> Self {
        match after {
            AfterDeclaration::Survey(survey) => self.survey("after_declaration", survey),
            AfterDeclaration::GoHome | AfterDeclaration::Stop => self,
        }
    }

    fn within(self, path: &str) -> Self {
        Self {
            verticals: (self.verticals.into_iter())
                .map(|(at, v)| (format!("{path}.{at}"), v))
                .collect(),
            speeds_m_s: (self.speeds_m_s.into_iter())
                .map(|(at, v)| (format!("{path}.{at}"), v))
                .collect(),
        }
    }
}

impl StrategySpec {
    /// The heights and speeds that it will ask for.
    #[must_use]
    pub fn wishes(&self) -> Wishes {
        match self {
            StrategySpec::Amp(s) => {
                Wishes::mission(s.speed_m_s, s.vertical).after(&s.after_declaration)
            }
            StrategySpec::MapAndPlan(MapAndPlanSpec {
                speed_m_s,
                vertical,
                after_declaration,
                ..
            }) => Wishes::mission(*speed_m_s, *vertical).after(after_declaration),
            StrategySpec::Subsumption(s) => {
                let wishes = Wishes::mission(s.speed_m_s, s.vertical);
                match &s.survey {
                    Some(survey) => wishes.survey("survey", survey),
                    None => wishes,
                }
            }
            StrategySpec::Subregions(s) => {
                let mut wishes = Wishes::mission(s.speed_m_s, s.vertical);
                let search = s.search.wishes().within("search");
                wishes.verticals.extend(search.verticals);
                wishes.speeds_m_s.extend(search.speeds_m_s);
                wishes
            }
            StrategySpec::OpenLoop(_) => Wishes::default(),
        }
    }

    /// Most declarations of it that can stand at the end: what it rejects itself does not.
    #[must_use]
    pub fn declares_at_most(&self) -> usize {
        match self {
            StrategySpec::Amp(_) | StrategySpec::MapAndPlan(_) | StrategySpec::Subsumption(_) => 1,
            StrategySpec::OpenLoop(_) => 0,
            StrategySpec::Subregions(s) => {
                let regions = match &s.regions {
                    RegionsSpec::Grid(grid) => grid.order.len(),
                    RegionsSpec::Rectangles(rectangles) => rectangles.list.len(),
                };
                regions * s.search.declares_at_most()
            }
        }
    }
}
