//! All that a scenario can ask for by name, as `rheotaxis list` shows it, and all topics.
//!
//! A crate of your own adds rows to a kind, and reads scenarios with them, as the example `own_strategy` does:
//!
//! ```text
//! let registry = Registry::default().with::<Reacquires, Spiral>()?;
//! let loaded = rheotaxis::scenario::load_with(&registry, path)?;
//! ```
//!
//! What is not a row (systems, topics) is in [`crate::extend`].

use crate::frame::Frame;
use crate::machines::Apparatuses;
use crate::topic::{Topic, TopicValue, chunk, run};
use crate::{auv, gantry};
use serde_json::Value;
use world::catalogue::Entry;
use world::registry::Kind;
pub use world::registry::{Choice, Listed, Registry, Spec};

/// A part of the list.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    /// Algorithms of searchers.
    Algorithms,
    /// Currents.
    Flows,
    /// Sensors.
    Sensors,
    /// Vehicles, gantries and other machines.
    Vehicles,
}

/// How a scenario names the entries of a section.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EntryNames {
    /// As a choice: `Name(...)`.
    Choice,
    /// As a field: `name: (...)`.
    Field,
    /// Not by itself: as a part of another entry, or by one of its fields.
    Within,
}

/// The entries under one heading of the list.
#[derive(Clone, Debug, PartialEq)]
pub struct Section {
    /// The part of the list that it belongs to.
    pub group: Group,
    /// Its heading.
    pub heading: &'static str,
    /// How a scenario names its entries.
    pub named: EntryNames,
    /// Its entries.
    pub entries: Vec<Entry>,
}

/// All sections, in the order of the list. Sections with the same heading are joined.
pub fn sections(registry: &Registry) -> Vec<Section> {
    use Group::{Algorithms, Flows, Sensors, Vehicles};
    let chosen = RegistrySections(registry);
    let all = [
        chosen.kind::<robots::strategy::Strategies>(Algorithms),
        chosen.kind::<robots::behave::Finds>(Algorithms),
        chosen.kind::<robots::behave::TracksIn>(Algorithms),
        chosen.kind::<robots::behave::TracksOut>(Algorithms),
        chosen.kind::<robots::behave::Reacquires>(Algorithms),
        within(Algorithms, "Behaviours of the strategies' own", robots::behave::PARTS),
        chosen.kind::<robots::map::Maps>(Algorithms),
        chosen.kind::<robots::plan::Planners>(Algorithms),
        chosen.kind::<robots::policy::Policies>(Algorithms),
        chosen.kind::<robots::declare::Declares>(Algorithms),
        chosen.kind::<robots::declare::BeliefRules>(Algorithms),
        within(Algorithms, "Eyes (rheotaxis segment, and a verifier's fields)", eyes::vision::CATALOGUE),
        within(Algorithms, "Guidance", robots::guide::CATALOGUE),
        fixed(Algorithms, "Estimators", EntryNames::Choice, robots::estimate::CATALOGUE),
        within(Algorithms, "Autopilots", robots::actuate::CATALOGUE),
        chosen.kind::<robots::track::GantryStrategies>(Algorithms),
        within(Algorithms, "Units of the Crab tracker, by their fields", robots::track::UNITS),
        within(Algorithms, "Readings of the Crab tracker's paper, by their fields", robots::track::READINGS),
        within(Algorithms, "Objects in a sidescan's picture", eyes::sidescan::CATALOGUE),
        chosen.kind::<plumes::flow::Currents>(Flows),
        within(Flows, "What turns the flows (water: …)", plumes::flow::OPTIONS),
        Section { named: EntryNames::Field, ..chosen.kind::<robots::sense::Sensors>(Sensors) },
        fixed(Sensors, "Sensors of a gantry", EntryNames::Field, robots::sense::PARTS),
        fixed(Vehicles, "Vehicles and gantries", EntryNames::Choice, robots::vehicles::CATALOGUE),
        chosen.kind::<Apparatuses>(Vehicles),
    ];
    let mut sections: Vec<Section> = Vec::new();
    for next in all.into_iter().filter(|s| !s.entries.is_empty()) {
        match sections.last_mut() {
            Some(last) if last.heading == next.heading => last.entries.extend(next.entries),
            _ => sections.push(next),
        }
    }
    sections
}

/// All topics of a run: its own, those of each kind of apparatus, those that a registry carries.
pub fn topics(registry: &Registry) -> Vec<Topic> {
    let own = [run::CLOCK, auv::topics::TOPICS, gantry::topics::TOPICS, run::RUN];
    own.into_iter().flatten().chain(registry.carried()).copied().collect()
}

/// The JSON messages of a frame, with their keys below `rheotaxis/<run>/`: those of each robot, those of each gantry,
/// and what systems have published.
pub fn messages(frame: &Frame) -> Vec<(String, Value)> {
    let robot = |r| auv::message::messages(frame.t_s, r, &frame.abnormal);
    let gantry = |g| gantry::message::messages(frame.t_s, g);
    let published = |p: &TopicValue| {
        let key: Vec<String> = p.key.split('/').map(chunk).collect();
        (key.join("/"), p.value.clone())
    };
    let robots = frame.robots.iter().flat_map(robot);
    let gantries = frame.gantries.iter().flat_map(gantry);
    let published = frame.published.iter().map(published);
    robots.chain(gantries).chain(published).collect()
}

