//! Which seeds the rows have: those that `rheotaxis run --seed` takes.

use super::{ends, folder, folder_of, rows};
use crate::common::{self, says};
use studies::campaign::RunRow;
use world::seeds::key;

#[test]
fn a_row_is_the_run_of_its_seed_digest_and_all() {
    let one = folder(2, 30.0, 4.0);
    let other = folder_of("Literal(first: 101, count: 2)", 30.0, 4.0);
    let ran = |dir: &std::path::Path| {
        let (_, said) = ends(dir, 0, &["run", "c.ron", "--out", "out", "--quiet"]);
        assert_eq!(said, "");
        rows(&dir.join("out"))
    };
    let of_one = ran(one.path());
    let dir = other.path();
    let of_other = ran(dir);
    let seeds = |rows: &[RunRow]| rows.iter().map(|r| r.seed).collect::<Vec<_>>();
    assert_eq!(seeds(&of_one), [1, 1, 2, 2, 1, 1, 2, 2]);
    assert_eq!(seeds(&of_other), [101, 101, 102, 102, 101, 101, 102, 102]);
    for row in [&of_one[2], &of_one[5], &of_other[3]] {
        let rate = row.condition.strip_prefix("sources[0].rate_g_s=").unwrap();
        let speed = if row.arm == "slow" { "1.2" } else { "1.5" };
        let values = [("sources[0].rate_g_s", rate), ("robots[0].strategy.speed_m_s", speed)];
        let by_hand = common::lasting(common::scenario("uniform_channel", &values), 30.0, 4.0);
        common::write(dir, "by_hand.ron", &by_hand);
        let seed = row.seed.to_string();
        let args = ["run", "by_hand.ron", "--seed", &seed, "--out", "by_hand", "--no-zenoh", "--no-record", "--quiet"];
        let end = common::rheotaxis_in(dir, &args);
        assert!(matches!(end.code, Some(0 | 3)), "{end:?}");
        assert_eq!(common::digest(&dir.join("by_hand")), row.digest, "run {}", row.run);
    }
    for command in ["status", "report"] {
        says(&ends(dir, 0, &[command, "out"]).0, &["seeds 101 to 102"]);
    }
    let read = |file: &str| std::fs::read_to_string(dir.join(file)).unwrap();
    says(&read("out/report/report.html"), &["Two speeds", "robots[0].strategy.speed_m_s=1.2"]);
    says(&read("out/campaign.json"), &["seeds 101 to 102"]);
}

#[test]
fn hashed_seeds_are_others_under_each_condition() {
    let folder = folder_of("Hashed(seed: 7, count: 2)", 30.0, 1.0);
    let dir = folder.path();
    let run = ["run", "c.ron", "--out", "out", "--quiet"];
    ends(dir, 0, &run);
    for row in &rows(&dir.join("out")) {
        let condition = format!("condition {}", row.run / 4);
        assert_eq!(row.seed, key(7, &condition, &format!("seed {}", row.seed_index)));
    }
    // A folder whose manifest lacks what only people read is gone on with.
    let manifest = dir.join("out/campaign.json");
    let mut json: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&manifest).unwrap()).unwrap();
    for field in ["seeds", "sealed"] {
        json.as_object_mut().unwrap().remove(field);
    }
    std::fs::write(&manifest, json.to_string()).unwrap();
    ends(dir, 0, &run);
    ends(dir, 0, &["status", "out"]);
}
