//! What counts as another ocean, and what does not: every field of a scenario, found in what is written of it.

use super::origin::Origin;
use crate::scenario::{Node, Outline, Scenario, load};
use ron::extensions::Extensions;
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::path::Path;
use world::obstacles::ObstacleSpec;
use world::registry::Registry;

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
const OTHERS: [&str; 9] = [
    "0.25",
    "3",
    "true",
    "\"other\"",
    "()",
    "[(0.0, 1.0)]",
    "Depth",
    "(cell_m: 3.0)",
    "(roughness_m: 0.002, thickness_m: 1.5)",
];

/// What may stand in the place of a value; nothing for one that holds others, except a list.
fn variations(value: &str, last: Option<&str>) -> Vec<String> {
    let others = || OTHERS.iter().map(|other| (*other).to_string());
    if let Ok(x) = value.parse::<f64>() {
        let whole = value.parse::<u64>().ok().map(|n| (n + 1).to_string());
        let moved = [x * 1.01 + 0.01, x * 0.99, x - 0.01].map(|x| format!("{x:?}"));
        return whole.into_iter().chain(moved).collect();
    }
    match value {
        "true" => vec!["false".to_string()],
        "false" => vec!["true".to_string()],
        list if list.starts_with('[') => {
            let twice = last.map(|last| format!("{},{last}]", list.trim_end_matches([']', ','])));
            let twice = twice.map(|twice| twice.replacen(",,", ",", 1));
            twice.into_iter().chain(others().map(|other| format!("[{other}]"))).collect()
        }
        text if text.starts_with('"') => {
            let longer = format!("{}x\"", &text[..text.len() - 1]);
            std::iter::once(longer).chain(others()).collect()
        }
        word if word.contains('(') || word.starts_with('{') => Vec::new(),
        _ => others().collect(),
    }
}

/// A value as it is written in RON.
fn written(value: &impl Serialize) -> String {
    let extensions = Extensions::IMPLICIT_SOME | Extensions::UNWRAP_VARIANT_NEWTYPES;
    let options = ron::Options::default().with_default_extension(extensions);
    options.to_string(value).expect("plain data")
}

/// Each place that is asked for with two varied wholes that can be read.
fn varied<T: DeserializeOwned>(whole: &str, asked: impl Fn(&str) -> bool) -> Vec<(String, Vec<T>)> {
    // A name with a point is written with `r#`.
    let outline = Outline::scan(&whole.replace("r#time.", "time___"));
    let read = |node: &Node| {
        let value = &whole[node.value.clone()];
        let inner = |n: &&Node| node.value.start < n.whole.start && n.whole.end < node.value.end;
        let last = outline.nodes.iter().filter(inner).filter(|n| n.path.ends_with(']')).max_by_key(|n| n.whole.end);
        let last = last.map(|n| &whole[n.whole.clone()]);
        let one = |other: String| {
            let mut whole = whole.to_string();
            whole.replace_range(node.value.clone(), &other);
            Registry::default().read(&whole).ok()
        };
        (node.path.clone(), variations(value, last).into_iter().filter_map(one).take(2).collect())
    };
    outline.nodes.iter().filter(|node| asked(&node.path)).map(read).collect()
}

/// `robots[0].start` → `robots`; `time.step_s` as it is.
fn block(path: &str) -> String {
    let first = path.split(['.', '[']).next().expect("a path has a first part");
    if first == "time" { path.to_string() } else { first.to_string() }
}

#[test]
fn every_field_of_a_scenario_counts_or_is_said_not_to() {
    let mut seen = std::collections::BTreeSet::new();
    // What a field of a searcher changes, one scenario shows for all.
    let mut shown = std::collections::BTreeSet::new();
    for name in ["reef_mesh", "harbour_3d", "duck_mt", "dalian_bay", "flume_crab", "wp_turbulent"] {
        let loaded = load(Path::new(name)).unwrap();
        let origin = Origin::from_scenario(&loaded.scenario, &loaded.base_dir, 7);
        let whole = written(&loaded.scenario);
        let as_it_is: Scenario = Registry::default().read(&whole).unwrap();
        let same = Origin::from_scenario(&as_it_is, &loaded.base_dir, 7);
        assert_eq!(origin.unlike(&same), None, "{name}");
        let asked = |path: &str| COUNT.contains(&block(path).as_str()) || !shown.contains(path);
        for (path, others) in varied::<Scenario>(&whole, asked) {
            let block = block(&path);
            if others.is_empty() {
                continue;
            }
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
                shown.insert(path.clone());
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
    let whole = written(&origin);
    let mut varied_blocks = std::collections::BTreeSet::new();
    for (path, others) in varied::<Origin>(&whole, |_| true) {
        for other in others {
            if written(&other) == whole {
                continue;
            }
            let differs = origin.unlike(&other).is_some() || origin.seed() != other.seed();
            assert!(differs, "{path}");
            varied_blocks.insert(block(&path).replace("time___", "time."));
        }
    }
    let fields = serde_json::to_value(&origin).unwrap();
    let fields: Vec<_> = fields.as_object().unwrap().keys().cloned().collect();
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