/// Sections under a registry.
struct RegistrySections<'r>(&'r Registry);

impl RegistrySections<'_> {
    fn kind<K: Kind>(&self, group: Group) -> Section {
        Section { group, heading: K::HEADING, named: EntryNames::Choice, entries: self.0.entries::<K>() }
    }
}

fn fixed(group: Group, heading: &'static str, named: EntryNames, entries: &[Entry]) -> Section {
    Section { group, heading, named, entries: entries.to_vec() }
}

fn within(group: Group, heading: &'static str, entries: &[Entry]) -> Section {
    fixed(group, heading, EntryNames::Within, entries)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::CATALOG;
    use crate::testing::with;
    use robots::behave::{Behave, BehaviourParams, ReacquireSpec, Reacquires};
    use robots::error::RobotError;
    use robots::strategy::AmpSpec;
    use serde::{Deserialize, Serialize};
    use std::path::Path;
    use world::ranges::Positive;

    #[test]
    fn every_entry_has_a_name_a_sentence_and_a_source() {
        for section in sections(&Registry::default()) {
            assert!(!section.entries.is_empty(), "{} is empty", section.heading);
            for (i, e) in section.entries.iter().enumerate() {
                let said = [e.name, e.what, e.source];
                assert!(said.iter().all(|s| s.trim().len() > 2), "{e:?}");
                let twice = section.entries[..i].iter().any(|o| o.name == e.name);
                assert!(!twice, "{} is there twice", e.name);
            }
        }
    }

    #[test]
    fn topics_have_names_and_keys_of_their_own_and_every_field_is_explained() {
        let all = topics(&Registry::default());
        for (i, topic) in all.iter().enumerate() {
            let alike = |t: &&Topic| t.name == topic.name || t.key == topic.key;
            assert_eq!(all[..i].iter().find(alike), None);
            let (schema, fields) = (topic.schema(), topic.fields());
            for field in &fields {
                let what = schema["properties"][field]["description"].as_str();
                assert!(what.is_some_and(|what| what.ends_with('.')), "{}: {field}", topic.name);
            }
            assert!(topic.what().ends_with('.') && !fields.is_empty(), "{}", topic.name);
        }
    }

    /// An arm of the reproduction table or of a campaign is a use, too.
    #[test]
    fn every_entry_that_is_named_is_used_by_a_scenario() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let rows = ["tests/reference/rows", "scenarios/catalog/campaigns", "scenarios/catalog/arena"]
            .into_iter()
            .flat_map(|folder| std::fs::read_dir(root.join(folder)).expect("a folder of arms"))
            .map(|e| std::fs::read_to_string(e.expect("a row").path()).expect("text"));
        let own = CATALOG.iter().map(|t| t.text.to_string());
        let text: String = rows.chain(own).collect();
        for section in sections(&Registry::default()) {
            for e in &section.entries {
                // An arm names a field by its path.
                let uses = match section.named {
                    EntryNames::Choice => vec![format!("{}(", e.name)],
                    EntryNames::Field => vec![format!("{}: (", e.name), format!(".{}\"", e.name)],
                    EntryNames::Within => continue,
                };
                // A folder of one's own is no part of the program; `docs/vehicles.md` makes one.
                let elsewhere = e.name == "File";
                assert!(elsewhere || uses.iter().any(|u| text.contains(u)), "no scenario uses {}", e.name);
            }
        }
    }

    /// A behaviour of somebody else.
    #[derive(Clone, Debug, PartialEq, Serialize, Deserialize, schemars::JsonSchema)]
    #[serde(deny_unknown_fields, default)]
    struct Spiral {
        turn_m: Positive,
    }

    impl Default for Spiral {
        fn default() -> Self {
            Self { turn_m: Positive::new(8.0) }
        }
    }

    impl Listed for Spiral {
        const ENTRY: Entry = Entry { name: "Spiral", what: "reacquire: in a spiral", source: "ours" };
    }

    impl BehaviourParams for Spiral {
        fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
            (ReacquireSpec::default()).build()
        }
    }

    #[test]
    fn a_scenario_may_ask_for_what_another_crate_adds() {
        let registry = Registry::default().with::<Reacquires, Spiral>();
        let registry = registry.expect("a new name");
        let place = "robots[0].strategy.reacquire";
        let own = with(&registry, "duck_st", &[(place, "Spiral(turn_m: 5)")]).expect("legal");
        let amp = own.scenario.robots[0].strategy.get::<AmpSpec>().expect("Amp");
        assert_eq!(amp.reacquire, ReacquireSpec::new(Spiral { turn_m: Positive::new(5.0) }));
        for (registry, value, says) in [
            (&Registry::default(), "Spiral(turn_m: 5)", ": there is no choice `Spiral`"),
            (&registry, "Spiral(turn_m: -5)", ".turn_m: must be > 0, got -5"),
            (&registry, "Spiral(turns_m: 5)", ": there is no field `turns_m`"),
        ] {
            let refused = with(registry, "duck_st", &[(place, value)]).expect_err("not legal").lines();
            assert!(refused.len() == 1 && refused[0].ends_with(&format!("{place}{says}")), "{refused:?}");
        }
    }
}
