//! What a campaign's plan says, and which share of it a process does.

use super::{blocks, ends, folder, scheduler_free};
use crate::common;
use std::fs;
use studies::campaign::block_path;

#[test]
fn a_plan_counts_and_a_mistaken_arm_is_named_before_anything_runs() {
    let folder = folder(3, "30", "1");
    let dir = folder.path();
    let (said, _) = ends(dir, 0, &["plan", "c.ron", "--block", "5"]);
    for part in [
        "c: Two speeds\n  12 runs: 2 arms x 2 conditions x 3 seeds on pond\n  2 blocks of 6 runs\n  seeds 1 to 3\n",
        "  run 0 is `rheotaxis run --seed 1` of pond with the values of arm slow and its condition\n",
        "  arm slow: robots[0].strategy.speed_m_s=1.2\n  arm fast: as it is\n",
        "  condition 1: sources[0].rate_g_s=0.04\n",
        "the first run took",
    ] {
        assert!(said.contains(part), "{said}");
    }
    let text = fs::read_to_string(dir.join("c.ron")).unwrap();
    fs::write(dir.join("c.ron"), text.replace("\"1.2\"", "\"-1\"")).unwrap();
    for args in [&["plan", "c.ron"][..], &["run", "c.ron", "--out", "out"]] {
        let (_, said) = ends(dir, 1, args);
        assert!(said.contains("robots[0].strategy.speed_m_s: must be > 0, got -1"), "{said}");
        assert!(said.contains("pond (arm slow, sources[0].rate_g_s=0.02):"), "{said}");
    }
    assert!(!dir.join("out").exists());
}

#[test]
fn the_share_is_read_from_the_scheduler() {
    let folder = folder(2, "30", "1");
    let dir = folder.path();
    let args = ["campaign", "run", "c.ron", "--out", "out", "--block", "2", "--quiet"];
    let run = |variables: &[(&str, &str)]| {
        let mut command = scheduler_free(common::command(dir, &args));
        command.envs(variables.iter().copied());
        command.output().unwrap()
    };
    let array = |id| [("SLURM_ARRAY_TASK_ID", id), ("SLURM_ARRAY_TASK_MIN", "1"), ("SLURM_ARRAY_TASK_COUNT", "3")];
    assert!(run(&array("2")).status.success());
    assert_eq!(blocks(&dir.join("out")).len(), 1);
    assert!(block_path(&dir.join("out"), 1).is_file());
    assert!(run(&array("1")).status.success());
    assert_eq!(blocks(&dir.join("out")).len(), 3);
    let lost = run(&[("JOB_COMPLETION_INDEX", "0")]);
    assert_eq!(lost.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&lost.stderr).contains("set JOB_COMPLETIONS"));
}
