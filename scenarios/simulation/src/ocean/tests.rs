//! What counts as another ocean, and what does not: every field of a scenario, found in what is written of it.

use super::origin::Origin;
use crate::scenario::Scenario;
use crate::scenario::load;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::path::Path;
use world::obstacles::ObstacleSpec;

/// Blocks and fields that water and plume follow from.
const COUNT: [&str; 9] = [
    "area",
    "terrain",
    "water",
    "obstacles",
    "permeable",
    "sources",
    "time.spin_up_s",
    "time.spin_up_period_s",
    "time.flow_period_s",
];
/// Those that only searchers, pictures and reports look at.
const DO_NOT: [&str; 11] = [
    "version",
    "title",
    "citation",
    "optics",
    "robots",
    "gantries",
    "success",
    "record",
    "time.step_s",
    "time.limit_s",
    "time.drift_period_s",
];

/// What may stand in a place in which nothing does, or a word.
fn others() -> Vec<Value> {
    vec![
        json!(0.25),
        json!(3),
        json!(true),
        json!("other"),
        json!({}),
        json!([[0.0, 1.0]]),
        json!("Depth"),
        json!({"cell_m": 3.0}),
        json!({"roughness_m": 0.002, "thickness_m": 1.5}),
    ]
}

/// Every place in `value` with what may stand there instead.
fn variations(value: &Value, path: &str, out: &mut Vec<(String, Vec<Value>)>) {
    let more = match value {
        Value::Null => others(),
        Value::Bool(b) => vec![json!(!b)],
        Value::Number(n) => {
            let x = n.as_f64().expect("a number");
            let whole = n.as_u64().map(|n| json!(n + 1));
            let moved = [x * 1.01 + 0.01, x * 0.99, x - 0.01].map(|x| json!(x));
            whole.into_iter().chain(moved).collect()
        }
        Value::String(s) => {
            let longer = std::iter::once(json!(format!("{s}x")));
            longer.chain(others()).collect()
        }
        Value::Array(items) => {
            for (n, item) in items.iter().enumerate() {
                variations(item, &format!("{path}/{n}"), out);
            }
            let twice = items.last().map(|last| {
                let mut items = items.clone();
                items.push(last.clone());
                Value::Array(items)
            });
            let one = others().into_iter().map(|other| json!([other]));
            twice.into_iter().chain(one).collect()
        }
        Value::Object(fields) => {
            for (name, field) in fields {
                let name = name.replace('~', "~0").replace('/', "~1");
                variations(field, &format!("{path}/{name}"), out);
            }
            return;
        }
    };
    out.push((path.to_string(), more));
}

/// Each place with the varied wholes that can be read, and whether one could.
fn varied<T: DeserializeOwned>(whole: &Value) -> Vec<(String, Vec<T>)> {
    let mut places = Vec::new();
    variations(whole, "", &mut places);
    let read = |(path, others): (String, Vec<Value>)| {
        let one = |other: Value| {
            let mut whole = whole.clone();
            *whole.pointer_mut(&path).expect("a place of it") = other;
            serde_json::from_value(whole).ok()
        };
        let all = others.into_iter().filter_map(one).collect();
        (path, all)
    };
    places.into_iter().map(read).collect()
}

/// `robots/0/start` → `robots`; `time/step_s` → `time.step_s`.
fn block(path: &str) -> String {
    let mut names = path[1..].split('/');
    let first = names.next().expect("a path has a first part");
    match (first, names.next()) {
        ("time", Some(field)) => format!("time.{field}"),
        _ => first.to_string(),
    }
}

#[test]
fn every_field_of_a_scenario_counts_or_is_said_not_to() {
    let mut seen = std::collections::BTreeSet::new();
    for name in ["reef_mesh", "harbour_3d", "duck_mt", "dalian_bay", "flume_crab", "wp_turbulent"] {
        let loaded = load(Path::new(name)).unwrap();
        let origin = Origin::from_scenario(&loaded.scenario, &loaded.base_dir, 7);
        let whole = serde_json::to_value(&loaded.scenario).unwrap();
        let as_it_is: Scenario = serde_json::from_value(whole.clone()).unwrap();
        let same = Origin::from_scenario(&as_it_is, &loaded.base_dir, 7);
        assert_eq!(origin.unlike(&same), None, "{name}");
        for (path, others) in varied::<Scenario>(&whole) {
            let block = block(&path);
            let counts = COUNT.contains(&block.as_str());
            assert!(
                counts != DO_NOT.contains(&block.as_str()),
                "{block}: say whether water or plume follow from it; if they do, Origin needs it"
            );
            for other in others.iter().filter(|other| **other != as_it_is) {
                let unlike = origin.unlike(&Origin::from_scenario(other, &loaded.base_dir, 7));
                assert_eq!(unlike.is_some(), counts, "{name}: {path} counts: {unlike:?}");
                // A file of another name is named as what is missing, not as where it is asked for.
                let named = unlike.is_none_or(|u| u == block || (block == "obstacles" && u == "files"));
                assert!(named, "{name}: {path}");
                seen.insert(block.clone());
            }
        }
    }
    for block in COUNT.iter().chain(&DO_NOT).filter(|b| **b != "version") {
        assert!(seen.contains(*block), "nothing of {block} was varied");
    }
}

#[test]
fn every_field_of_an_origin_counts() {
    let loaded = load(Path::new("reef_mesh")).unwrap();
    let origin = Origin::from_scenario(&loaded.scenario, &loaded.base_dir, 7);
    let whole = serde_json::to_value(&origin).unwrap();
    let mut varied_blocks = std::collections::BTreeSet::new();
    for (path, others) in varied::<Origin>(&whole) {
        for other in others {
            if serde_json::to_value(&other).unwrap() == whole {
                continue;
            }
            let differs = origin.unlike(&other).is_some() || origin.seed() != other.seed();
            assert!(differs, "{path}");
            varied_blocks.insert(path[1..].split('/').next().unwrap().to_string());
        }
    }
    let fields: Vec<_> = whole.as_object().unwrap().keys().cloned().collect();
    assert_eq!(varied_blocks.into_iter().collect::<Vec<_>>(), fields);
}

#[test]
fn a_file_of_the_same_name_with_other_contents_is_another_ocean() {
    let loaded = load(Path::new("reef_mesh")).unwrap();
    let file = loaded.scenario.obstacles.iter().find_map(ObstacleSpec::file).unwrap();
    let dir = tempfile::tempdir().unwrap();
    let origin = |base: &Path| Origin::from_scenario(&loaded.scenario, base, 7);
    let theirs = origin(&loaded.base_dir);
    assert_eq!(theirs.unlike(&origin(dir.path())).as_deref(), Some("files"));
    let copy = dir.path().join(file);
    std::fs::create_dir_all(copy.parent().unwrap()).unwrap();
    std::fs::copy(loaded.base_dir.join(file), &copy).unwrap();
    // Elsewhere, and the same.
    assert_eq!(theirs.unlike(&origin(dir.path())), None);
    let mut bytes = std::fs::read(&copy).unwrap();
    *bytes.last_mut().unwrap() ^= 1;
    std::fs::write(&copy, bytes).unwrap();
    assert_eq!(theirs.unlike(&origin(dir.path())).as_deref(), Some("files"));
}
