//! Arms that differ only in what the water passes through run each in its own water.

use super::{CAMPAIGN, ends, folder, rows};
use std::fs;
use std::path::Path;
use studies::campaign::RunRow;

const OPEN: &str = r#"(name: "open", set: [("permeable", "[\"block\"]")])"#;
const SOLID: &str = r#"(name: "solid")"#;

/// Rows of two seeds of these arms over a pond with a block in its stream.
fn rows_of(dir: &Path, arms: &[&str]) -> Vec<RunRow> {
    let name = format!("of_{}", arms.len());
    let from = CAMPAIGN.find("    arms: [").expect("it has arms");
    let head = CAMPAIGN[..from].replace("SEEDS", "2");
    let text = format!("{head}    arms: [{}],\n)\n", arms.join(", "));
    let file = format!("{name}.ron");
    fs::write(dir.join(&file), text).unwrap();
    let out = format!("{name}-{}", arms[0].len());
    ends(dir, 0, &["run", &file, "--out", &out, "--quiet", "--jobs", "1"]);
    rows(&dir.join(out))
}

#[test]
fn arms_that_differ_only_in_permeable_do_not_share_a_spin_up() {
    let folder = folder(1, "120", "4");
    let dir = folder.path();
    let pond = fs::read_to_string(dir.join("pond.ron")).unwrap();
    // 10 to 20 m down-stream of the source, which the dye passes within the spin-up.
    let block = r#"    obstacles: [(id: "block", shape: Box(size_m: (10, 30, 9)), east_m: -135, north_m: 0)],
    sources: ["#;
    let pond =
        pond.replace("    sources: [", block).replace("    water: (", "    water: (blockage: (cell_m: 5, levels: 6), ");
    fs::write(dir.join("pond.ron"), pond).unwrap();
    let both = rows_of(dir, &[SOLID, OPEN]);
    assert_eq!(both.len(), 4);
    for (n, arm) in [SOLID, OPEN].into_iter().enumerate() {
        let alone = rows_of(dir, &[arm]);
        for (seed, alone) in alone.into_iter().enumerate() {
            let with_other = both[2 * seed + n].clone();
            assert!(alone.error.is_none(), "{:?}", alone.error);
            let run = with_other.run;
            assert_eq!(with_other, RunRow { run, ..alone }, "{arm}");
        }
    }
    for pair in both.chunks(2) {
        assert_ne!(pair[0].digest, pair[1].digest);
    }
}
