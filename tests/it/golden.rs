//! Digests that stay the same from version to version, and on every machine, until a change of the
//! physics or of an algorithm is meant. Then the new ones are written down, and the commit says why.

use rheotaxis::scenario::{load, parse};
use rheotaxis::trial::Trial;
use std::path::Path;

#[test]
fn runs_still_go_through_the_same_states() {
    let golden = include_str!("../golden/digests.txt");
    let now: Vec<String> = [
        ("remus_zigzag", 1),
        ("uniform_channel", 1),
        ("uniform_channel", 2),
        ("flume_crab", 1),
        ("wp_laminar", 1),
    ]
    .into_iter()
    .map(|(name, seed)| {
        let mut loaded = load(Path::new(name)).unwrap();
        let shorter = loaded
            .text
            .replace("spin_up_s: 2000", "spin_up_s: 300")
            .replace("limit_s: 1800", "limit_s: 60")
            .replace("limit_s: 180)", "limit_s: 40)");
        loaded.scenario = parse(name, &shorter).unwrap();
        let ended = Trial::assemble(&loaded, seed).unwrap().finish_quietly();
        format!("{name} {seed} {} {}\n", ended.steps, ended.digest)
    })
    .collect();
    assert_eq!(now.concat(), golden);
}
