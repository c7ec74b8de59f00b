//! What a strategy will demand of its vehicle, as far as its parameters tell: heights, speeds, number of
//! declarations.

use super::survey::{AfterDeclaration, SurveySpec};
use crate::handoff::{Capabilities, Need, Vertical};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::ranges::{NonNegative, Positive};

/// Vertical part of a strategy's goals.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub enum VerticalSpec {
    /// Height above the bed, m.
    Altitude(Positive),
    /// Depth below the surface, m.
    Depth(NonNegative),
}

impl From<VerticalSpec> for Vertical {
    fn from(v: VerticalSpec) -> Self {
        match v {
            VerticalSpec::Altitude(m) => Vertical::Altitude(m.get()),
            VerticalSpec::Depth(m) => Vertical::Depth(m.get()),
        }
    }
}

/// Heights and speeds, each with the path of its field below the strategy.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Wishes {
    /// Altitudes and depths.
    pub verticals: Vec<(String, Vertical)>,
    /// Speeds over ground, m/s.
    pub speeds_m_s: Vec<(String, f64)>,
    /// Fields that ask it to wait at a place.
    pub waits: Vec<String>,
}

/// What a vehicle that holds a depth does without its instrument.
pub(super) const NO_DEPTH: &str = "cannot hold a depth";

impl Wishes {
    /// The instruments that guidance and autopilot need to carry them out with a vehicle that can do so much; paths
    /// below the strategy.
    pub fn needs(&self, able: &Capabilities) -> Vec<Need> {
        if *self == Self::default() {
            return Vec::new();
        }
        let mut needs = vec![Need::vital("", "compass", "cannot steer a course")];
        // A vehicle that holds no height is told so elsewhere.
        let heights = self.verticals.iter().filter(|_| able.dives && able.holds_depth);
        needs.extend(heights.map(|(field, vertical)| match vertical {
            Vertical::Altitude(_) => Need::vital(field, "altimeter", "cannot hold an altitude"),
            Vertical::Depth(_) => Need::vital(field, "depth", NO_DEPTH),
        }));
        if able.dives && !able.holds_depth {
            needs.push(Need::vital("", "depth", "never turns at the depths of its autopilot"));
            needs.push(Need::wish("", "altimeter", "does not turn up before the bed"));
        }
        needs
    }

    /// The demands of a mission at one speed and height.
    pub(super) fn mission(speed_m_s: Positive, vertical: VerticalSpec) -> Self {
        Self {
            verticals: vec![("vertical".to_string(), vertical.into())],
            speeds_m_s: vec![("speed_m_s".to_string(), speed_m_s.get())],
            waits: Vec::new(),
        }
    }

    /// With that of a part, by its field, which waits at a place.
    pub(super) fn waiting(mut self, path: &str, field: Option<&'static str>) -> Self {
        self.waits.extend(field.map(|f| format!("{path}.{f}")));
        self
    }

    /// The demands of a mission at one speed, at whatever height.
    pub(super) fn speed(speed_m_s: Positive) -> Self {
        Self { verticals: Vec::new(), speeds_m_s: vec![("speed_m_s".to_string(), speed_m_s.get())], waits: Vec::new() }
    }

    /// With those of a survey, by its field.
    pub(super) fn survey(mut self, path: &str, survey: &SurveySpec) -> Self {
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
        let lowest = survey.camera.as_ref().and_then(|c| c.add_up.as_ref());
        self.verticals.extend(lowest.map(|a| {
            let at = format!("{path}.camera.add_up.least_altitude_m");
            (at, Vertical::Altitude(a.least_altitude_m.get()))
        }));
        self
    }

    /// With those of what follows a declaration.
    pub(super) fn after(self, after: &AfterDeclaration) -> Self {
        match after {
            AfterDeclaration::Survey(survey) => self.survey("after_declaration", survey),
            AfterDeclaration::GoHome | AfterDeclaration::Stop => self,
        }
    }

    /// The same as demands of a strategy within another one, below its field.
    pub(super) fn within(self, path: &str) -> Self {
        Self {
            verticals: (self.verticals.into_iter()).map(|(at, v)| (format!("{path}.{at}"), v)).collect(),
            speeds_m_s: (self.speeds_m_s.into_iter()).map(|(at, v)| (format!("{path}.{at}"), v)).collect(),
            waits: (self.waits.into_iter()).map(|at| format!("{path}.{at}")).collect(),
        }
    }
}
