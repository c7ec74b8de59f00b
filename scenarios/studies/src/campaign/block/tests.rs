//! Blocks in every state, and thousands of damaged ones.

use super::*;
use crate::campaign::report::sample::row;
use crate::campaign::{Campaign, load, merge, read_rows};
use std::ops::Range;
use world::registry::Registry;
use world::seeds::Stream;

fn campaign() -> Campaign {
    load(&Registry::default(), Path::new("uniform_beta")).unwrap()
}

fn declared(run: u64, number: u64) -> DeclarationRow {
    DeclarationRow {
        run,
        robot: "auv0".to_string(),
        number,
        rule: "AlongFlow".to_string(),
        verdict: "unchecked".to_string(),
        t_s: 100.0 * number as f64,
        east_m: run as f64,
        region: (number == 1).then_some(2),
        ..DeclarationRow::default()
    }
}

/// Rows of some runs, as if the runs had been made.
fn rows(campaign: &Campaign, runs: Range<u64>) -> Vec<RunRow> {
    let one = |run| {
        let place = campaign.place(run);
        RunRow {
            run,
            arm: campaign.arm(place.arm).name.clone(),
            condition: campaign.condition_name(place.condition),
            seed: place.seed.number(),
            error: (run == 3).then(|| "no water".to_string()),
            declarations: (0..run % 3).map(|number| declared(run, number)).collect(),
            ..row(place.seed_index, run.is_multiple_of(3).then_some((run as f64, 0.1)))
        }
    };
    runs.map(one).collect()
}

/// A folder of blocks of 8 runs with its manifest.
fn folder() -> (tempfile::TempDir, Manifest) {
    let dir = tempfile::tempdir().unwrap();
    let manifest = Manifest::new(&campaign(), 8);
    manifest.write(dir.path()).unwrap();
    (dir, manifest)
}

#[test]
fn a_block_grows_row_by_row_and_never_shrinks() {
    let ((dir, manifest), campaign) = (folder(), campaign());
    let dir = dir.path();
    let state = || read_block(dir, &manifest, 1);
    assert!(matches!(state(), BlockState::Missing));
    add_to_block(dir, &manifest, 1, &rows(&campaign, 10..12)).unwrap();
    assert!(matches!(state(), BlockState::Part(there) if there == rows(&campaign, 10..12)));
    add_to_block(dir, &manifest, 1, &rows(&campaign, 8..11)).unwrap();
    assert!(matches!(state(), BlockState::Part(there) if there == rows(&campaign, 8..12)));
    write_block(dir, 1, &rows(&campaign, 8..16)).unwrap();
    add_to_block(dir, &manifest, 1, &rows(&campaign, 8..9)).unwrap();
    assert!(matches!(state(), BlockState::Done(there) if there == rows(&campaign, 8..16)));
    // All readers treat the rows of a partial block as any others.
    write_block(dir, 0, &rows(&campaign, 2..4)).unwrap();
    let all = [rows(&campaign, 2..4), rows(&campaign, 8..16)].concat();
    assert_eq!(read_rows(dir).unwrap(), all);
    assert_eq!(merge(&Registry::default(), dir, &dir.join("all.parquet"), None).unwrap().rows, 10);
    // Rows of another block, or no rows at all, are no part of this one.
    for odd in [rows(&campaign, 0..2), rows(&campaign, 14..18), Vec::new()] {
        write_block(dir, 1, &odd).unwrap();
        assert!(matches!(state(), BlockState::Broken(_)), "{odd:?}");
    }
}

