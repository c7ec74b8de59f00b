//! Blocks in every state, and thousands of damaged ones.

use super::*;
use crate::campaign::report::sample::row;
use crate::campaign::{Campaign, load, merge, read_rows};
use world::seeds::Stream;

fn campaign() -> Campaign {
    load(Path::new("uniform_beta")).unwrap()
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
            ..row(
                place.seed_index,
                run.is_multiple_of(3).then_some((run as f64, 0.1)),
            )
        }
    };
    runs.map(one).collect()
}

/// A folder of blocks of 8 runs with its manifest; if not sealed, as an older program wrote it.
fn folder(sealed: bool) -> (tempfile::TempDir, Manifest) {
    let dir = tempfile::tempdir().unwrap();
    let manifest = Manifest {
        sealed,
        ..Manifest::new(&campaign(), 8)
    };
    manifest.write(dir.path()).unwrap();
    (dir, manifest)
}

#[test]
fn a_block_grows_row_by_row_and_never_shrinks() {
    let ((dir, manifest), campaign) = (folder(true), campaign());
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
    assert_eq!(merge(dir, &dir.join("all.parquet"), None).unwrap().rows, 10);
    // Rows of another block, or no rows at all, are no part of this one.
    for odd in [rows(&campaign, 0..2), rows(&campaign, 14..18), Vec::new()] {
        write_block(dir, 1, &odd).unwrap();
        assert!(matches!(state(), BlockState::Broken(_)), "{odd:?}");
    }
}

#[test]
fn what_is_read_follows_from_what_is_there_not_from_what_is_planned() {
    let ((dir, manifest), campaign) = (folder(true), campaign());
    let dir = dir.path();
    for block in [4, 0] {
        write_block(dir, block, &rows(&campaign, manifest.runs_of(block))).unwrap();
    }
    for name in [
        "part-1.parquet",
        "part-000002.parquet.tmp",
        "part-000099.parquet",
    ] {
        fs::write(dir.join(name), "").unwrap();
    }
    assert_eq!(present(dir, &manifest).unwrap(), [0, 4]);
    let many = Manifest {
        runs: 1 << 40,
        block: 1,
        ..manifest
    };
    assert_eq!(present(dir, &many).unwrap(), [0, 4, 99]);
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_said_and_never_waited_for_nor_replaced() {
    let ((dir, manifest), campaign) = (folder(true), campaign());
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
        assert!(
            said.contains("part-000000.parquet is not whole: it is a pipe, not a file"),
            "{said}"
        );
        let write = write_block(dir.path(), 0, &rows(&campaign, 0..8));
        assert!(
            write
                .unwrap_err()
                .to_string()
                .contains("it is a pipe, and only a regular file is replaced")
        );
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
        let from = if draw.uniform() < 0.5 {
            n - n.min(1500)
        } else {
            0
        };
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

/// Reads `n` damaged blocks. Returns how many of them are reported as not whole; the others are unchanged.
fn survives(sealed: bool, n: u64, seed: u64) -> u64 {
    let ((dir, manifest), campaign) = (folder(sealed), campaign());
    let (dir, path) = (dir.path(), block_path(dir.path(), 0));
    let good = rows(&campaign, 0..8);
    write_block(dir, 0, &good).unwrap();
    let mut bytes = fs::read(&path).unwrap();
    if !sealed {
        // As an older program wrote it: nothing between Parquet's mark and the first column is ever looked at.
        bytes[4..4 + seal::room().len()].fill(b' ');
        fs::write(&path, &bytes).unwrap();
        assert!(matches!(read_block(dir, &manifest, 0), BlockState::Done(there) if there == good));
    }
    let mut draw = Stream::new(seed, "damage", "of blocks");
    let mut broken = 0;
    for k in 0..n {
        fs::write(&path, damaged(&bytes, &mut draw)).unwrap();
        match read_block(dir, &manifest, 0) {
            BlockState::Broken(said) => {
                assert!(said.to_string().contains("part-000000.parquet"), "{said}");
                broken += 1;
            }
            BlockState::Done(there) => assert_eq!(there, good, "damage {k}"),
            BlockState::Part(_) | BlockState::Missing => panic!("damage {k} is no part"),
        }
    }
    broken
}

/// For more: `RHEOTAXIS_DAMAGES=100000 cargo test --release -p studies --lib damaged_blocks`.
#[test]
fn damaged_blocks_are_not_whole_whatever_the_library_does() {
    let n = std::env::var("RHEOTAXIS_DAMAGES").ok();
    let n: u64 = n.and_then(|n| n.parse().ok()).unwrap_or(1000);
    assert!(survives(true, n, 1) >= n * 99 / 100);
    // Without a seal, the library reads whatever bytes it gets, and its panics count as answers.
    assert!(survives(false, n, 2) >= n * 9 / 10);
}
