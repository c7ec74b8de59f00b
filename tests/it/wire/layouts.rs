//! Every topic, field and frame that a layout of `docs/layouts` names is in the recording of a run of its kind.

mod recording;

use crate::common::{mission, read, scenario};
use recording::Recording;
use rheotaxis::scenario::Loaded;
use serde_json::Value;
use std::collections::BTreeSet;

/// What a layout names.
#[derive(Debug, Default)]
struct Named {
    /// Topics that are drawn or listed, each with a colour field of its points.
    topics: BTreeSet<(String, Option<String>)>,
    /// Message paths of plots and state transitions.
    paths: BTreeSet<String>,
    /// Frames that a view follows, and beginnings of the names of links.
    frames: BTreeSet<String>,
}

fn text(value: &Value) -> String {
    value.as_str().expect("a text").to_owned()
}

/// Panels whose names stand in a tree of splits.
fn placed(tree: &Value, into: &mut BTreeSet<String>) {
    match tree {
        Value::String(name) => drop(into.insert(name.clone())),
        other => ["first", "second"].iter().for_each(|side| placed(&other[side], into)),
    }
}

fn named(layout: &Value) -> Named {
    let mut all = Named::default();
    let panels = layout["configById"].as_object().expect("panels");
    let mut shown = BTreeSet::new();
    placed(&layout["layout"], &mut shown);
    assert_eq!(shown, panels.keys().cloned().collect(), "panels and places");
    for (name, panel) in panels {
        match name.split('!').next().expect("a kind") {
            "3D" => {
                for (topic, settings) in panel["topics"].as_object().expect("topics") {
                    let field = settings.get("colorField").map(text);
                    all.topics.insert((topic.clone(), field));
                }
                for layer in panel["layers"].as_object().expect("layers").values() {
                    match layer["layerId"].as_str() {
                        Some("foxglove.Urdf") => {
                            all.topics.insert((text(&layer["topic"]), None));
                            let prefix = text(&layer["framePrefix"]);
                            all.frames.insert(prefix);
                        }
                        Some("foxglove.Grid") => drop(all.frames.insert(text(&layer["frameId"]))),
                        other => panic!("{name}: layer {other:?}"),
                    }
                }
                all.frames.insert(text(&panel["followTf"]));
            }
            "Plot" | "StateTransitions" => {
                let paths = panel["paths"].as_array().expect("paths");
                // A number is a line at that height.
                let paths = paths.iter().map(|p| text(&p["value"]));
                all.paths.extend(paths.filter(|p| p.parse::<f64>().is_err()));
            }
            "RosOut" => drop(all.topics.insert((text(&panel["topicToRender"]), None))),
            "Image" => {
                let topic = text(&panel["imageMode"]["imageTopic"]);
                all.topics.insert((topic, None));
            }
            other => panic!("{name}: no panel {other}"),
        }
    }
    all
}

/// The recording of a run.
fn recorded(loaded: &Loaded) -> Recording {
    let dir = tempfile::tempdir().expect("a folder");
    mission(dir.path(), "s", &loaded.text());
    Recording::read(&dir.path().join("s/run.mcap"))
}

/// Runs a scenario of the catalogue, changed, and looks up what the layout names.
fn holds(layout: &str, name: &str, values: &[(&str, &str)]) {
    let recording = recorded(&scenario(name, values));
    let layout: Value = serde_json::from_str(&read(&format!("docs/layouts/{layout}"))).expect("JSON");
    let named = named(&layout);
    assert!(named.topics.len() > 4 && named.paths.len() > 4, "{named:?}");
    for (topic, field) in &named.topics {
        let clouds = recording.messages(topic);
        assert!(clouds > 0, "{topic} is not in {:#?}", recording.topics());
        if let Some(field) = field {
            let fields = recording.cloud_fields(topic);
            assert!(fields.contains(field), "{topic} has {fields:?}, not {field}");
        }
    }
    for path in &named.paths {
        if let Err(why) = recording.resolves(path) {
            panic!("{path}: {why}");
        }
    }
    let frames = recording.frames();
    for frame in &named.frames {
        let known = match frame.strip_suffix('/') {
            Some(_) => frames.iter().any(|f| f.starts_with(frame)),
            None => frames.contains(frame),
        };
        assert!(known, "{frame} is not in {frames:#?}");
    }
}

/// Echoes of the ranging are recorded as they are heard.
#[test]
fn a_recording_holds_the_pings_of_the_ranging() {
    let recording = recorded(&scenario("bluerov_harbour", &[("time.limit_s", "100")]));
    // Two pings a second.
    let pings = recording.messages("/rov0/ranging");
    assert!((190..=200).contains(&pings), "{pings}");
}

#[test]
fn the_layout_of_a_vehicle_names_what_its_recording_holds() {
    holds("auv.json", "uniform_channel", &[]);
}

#[test]
fn the_layout_of_a_gantry_names_what_its_recording_holds() {
    holds("gantry.json", "flume_crab", &[]);
}

#[test]
fn the_layout_of_a_map_names_what_its_recording_holds() {
    holds("map.json", "wp_laminar", &[]);
}

#[test]
fn the_layout_of_a_survey_names_what_its_recording_holds() {
    // What the pictures show does not matter here.
    let small = [("robots[0].sensors.camera.width", "160"), ("robots[0].sensors.camera.height", "120")];
    holds("survey.json", "eyes_over_source", &small);
}
