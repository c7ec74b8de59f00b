//! Which seeds the rows have: those that `rheotaxis run --seed` takes.

use super::{ends, folder, rows};
use crate::common;
use rheotaxis::scenario::set_value;
use std::fs;
use std::path::Path;
use studies::campaign::RunRow;
use world::seeds::key;

fn with_seeds(dir: &Path, file: &str, seeds: &str) {
    let text = fs::read_to_string(dir.join("c.ron")).unwrap();
    fs::write(dir.join(file), text.replace("seeds: 2", seeds)).unwrap();
}

fn ran(dir: &Path, file: &str, out: &str) -> (Vec<RunRow>, String) {
    let (_, said) = ends(dir, 0, &["run", file, "--out", out, "--quiet"]);
    (rows(&dir.join(out)), said)
}

#[test]
fn a_row_is_the_run_of_its_seed_digest_and_all() {
    let folder = folder(2, "30", "4");
    let dir = folder.path();
    with_seeds(dir, "other.ron", "seeds: Literal(first: 101, count: 2)");
    let (one, _) = ran(dir, "c.ron", "one");
    let (other, said) = ran(dir, "other.ron", "other");
    assert_eq!(said, "");
    let seeds = |rows: &[RunRow]| rows.iter().map(|r| r.seed).collect::<Vec<_>>();
    assert_eq!(seeds(&one), [1, 1, 2, 2, 1, 1, 2, 2]);
    assert_eq!(seeds(&other), [101, 101, 102, 102, 101, 101, 102, 102]);
    let pond = fs::read_to_string(dir.join("pond.ron")).unwrap();
    for row in [&one[2], &one[5], &other[3]] {
        let rate = row.condition.strip_prefix("sources[0].rate_g_s=").unwrap();
        let mut text = set_value(&pond, "sources[0].rate_g_s", rate).unwrap();
        if row.arm == "slow" {
            text = set_value(&text, "robots[0].strategy.speed_m_s", "1.2").unwrap();
        }
        fs::write(dir.join("by_hand.ron"), text).unwrap();
        let seed = row.seed.to_string();
        let args = ["run", "by_hand.ron", "--seed", &seed, "--out", "by_hand", "--no-zenoh", "--no-record", "--quiet"];
        let end = common::rheotaxis_in(dir, &args);
        assert!(matches!(end.status.code(), Some(0 | 3)), "{end:?}");
        let summary = fs::read_to_string(dir.join("by_hand/summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        assert_eq!(summary["digest"], row.digest.as_str(), "run {}", row.run);
    }
    let (said, _) = ends(dir, 0, &["status", "other"]);
    assert!(said.contains("seeds 101 to 102"), "{said}");
    let (said, _) = ends(dir, 0, &["report", "other"]);
    assert!(said.starts_with("Two speeds\n") && said.contains("seeds 101 to 102"), "{said}");
    let page = fs::read_to_string(dir.join("other/report/report.html")).unwrap();
    assert!(page.contains("<h1>Two speeds</h1>"), "{page}");
    assert!(page.contains("<td>slow</td><td>robots[0].strategy.speed_m_s=1.2</td>"));
    let manifest = fs::read_to_string(dir.join("other/campaign.json")).unwrap();
    assert!(manifest.contains("\"seeds\": \"seeds 101 to 102\""), "{manifest}");
}

#[test]
fn hashed_seeds_are_others_under_each_condition() {
    let folder = folder(2, "30", "1");
    let dir = folder.path();
    with_seeds(dir, "hashed.ron", "seeds: Hashed(seed: 7, count: 2)");
    let (rows, said) = ran(dir, "hashed.ron", "hashed");
    assert_eq!(said, "");
    for row in &rows {
        let condition = format!("condition {}", row.run / 4);
        assert_eq!(row.seed, key(7, &condition, &format!("seed {}", row.seed_index)));
    }
    // A folder whose manifest lacks what only people read is gone on with.
    let manifest = dir.join("hashed/campaign.json");
    let mut json: serde_json::Value = serde_json::from_str(&fs::read_to_string(&manifest).unwrap()).unwrap();
    for field in ["seeds", "sealed"] {
        json.as_object_mut().unwrap().remove(field);
    }
    fs::write(&manifest, json.to_string()).unwrap();
    ends(dir, 0, &["run", "hashed.ron", "--out", "hashed", "--quiet"]);
    ends(dir, 0, &["status", "hashed"]);
}
