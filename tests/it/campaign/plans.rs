//! What a campaign's plan says, and which share of it a process does.

use super::{blocks, ends, folder};
use crate::common::{self, Ended, says};
use std::fs;
use studies::campaign::block_path;

#[test]
fn a_plan_counts_and_a_mistaken_arm_is_named_before_anything_runs() {
    let folder = folder(3, 30.0, 1.0);
    let dir = folder.path();
    let (said, _) = ends(dir, 0, &["plan", "c.ron", "--block", "5"]);
    let counts = ["12 runs: 2 arms x 2 conditions x 3 seeds on pond", "2 blocks of 6 runs", "seeds 1 to 3"];
    says(&said, &counts);
    let values = ["run --seed 1", "robots[0].strategy.speed_m_s=1.2", "sources[0].rate_g_s=0.04", "first run took"];
    says(&said, &values);
    let text = fs::read_to_string(dir.join("c.ron")).unwrap();
    fs::write(dir.join("c.ron"), text.replace("\"1.2\"", "\"-1\"")).unwrap();
    for args in [&["plan", "c.ron"][..], &["run", "c.ron", "--out", "out"]] {
        says(&ends(dir, 1, args).1, &["pond (arm slow, sources[0].rate_g_s=0.02)", "speed_m_s", "got -1"]);
    }
    assert!(!dir.join("out").exists());
}

#[test]
fn the_share_is_read_from_the_scheduler() {
    let folder = folder(2, 30.0, 1.0);
    let dir = folder.path();
    let args = ["campaign", "run", "c.ron", "--out", "out", "--block", "2", "--quiet"];
    let run = |variables: &[(&str, &str)]| Ended::of(common::command(dir, &args).envs(variables.iter().copied()));
    let array = |id| [("SLURM_ARRAY_TASK_ID", id), ("SLURM_ARRAY_TASK_MIN", "1"), ("SLURM_ARRAY_TASK_COUNT", "3")];
    run(&array("2")).with(0);
    assert_eq!(blocks(&dir.join("out")).len(), 1);
    assert!(block_path(&dir.join("out"), 1).is_file());
    run(&array("1")).with(0);
    assert_eq!(blocks(&dir.join("out")).len(), 3);
    says(&run(&[("JOB_COMPLETION_INDEX", "0")]).with(1).err, &["JOB_COMPLETIONS"]);
}
