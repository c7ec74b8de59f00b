//! What a strategy decides in a tick.

use super::{Goal, WaysAhead};
use bevy_ecs::prelude::Component;
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use strum::IntoStaticStr;
use world::digest::Digest;
use world::seeds;

/// What a vehicle or a gantry is doing, in the terms of the field.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum Behaviour {
    /// Before the first decision; of a gantry: waiting.
    #[default]
    Idle,
    /// Actuators driven by a time table.
    OpenLoop,
    /// Going to a place, detections ignored.
    GoTo,
    /// Looking for the plume.
    Find,
    /// In the plume.
    TrackIn,
    /// Just lost the plume.
    TrackOut,
    /// Searching around the points where the plume was lost.
    Reacquire,
    /// Going home after the declaration, or giving up.
    GoHome,
    /// Mission over; of a gantry: at the end.
    Done,
    /// On a planned path to the believed source.
    FollowPath,
    /// Turning away from an obstacle.
    Avoid,
    /// Passing over a declared place with sidescan and camera.
    Survey,
    /// Of a gantry: full sweep across the stream.
    Sweep,
    /// Of a gantry: to the best place of a sweep.
    ToBest,
    /// Of a gantry: a step up-stream.
    StepUp,
    /// Of a gantry: cast to a neighbouring place across the stream.
    Cast,
    /// A behaviour of a strategy from another crate, named like those above: a-z, 0-9 and _.
    Other(&'static str),
}

impl Serialize for Behaviour {
    fn serialize<S: serde::Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(self.name())
    }
}

impl Behaviour {
    /// All behaviours of vehicles in this crate, for tables and legends.
    pub const ALL: [Behaviour; 12] = [
        Behaviour::Idle,
        Behaviour::OpenLoop,
        Behaviour::GoTo,
        Behaviour::Find,
        Behaviour::TrackIn,
        Behaviour::TrackOut,
        Behaviour::Reacquire,
        Behaviour::GoHome,
        Behaviour::Done,
        Behaviour::FollowPath,
        Behaviour::Avoid,
        Behaviour::Survey,
    ];

    /// All behaviours of gantries.
    pub const OF_GANTRY: [Behaviour; 6] =
        [Behaviour::Idle, Behaviour::Sweep, Behaviour::ToBest, Behaviour::StepUp, Behaviour::Cast, Behaviour::Done];

    /// Name as it stands in files and topics.
    pub fn name(self) -> &'static str {
        match self {
            Self::Other(name) => name,
            own => own.into(),
        }
    }

    /// The different behaviours among `all`: those of this crate in the order of tables, then others in order of
    /// appearance.
    pub fn seen(all: impl Iterator<Item = Behaviour>) -> Vec<Behaviour> {
        let mut seen: Vec<Behaviour> = Vec::new();
        for b in all {
            if !seen.contains(&b) {
                seen.push(b);
            }
        }
        seen.sort_by_key(|b| Self::ALL.iter().position(|o| o == b).unwrap_or(Self::ALL.len()));
        seen
    }

    /// Its number in digests: its place among those of its kind of machine; for other behaviours a hash of the name.
    pub fn number(self, among: &[Self]) -> f64 {
        let own = among.iter().position(|b| *b == self);
        own.map_or_else(|| f64::from((seeds::key(0, self.name(), "behaviour") >> 32) as u32), |place| place as f64)
    }
}

/// What instruments other than the chemical sensor say about a declared place.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// Nobody has looked.
    #[default]
    Unchecked,
    /// A source was seen there.
    Verified,
    /// Looked at, and no source was seen.
    Rejected,
    /// Looked at, and what was seen is not enough to tell.
    CannotTell,
}

impl Verdict {
    /// Name as it stands in files and topics.
    pub fn name(self) -> &'static str {
        self.into()
    }

    /// The same for people.
    pub fn label(self) -> &'static str {
        match self {
            Verdict::CannotTell => "cannot tell",
            told => told.name(),
        }
    }
}

/// The last detection points that a declaration rests on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Evidence {
    /// How many.
    pub points: u32,
    /// Time of the oldest of them, s.
    pub since_s: f64,
    /// Their mean (east, north), m.
    pub middle_m: [f64; 2],
    /// The farthest of them from it, m.
    pub reach_m: f64,
}

/// The pictures that a verdict of all pictures of a place rests on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct PictureEvidence {
    /// How many.
    pub pictures: u32,
    /// How many more said nothing: empty, black, white or flat.
    pub useless: u32,
    /// Lines flown for them, or points held.
    pub lines: u32,
    /// Altitude of the lowest line or point, m.
    pub lowest_m: f64,
    /// Visibility that they show, m; `None` without a picture.
    pub visibility_m: Option<f64>,
    /// Natural logarithm of the Bayes factor: positive speaks for a source.
    pub log_factor: f64,
}

/// Rule name of a declaration made where a plume crosses the up-flow edge of a subregion.
pub const UP_FLOW_EDGE: &str = "up_flow_edge";

/// A declared source, or the place at which a plume was traced out of a subregion.
#[derive(Component, Clone, Copy, Debug, Default, PartialEq)]
pub struct Declaration {
    /// Number among the robot's declarations, from 0. A later declaration of the same number replaces the earlier
    /// one: it is the same source after an inspection.
    pub number: u32,
    /// When, s.
    pub t_s: f64,
    /// Where, as the vehicle believes (east, north), m.
    pub position: Vector2<f64>,
    /// How high (up from the still surface), m; `None` if the rule says only where on the map.
    pub z_m: Option<f64>,
    /// By which rule.
    pub rule: &'static str,
    /// Subregion of the mission in which it was made, from 0; `None` if the mission has no subregions.
    pub region: Option<u32>,
    /// What a look at it said.
    pub verdict: Verdict,
    /// Place of the source in the sidescan image, or in the pictures that verify it together, as the vehicle believes
    /// (east, north), m.
    pub surveyed: Option<Vector2<f64>>,
    /// The pictures its verdict rests on, if they were added up.
    pub looked: Option<PictureEvidence>,
    /// The points it rests on, if the rule uses last detection points.
    pub evidence: Option<Evidence>,
}

