//! Campaigns whose runs have a secret key beside their seeds.

use super::{ends, folder, rows};
use crate::common::says;
use std::fs;

const RUN: [&str; 7] = ["run", "c.ron", "--out", "out", "--block", "2", "--quiet"];
const SECRET: &str = "9 plovers, 3 whelks";
const KEY: [&str; 2] = ["--key", SECRET];

#[test]
fn runs_under_different_keys_never_share_a_folder() {
    let folder = folder(1, 30.0, 1.0);
    let dir = folder.path();
    let keyed = |code: i32, args: &[&str]| ends(dir, code, &[args, &KEY].concat());
    keyed(0, &RUN);
    let under_key = rows(&dir.join("out"));
    let manifest = fs::read_to_string(dir.join("out/campaign.json")).unwrap();
    let mark = world::seeds::Key::secret(SECRET).mark().unwrap();
    assert!(manifest.contains(&mark) && !manifest.contains(SECRET), "{manifest}");
    // Whoever goes on without it is told so, and loses nothing.
    let rerun = ["rerun", "out", "--run", "0", "--quiet"];
    says(&ends(dir, 1, &RUN).1, &[&format!("{mark} there, none here")]);
    says(&ends(dir, 1, &rerun).1, &[&mark, "--key"]);
    says(&keyed(0, &rerun).0, &["the same digest"]);
    // Reading needs no key.
    ends(dir, 0, &["status", "out"]);
    fs::remove_dir_all(dir.join("out")).unwrap();
    ends(dir, 0, &RUN);
    let open = rows(&dir.join("out"));
    for (a, b) in under_key.iter().zip(&open) {
        assert_eq!((a.run, a.seed), (b.run, b.seed));
        assert_ne!(a.digest, b.digest);
    }
}
