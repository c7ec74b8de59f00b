//! Same seed, same digest: whoever runs it, whoever listens, whatever is written down.

use crate::common::{digest, rheotaxis_in, short, write};
use std::fs;
use std::path::Path;
use tempfile::TempDir;
use world::ranges::Positive;

/// A folder with the Duck mission, cut short: everything in it takes part, nothing has time to go far.
fn folder() -> TempDir {
    let dir = tempfile::tempdir().unwrap();
    write(dir.path(), "duck.ron", &short("duck_st", 120.0, 40.0));
    dir
}

/// Digest of the run of a seed into the folder `out`.
#[track_caller]
fn run(dir: &Path, out: &str, seed: u64, options: &[&str]) -> String {
    let seed = seed.to_string();
    let args = ["run", "duck.ron", "--seed", &seed, "--quiet", "--out", out];
    rheotaxis_in(dir, &[&args, options].concat()).with(3);
    digest(&dir.join(out))
}

const BARE: [&str; 2] = ["--no-zenoh", "--no-record"];

#[test]
fn two_processes_with_and_without_zenoh_and_recording_agree() {
    let dir = folder();
    let run = |out: &str, seed: u64, options: &[&str]| run(dir.path(), out, seed, options);
    let bare = run("bare", 5, &BARE);
    assert_eq!(bare, run("again", 5, &BARE));
    assert_eq!(bare, run("recorded", 5, &["--no-zenoh"]));
    assert_eq!(bare, run("live", 5, &["--zenoh-listen", "tcp/127.0.0.1:0"]));
    assert_ne!(bare, run("other", 6, &BARE));
}

/// So many filaments that their steps are divided among the threads.
#[test]
fn any_number_of_threads_gives_the_same_digest() {
    let dir = folder();
    let many = short("duck_st", 120.0, 40.0).edit(|s| s.sources[0].release.rate_hz = Positive::new(150.0));
    write(dir.path(), "duck.ron", &many);
    let run = |threads: &str| run(dir.path(), threads, 5, &[&BARE[..], &["--threads", threads]].concat());
    let one = run("1");
    for threads in ["2", "8", "0"] {
        assert_eq!(run(threads), one, "{threads} threads");
    }
}

/// A contest's runs: their random numbers follow from the seed and a text that only the contest knows.
#[test]
fn a_key_makes_another_run_that_only_its_owner_can_repeat() {
    const SECRET: &str = "9 plovers, 3 whelks";
    let dir = folder();
    let run = |out: &str, key: &[&str]| run(dir.path(), out, 5, &[&BARE[..], key].concat());
    let keyed = run("keyed", &["--key", SECRET]);
    assert_eq!(keyed, run("again", &["--key", SECRET]));
    assert_ne!(keyed, run("open", &[]));
    assert_ne!(keyed, run("guessed", &["--key", "9 plovers, 2 whelks"]));
    let summary = |out: &str| fs::read_to_string(dir.path().join(out).join("summary.json")).unwrap();
    let mark = world::seeds::Key::secret(SECRET).mark().unwrap();
    assert!(summary("keyed").contains(&mark) && !summary("open").contains("\"key\""));
    for entry in fs::read_dir(dir.path().join("keyed")).unwrap() {
        let path = entry.unwrap().path();
        let bytes = fs::read(&path).unwrap();
        let told = bytes.windows(SECRET.len()).any(|w| w == SECRET.as_bytes());
        assert!(!told, "{} tells the secret", path.display());
    }
}
