//! Robots with faults in lanes of one ocean.

use super::{alone, cut, in_lanes};
use rheotaxis::lanes::group_by_ocean;
use rheotaxis::scenario::{Loaded, cost, load_text, template};
use world::registry::Registry;

#[test]
fn robots_with_faults_share_an_ocean_and_fly_as_alone() {
    let text = template("uniform_channel").unwrap().text;
    let all: Vec<Loaded> = [
        "",
        "(at_s: 5, what: Fluorometer(Biased(1)))",
        "(at_s: 5, until_s: 9, what: Compass(Stuck)), (at_s: 9, what: Compass(Drifting(1)))",
        "(at_s: 4, what: Rudder(Stuck)), (at_s: 6, what: Propeller(Weak(0.5)))",
        "(at_s: 5, what: Fixes(Lie(east_m: 20)))",
    ]
    .iter()
    .map(|faults| {
        let estimator = "estimator: DeadReckoning(),";
        let text = text.replace(estimator, &format!("{estimator} faults: [{faults}],"));
        let mut loaded = load_text(&Registry::default(), "faulty", &text).unwrap();
        // Some fixes come a minute apart.
        cut(&mut loaded, 30.0, 190.0);
        loaded
    })
    .collect();
    let runs: Vec<_> = all.iter().map(|l| (l, super::SEED.into())).collect();
    assert_eq!(group_by_ocean(&runs, cost::MEMORY), [[0, 1, 2, 3, 4]]);
    let (ends, _) = in_lanes(&all.iter().collect::<Vec<_>>());
    let mut digests = Vec::new();
    for (end, loaded) in ends.into_iter().zip(&all) {
        let end = end.unwrap();
        assert_eq!(end, alone(loaded));
        digests.push(end.0.digest);
    }
    digests.sort();
    digests.dedup();
    assert_eq!(digests.len(), all.len(), "each fault does something");
}
