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

/// A folder of blocks of 8 runs with its manifest, and the campaign.
struct Blocks {
    dir: tempfile::TempDir,
    manifest: Manifest,
    campaign: Campaign,
}

impl Blocks {
    fn new() -> Self {
        let (dir, campaign) = (tempfile::tempdir().unwrap(), campaign());
        let manifest = Manifest::new(&campaign, 8);
        manifest.write(dir.path()).unwrap();
        Self { dir, manifest, campaign }
    }

    fn path(&self) -> &Path {
        self.dir.path()
    }

    fn rows(&self, runs: Range<u64>) -> Vec<RunRow> {
        rows(&self.campaign, runs)
    }

    fn state(&self, block: u64) -> BlockState {
        read_block(self.path(), &self.manifest, block)
    }

    /// What is said of the first block, which is not whole.
    fn broken(&self) -> String {
        match self.state(0) {
            BlockState::Broken(error) => error.to_string(),
            other => panic!("{other:?}"),
        }
    }

    fn write(&self, block: u64, rows: &[RunRow]) {
        write_block(self.path(), block, rows).unwrap();
    }

    fn add(&self, block: u64, rows: &[RunRow]) {
        add_to_block(self.path(), &self.manifest, block, rows).unwrap();
    }
}

#[test]
fn a_block_grows_row_by_row_and_never_shrinks() {
    let blocks = Blocks::new();
    let rows = |runs| blocks.rows(runs);
    assert!(matches!(blocks.state(1), BlockState::Missing));
    blocks.add(1, &rows(10..12));
    assert!(matches!(blocks.state(1), BlockState::Part(there) if there == rows(10..12)));
    blocks.add(1, &rows(8..11));
    assert!(matches!(blocks.state(1), BlockState::Part(there) if there == rows(8..12)));
    blocks.write(1, &rows(8..16));
    blocks.add(1, &rows(8..9));
    assert!(matches!(blocks.state(1), BlockState::Done(there) if there == rows(8..16)));
    // All readers treat the rows of a partial block as any others.
    blocks.write(0, &rows(2..4));
    assert_eq!(read_rows(blocks.path()).unwrap(), [rows(2..4), rows(8..16)].concat());
    let merged = merge(&Registry::default(), blocks.path(), &blocks.path().join("all.parquet"), None);
    assert_eq!(merged.unwrap().rows, 10);
    // Rows of another block, or no rows at all, are no part of this one.
    for odd in [rows(0..2), rows(14..18), Vec::new()] {
        blocks.write(1, &odd);
        assert!(matches!(blocks.state(1), BlockState::Broken(_)), "{odd:?}");
    }
}

#[test]
fn what_is_read_follows_from_what_is_there_not_from_what_is_planned() {
    let blocks = Blocks::new();
    for block in [4, 0] {
        blocks.write(block, &blocks.rows(blocks.manifest.runs_of(block)));
    }
    for name in ["part-1.parquet", "part-000002.parquet.tmp", "part-000099.parquet"] {
        fs::write(blocks.path().join(name), "").unwrap();
    }
    assert_eq!(present(blocks.path(), &blocks.manifest).unwrap(), [0, 4]);
    let many = Manifest { runs: 1 << 40, block: 1, ..blocks.manifest.clone() };
    assert_eq!(present(blocks.path(), &many).unwrap(), [0, 4, 99]);
}

#[cfg(unix)]
#[test]
fn what_is_no_regular_file_is_said_and_never_waited_for_nor_replaced() {
    let blocks = Blocks::new();
    let pipe = std::process::Command::new("mkfifo").arg(block_path(blocks.path(), 0)).status();
    if !pipe.is_ok_and(|s| s.success()) {
        return;
    }
    for _ in 0..2 {
        assert!(blocks.broken().contains("part-000000.parquet is not whole: it is a pipe"));
        let write = write_block(blocks.path(), 0, &blocks.rows(0..8));
        assert!(write.unwrap_err().to_string().contains("it is a pipe"));
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

type Damage = fn(&[u8], &mut Stream) -> Vec<u8>;

/// Reads `n` blocks of which one file is damaged. Returns how many are reported as not whole; the others are unchanged.
fn survives(path: fn(&Path, u64) -> PathBuf, n: u64, seed: u64, damage: Damage) -> u64 {
    let blocks = Blocks::new();
    let path = path(blocks.path(), 0);
    let good = blocks.rows(0..8);
    blocks.write(0, &good);
    let bytes = fs::read(&path).unwrap();
    let mut draw = Stream::new(seed, "damage", "of blocks");
    let mut broken = 0;
    for k in 0..n {
        // One that is replaced in place is waited for by some file systems.
        fs::remove_file(&path).unwrap();
        fs::write(&path, damage(&bytes, &mut draw)).unwrap();
        match blocks.state(0) {
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
    assert!(survives(block_path, n, 1, damaged) >= n * 99 / 100);
    assert!(survives(declarations_path, n, 2, damaged) >= n * 99 / 100);
}

/// Bytes whose seal fits them all the same: as if the program had written nonsense.
#[test]
fn damage_under_a_seal_is_an_answer_and_no_panic() {
    let sealed: Damage = |bytes, draw| {
        let head = 4 + seal::room().len();
        let mut odd = [&bytes[..4], &seal::room(), &damaged(&bytes[head..], draw)].concat();
        seal::close(&mut odd);
        odd
    };
    for path in [block_path, declarations_path] {
        // About a tenth changes only what is not read, such as the statistics of columns.
        let broken = survives(path, 400, 3, sealed);
        assert!(broken >= 320, "{broken}");
    }
}

#[test]
fn a_kill_between_the_two_files_loses_no_row() {
    let blocks = Blocks::new();
    let (some, more) = (blocks.rows(8..12), blocks.rows(8..16));
    assert!(some.iter().any(|r| r.declarations.len() == 2));
    blocks.write(1, &some);
    let before = fs::read(block_path(blocks.path(), 1)).unwrap();
    // The declarations of all eight runs are written, the rows of the last four are not.
    blocks.write(1, &more);
    fs::write(block_path(blocks.path(), 1), before).unwrap();
    assert!(matches!(blocks.state(1), BlockState::Part(there) if there == some));
    blocks.add(1, &more);
    assert!(matches!(blocks.state(1), BlockState::Done(there) if there == more));
}

#[test]
fn rows_without_their_declarations_are_not_whole() {
    let blocks = Blocks::new();
    let good = blocks.rows(0..8);
    blocks.write(0, &good);
    let sound = fs::read(block_path(blocks.path(), 0)).unwrap();
    fs::remove_file(declarations_path(blocks.path(), 0)).unwrap();
    let missing = blocks.broken();
    assert!(missing.ends_with("declarations-000000.parquet is not whole: it does not exist"), "{missing}");
    // Those of other rows: sound in themselves, but one is missing.
    let mut other = good.clone();
    other[2].declarations.pop();
    blocks.write(0, &other);
    fs::write(block_path(blocks.path(), 0), sound).unwrap();
    let wrong = blocks.broken();
    assert!(wrong.contains("its rows and declarations are not those"), "{wrong}");
    blocks.write(0, &good);
    assert!(matches!(blocks.state(0), BlockState::Done(there) if there == good));
}

#[test]
fn a_merge_has_a_line_for_every_declaration() {
    let blocks = Blocks::new();
    let (dir, all) = (blocks.path(), blocks.rows(0..16));
    blocks.write(0, &all[..8]);
    blocks.write(1, &all[8..]);
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