#[test]
fn what_is_read_follows_from_what_is_there_not_from_what_is_planned() {
    let ((dir, manifest), campaign) = (folder(), campaign());
    let dir = dir.path();
    for block in [4, 0] {
        write_block(dir, block, &rows(&campaign, manifest.runs_of(block))).unwrap();
    }
    for name in ["part-1.parquet", "part-000002.parquet.tmp", "part-000099.parquet"] {
        fs::write(dir.join(name), "").unwrap();
    }
    assert_eq!(present(dir, &manifest).unwrap(), [0, 4]);
    let many = Manifest { runs: 1 << 40, block: 1, ..manifest };
    assert_eq!(present(dir, &many).unwrap(), [0, 4, 99]);
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_said_and_never_waited_for_nor_replaced() {
    let ((dir, manifest), campaign) = (folder(), campaign());
    let path = block_path(dir.path(), 0);
    let pipe = std::process::Command::new("mkfifo").arg(&path).status();
    if !pipe.is_ok_and(|s| s.success()) {
        return;
    }
    for _ in 0..2 {
        let BlockState::Broken(said) = read_block(dir.path(), &manifest, 0) else {
            panic!("a pipe is no block");
        };
        let said = said.to_string();
        assert!(said.contains("part-000000.parquet is not whole: it is a pipe, not a file"), "{said}");
        let write = write_block(dir.path(), 0, &rows(&campaign, 0..8));
        assert!(write.unwrap_err().to_string().contains("it is a pipe, and only a regular file is replaced"));
    }
}

/// Bytes changed, removed, inserted, repeated or cut off, as disks and hands do it.
fn damaged(bytes: &[u8], draw: &mut Stream) -> Vec<u8> {
    let mut odd = bytes.to_vec();
    let at = |draw: &mut Stream, n: usize| (draw.uniform() * n as f64) as usize;
    for _ in 0..1 + at(draw, 3) {
        let n = odd.len();
        if n == 0 {
            break;
        }
        // Damage at the end, in the footer, does most harm.
        let from = if draw.uniform() < 0.5 { n - n.min(1500) } else { 0 };
        let k = from + at(draw, n - from);
        let length = 1 + at(draw, 8);
        let end = (k + length).min(n);
        match at(draw, 6) {
            0 => odd[k] = draw.bits() as u8,
            1 => odd[k] ^= 1 << at(draw, 8),
            2 => odd[k..end].fill(if draw.uniform() < 0.5 { 0 } else { 0xff }),
            3 => drop(odd.drain(k..end)),
            4 => {
                let piece = odd[k..end].to_vec();
                odd.splice(k..k, piece);
            }
            _ => odd.truncate(k),
        }
    }
    odd
}

/// Writes a new file: one that is replaced in place is waited for by some file systems.
fn anew(path: &Path, bytes: &[u8]) {
    fs::remove_file(path).unwrap();
    fs::write(path, bytes).unwrap();
}

/// Reads `n` blocks of which one file is damaged. Returns how many are reported as not whole; the others are unchanged.
fn survives(damage: fn(&Path, u64) -> PathBuf, n: u64, seed: u64) -> u64 {
    let ((dir, manifest), campaign) = (folder(), campaign());
    let (dir, path) = (dir.path(), damage(dir.path(), 0));
    let good = rows(&campaign, 0..8);
    write_block(dir, 0, &good).unwrap();
    let bytes = fs::read(&path).unwrap();
    let mut draw = Stream::new(seed, "damage", "of blocks");
    let mut broken = 0;
    for k in 0..n {
        anew(&path, &damaged(&bytes, &mut draw));
        match read_block(dir, &manifest, 0) {
            BlockState::Broken(said) => {
                let name = path.file_name().unwrap().to_str().unwrap();
                assert!(said.to_string().contains(name), "{said}");
                broken += 1;
            }
            BlockState::Done(there) => assert_eq!(there, good, "damage {k}"),
            BlockState::Part(_) | BlockState::Missing => panic!("damage {k} is no part"),
        }
    }
    broken
}

/// For more: `RHEOTAXIS_DAMAGES=100000 cargo test --release -p rheotaxis-studies --lib damaged_blocks`.
#[test]
fn damaged_blocks_are_not_whole() {
    let n = std::env::var("RHEOTAXIS_DAMAGES").ok();
    let n: u64 = n.and_then(|n| n.parse().ok()).unwrap_or(400);
    assert!(survives(block_path, n, 1) >= n * 99 / 100);
    assert!(survives(declarations_path, n, 2) >= n * 99 / 100);
}

/// Bytes whose seal fits them all the same: as if the program had written nonsense.
#[test]
fn damage_under_a_seal_is_an_answer_and_no_panic() {
    let ((dir, manifest), campaign) = (folder(), campaign());
    let dir = dir.path();
    let good = rows(&campaign, 0..8);
    for path in [block_path(dir, 0), declarations_path(dir, 0)] {
        write_block(dir, 0, &good).unwrap();
        let bytes = fs::read(&path).unwrap();
        let mut draw = Stream::new(3, "damage", "under seals");
        let mut broken = 0;
        for k in 0..400 {
            let head = 4 + seal::room().len();
            let mut odd = [&bytes[..4], &seal::room()].concat();
            odd.extend(damaged(&bytes[head..], &mut draw));
            seal::close(&mut odd);
            anew(&path, &odd);
            match read_block(dir, &manifest, 0) {
                BlockState::Broken(_) => broken += 1,
                BlockState::Done(there) => assert_eq!(there, good, "damage {k}"),
                BlockState::Part(_) | BlockState::Missing => panic!("damage {k} is no part"),
            }
        }
        // About a tenth changes only what is not read, such as the statistics of columns.
        assert!(broken >= 320, "{broken} at {}", path.display());
    }
}

#[test]
fn a_kill_between_the_two_files_loses_no_row() {
    let ((dir, manifest), campaign) = (folder(), campaign());
    let dir = dir.path();
    let (some, more) = (rows(&campaign, 8..12), rows(&campaign, 8..16));
    assert!(some.iter().any(|r| r.declarations.len() == 2));
    write_block(dir, 1, &some).unwrap();
    let before = fs::read(block_path(dir, 1)).unwrap();
    // The declarations of all eight runs are written, the rows of the last four are not.
    write_block(dir, 1, &more).unwrap();
    fs::write(block_path(dir, 1), before).unwrap();
    assert!(matches!(read_block(dir, &manifest, 1), BlockState::Part(there) if there == some));
    add_to_block(dir, &manifest, 1, &more).unwrap();
    assert!(matches!(read_block(dir, &manifest, 1), BlockState::Done(there) if there == more));
}

#[test]
fn rows_without_their_declarations_are_not_whole() {
    let ((dir, manifest), campaign) = (folder(), campaign());
    let dir = dir.path();
    let good = rows(&campaign, 0..8);
    let said = || match read_block(dir, &manifest, 0) {
        BlockState::Broken(error) => error.to_string(),
        other => panic!("{other:?}"),
    };
    write_block(dir, 0, &good).unwrap();
    let sound = fs::read(block_path(dir, 0)).unwrap();
    fs::remove_file(declarations_path(dir, 0)).unwrap();
    let missing = said();
    assert!(missing.ends_with("declarations-000000.parquet is not whole: it does not exist"), "{missing}");
    // Those of other rows: sound in themselves, but one is missing.
    let mut other = good.clone();
    other[2].declarations.pop();
    write_block(dir, 0, &other).unwrap();
    fs::write(block_path(dir, 0), sound).unwrap();
    let wrong = said();
    assert!(wrong.contains("its rows and declarations are not those"), "{wrong}");
    write_block(dir, 0, &good).unwrap();
    assert!(matches!(read_block(dir, &manifest, 0), BlockState::Done(there) if there == good));
}

#[test]
fn a_merge_has_a_line_for_every_declaration() {
    let ((dir, _), campaign) = (folder(), campaign());
    let dir = dir.path();
    let all = rows(&campaign, 0..16);
    write_block(dir, 0, &all[..8]).unwrap();
    write_block(dir, 1, &all[8..]).unwrap();
    let csv = dir.join("all.csv");
    let merged = merge(&Registry::default(), dir, &dir.join("all.parquet"), Some(&csv)).unwrap();
    let declarations: Vec<_> = all.iter().flat_map(|r| r.declarations.clone()).collect();
    assert_eq!((merged.rows, merged.declarations), (16, declarations.len() as u64));
    assert_eq!(merged.declarations_path, dir.join("all-declarations.parquet"));
    let file = fs::File::open(&merged.declarations_path).unwrap();
    let (back, _) = read::<DeclarationRow>(file, 1000).unwrap();
    assert_eq!(back, declarations);
    let [runs, lines] = as_csv(&all);
    assert_eq!(fs::read_to_string(csv).unwrap(), runs);
    assert_eq!(fs::read_to_string(dir.join("all-declarations.csv")).unwrap(), lines);
}
