//! What `rheotaxis explain` says of files and tables, and the pages in `docs` that are made from it.

use crate::common::{rheotaxis, root};
use output::{columns, report};
use std::fs;
use studies::campaign;

/// What `rheotaxis explain` prints, with whether it found something.
fn explained(what: &str) -> (bool, String) {
    let end = rheotaxis(&["explain", what]);
    let found = end.code == Some(0);
    (found, if found { end.out } else { end.err })
}

/// Compares a file of `docs` with what is made now. `RHEOTAXIS_BLESS=1` writes it.
fn is_up_to_date(name: &str, made: &str) {
    let file = root().join("docs").join(name);
    if std::env::var_os("RHEOTAXIS_BLESS").is_some() {
        fs::write(&file, made).unwrap();
    }
    let stored = fs::read_to_string(&file).unwrap_or_default();
    let differs = stored.lines().zip(made.lines()).position(|(a, b)| a != b);
    assert!(
        stored == made,
        "docs/{name} is out of date (first different line: {}): write it anew with \
         `RHEOTAXIS_BLESS=1 cargo test --release --test it -- explained`",
        differs.map_or(stored.lines().count().min(made.lines().count()), |i| i + 1)
    );
}

#[test]
fn the_pages_in_docs_are_up_to_date() {
    let tables = [report::tables(), campaign::tables()].concat();
    is_up_to_date("reference.md", &explained("--markdown").1);
    is_up_to_date("columns.md", &columns::markdown(&tables));
}

#[test]
fn the_schema_of_scenarios_is_printed() {
    let schema: serde_json::Value = serde_json::from_str(&explained("--json-schema").1).unwrap();
    for field in ["area", "water", "sources", "robots", "gantries"] {
        assert!(schema["properties"][field].is_object(), "no {field}");
    }
}

#[test]
fn campaigns_vehicles_and_tables_are_explained_as_a_scenario_is() {
    for (path, part) in [
        ("", "rheotaxis explain campaign"),
        ("robots[0].strategy.reacquire", "Bowtie"),
        ("vehicle.hydrodynamics", "volume_m3"),
        ("campaign", "\n  arms[]: list of (…); default []\n"),
        ("campaign.until.half_width", "value    number, > 0 to < 0.5\n"),
        ("campaign.seeds", "\n  number(whole number, 1 to 1.099511627776e12)\n"),
        ("campaign.seeds.Literal", "\n  first: whole number, >= 0; must be given\n"),
        ("campaign.conditions", "default  Single\n"),
        ("campaign.conditions.draw", "a path in the scenario and a distribution"),
        ("family.machine", "Gantry"),
        ("searchers.searchers[].privileged", "in no ranking"),
        ("track.csv", "\n  est_depth_m, m\n"),
        ("probes-crab0.csv", "\n  <probe>_threshold_v, V\n"),
        ("part-0001.parquet", "\n  traced_m, m\n"),
    ] {
        let (found, text) = explained(path);
        assert!(found && text.contains(part), "no {part:?} in\n{text}");
    }
    for (path, near) in
        [("robots.strategy.reaquire", "reacquire"), ("campaign.armes", "campaign.arms[]"), ("tracks.csv", "tracks.csv")]
    {
        let (found, text) = explained(path);
        assert!(!found && text.contains(near), "no {near:?} in\n{text}");
    }
}
