//! Same seed, same digest: whoever runs it, whoever listens, whatever is written down.

use crate::common;
use rheotaxis::scenario;
use rheotaxis::trial::Trial;
use std::path::Path;

/// The Duck mission, cut short: everything in it takes part, nothing has time to go far.
fn short_duck(dir: &Path) -> std::path::PathBuf {
    let text = include_str!("../../../scenarios/catalog/duck_st.ron");
    let short = common::with_fields(text, &[("spin_up_s", "120"), ("limit_s", "40")]);
    let path = dir.join("short_duck.ron");
    std::fs::write(&path, short).unwrap();
    path
}

fn digest_of(file: &Path, seed: u64, out: &Path, options: &[&str]) -> String {
    let seed = seed.to_string();
    let mut args = vec!["run", file.to_str().unwrap(), "--seed", &seed, "--quiet", "--out"];
    args.push(out.to_str().unwrap());
    args.extend_from_slice(options);
    let end = common::rheotaxis(&args);
    assert_eq!(end.status.code(), Some(3), "{}", String::from_utf8_lossy(&end.stderr));
    let summary = std::fs::read_to_string(out.join("summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    summary["digest"].as_str().expect("summary.json has a digest").to_string()
}

#[test]
fn two_processes_with_and_without_zenoh_and_recording_agree() {
    let dir = tempfile::tempdir().unwrap();
    let file = short_duck(dir.path());
    let run = |name: &str, seed: u64, options: &[&str]| digest_of(&file, seed, &dir.path().join(name), options);
    let bare = run("bare", 5, &["--no-zenoh", "--no-record"]);
    assert_eq!(bare, run("again", 5, &["--no-zenoh", "--no-record"]));
    assert_eq!(bare, run("recorded", 5, &["--no-zenoh"]));
    assert_eq!(bare, run("live", 5, &["--zenoh-listen", "tcp/127.0.0.1:0"]));
    assert_ne!(bare, run("other", 6, &["--no-zenoh", "--no-record"]));
}

/// So many filaments that their steps are divided among the threads.
#[test]
fn any_number_of_threads_gives_the_same_digest() {
    let dir = tempfile::tempdir().unwrap();
    let file = short_duck(dir.path());
    let text = std::fs::read_to_string(&file).unwrap();
    let many = text.replace("release: (rate_hz: 5,", "release: (rate_hz: 150,");
    assert_ne!(many, text);
    std::fs::write(&file, many).unwrap();
    let run = |threads: &str| {
        let options = ["--no-zenoh", "--no-record", "--threads", threads];
        digest_of(&file, 5, &dir.path().join(threads), &options)
    };
    let one = run("1");
    for threads in ["2", "8", "0"] {
        assert_eq!(run(threads), one, "{threads} threads");
    }
}

/// A contest's runs: their random numbers follow from the seed and a text that only the contest knows.
#[test]
fn a_key_makes_another_run_that_only_its_owner_can_repeat() {
    let dir = tempfile::tempdir().unwrap();
    let file = short_duck(dir.path());
    let run = |name: &str, key: &[&str]| {
        let options = [&["--no-zenoh", "--no-record"], key].concat();
        digest_of(&file, 5, &dir.path().join(name), &options)
    };
    const SECRET: &str = "9 plovers, 3 whelks";
    let keyed = run("keyed", &["--key", SECRET]);
    assert_eq!(keyed, run("again", &["--key", SECRET]));
    assert_ne!(keyed, run("open", &[]));
    assert_ne!(keyed, run("guessed", &["--key", "9 plovers, 2 whelks"]));
    let summary = |name: &str| std::fs::read_to_string(dir.path().join(name).join("summary.json"));
    let mark = world::seeds::Key::secret(SECRET).mark().unwrap();
    assert!(summary("keyed").unwrap().contains(&mark));
    assert!(!summary("open").unwrap().contains("\"key\""));
    for entry in std::fs::read_dir(dir.path().join("keyed")).unwrap() {
        let path = entry.unwrap().path();
        let bytes = std::fs::read(&path).unwrap();
        let told = bytes.windows(SECRET.len()).any(|w| w == SECRET.as_bytes());
        assert!(!told, "{} tells the secret", path.display());
    }
}

#[test]
fn thread_count_does_not_matter() {
    let dir = tempfile::tempdir().unwrap();
    let file = short_duck(dir.path());
    let loaded = scenario::load(&file).unwrap();
    let digests = |threads: usize| -> Vec<String> {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            use rayon::prelude::*;
            (0..4_u64)
                .into_par_iter()
                .map(|seed| Trial::assemble(&loaded, seed).unwrap().finish_quietly().digest)
                .collect()
        })
    };
    let one = digests(1);
    assert_eq!(one, digests(2));
    assert!(one.windows(2).all(|w| w[0] != w[1]));
}