impl Declaration {
    /// The first declaration of a mission without subregions, before any inspection.
    pub fn first(t_s: f64, position: Vector2<f64>, rule: &'static str) -> Self {
        Self { t_s, position, rule, ..Self::default() }
    }

    /// Whether it marks where a plume crosses a subregion's up-flow edge: the source is beyond the edge, not there.
    pub fn at_edge(&self) -> bool {
        self.rule == UP_FLOW_EDGE
    }

    /// Adds what it says, and what became of it, to a digest; the readings that it rests on are in the states.
    pub fn digest_into(&self, digest: &mut Digest) {
        let (x, y) = (self.position.x, self.position.y);
        digest.f64s(&[f64::from(self.number), self.t_s, x, y]);
        let absent = f64::NAN;
        digest.f64s(&[self.z_m.unwrap_or(absent), self.region.map_or(absent, f64::from)]);
        digest.text(self.rule);
        digest.text(self.verdict.name());
    }

    /// Adds it to the earlier ones; it replaces one of the same number.
    pub fn join(self, earlier: &mut Vec<Declaration>) {
        match earlier.iter_mut().find(|d| d.number == self.number) {
            Some(same) => *same = self,
            None => earlier.push(self),
        }
    }
}

/// How a mission ended, as the strategy sees it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Came to its planned end.
    Completed,
    /// Given up: too far outside the area; by a gantry because it found nothing.
    Aborted,
}

impl Outcome {
    /// Of a search that ended where a source is, or was given up.
    pub fn of_search(found: bool) -> Self {
        if found { Self::Completed } else { Self::Aborted }
    }
}

/// What a searcher decides in a tick: a strategy with a [`Goal`] for a vehicle's guidance, a gantry's searcher with a
/// [`HeadGoal`](super::HeadGoal).
#[derive(Component, Clone, Copy, Debug, PartialEq)]
pub struct Decision<G: Send + Sync + 'static = Goal> {
    /// What it is doing.
    pub behaviour: Behaviour,
    /// What it asks of its machine.
    pub goal: G,
    /// Newly declared in this tick. Of a gantry nobody looks at it: it declares where it stops.
    pub declared: Option<Declaration>,
    /// Ask the camera, if there is one, for a picture.
    pub picture: bool,
    /// Ways about which the map is asked; a new number asks anew.
    pub ways: Option<WaysAhead>,
    /// Set when the mission is over.
    pub outcome: Option<Outcome>,
}

impl<G: Send + Sync> Decision<G> {
    /// Going for a goal, and nothing else.
    pub fn new(behaviour: Behaviour, goal: G) -> Self {
        Self { behaviour, goal, declared: None, picture: false, ways: None, outcome: None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_second_look_takes_the_first_ones_place() {
        let mut list = Vec::new();
        let first = Declaration::first(1.0, Vector2::zeros(), "a");
        let second = Declaration { number: 1, ..first };
        let looked_at = Declaration { verdict: Verdict::Verified, ..first };
        first.join(&mut list);
        second.join(&mut list);
        looked_at.join(&mut list);
        assert_eq!(list, [looked_at, second]);
    }

    #[test]
    fn digests_hold_all_that_a_declaration_says() {
        let plain = Declaration::first(1.0, Vector2::new(2.0, 3.0), "a");
        let others = [
            Declaration { number: 1, ..plain },
            Declaration { t_s: 1.5, ..plain },
            Declaration { position: Vector2::new(3.0, 2.0), ..plain },
            Declaration { z_m: Some(-4.0), ..plain },
            Declaration { rule: "b", ..plain },
            Declaration { region: Some(0), ..plain },
            Declaration { verdict: Verdict::Verified, ..plain },
        ];
        let digest = |declaration: &Declaration| {
            let mut digest = Digest::default();
            declaration.digest_into(&mut digest);
            digest.hex()
        };
        let mut all: Vec<String> = others.iter().chain([&plain]).map(digest).collect();
        all.sort();
        all.dedup();
        assert_eq!(all.len(), others.len() + 1);
    }

    #[test]
    fn digests_number_behaviours_by_their_place_and_others_by_their_name() {
        for (place, b) in Behaviour::ALL.into_iter().enumerate() {
            assert_eq!(b.number(&Behaviour::ALL), place as f64, "{b:?}");
        }
        for (place, b) in Behaviour::OF_GANTRY.into_iter().enumerate() {
            assert_eq!(b.number(&Behaviour::OF_GANTRY), place as f64, "{b:?}");
        }
        let spiral = Behaviour::Other("spiral");
        let number = |b: Behaviour| b.number(&Behaviour::ALL);
        assert_eq!((spiral.name(), number(spiral)), ("spiral", number(Behaviour::Other("spiral"))));
        assert!(number(spiral) > 255.0 && number(spiral) != number(Behaviour::Other("ladder")));
        let seen = Behaviour::seen([spiral, Behaviour::Find, spiral, Behaviour::GoTo].into_iter());
        assert_eq!(seen, [Behaviour::GoTo, Behaviour::Find, spiral]);
    }
}
