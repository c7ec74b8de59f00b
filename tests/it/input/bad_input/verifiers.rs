//! Verifiers of pictures that could never verify anything.

use super::{golden, pond, refused};

/// The pond with eyes and with `strategy` in place of the open loop.
fn pond_with_eyes(strategy: &str) -> String {
    let estimator = "estimator: DeadReckoning(),";
    let eyes = "sensors: (fluorometer: (), dvl: (), adcp: (), compass: (), depth: (), altimeter: (), sidescan: (), \
        camera: ()),\n            ";
    let eyed = pond(estimator, &format!("{eyes}{estimator}"));
    let blind = "OpenLoop(table: [(t_s: 0, rpm: 0)], end_s: 1)";
    assert_eq!(eyed.matches(blind).count(), 1);
    eyed.replace(blind, strategy)
}

#[test]
fn verifiers_that_could_never_verify() {
    let survey = "Amp(
                after_declaration: Survey(camera: (verifier: (least_dye: 0.8)), verify: Camera),
            )";
    let eyes = "Subsumption(
                layers: [Find(ZigZag()), Maintain(), Declare(SizF())],
                eyes: (verifier: (colours: (alpha2: 300))),
            )";
    for (strategy, name) in [(survey, "survey"), (eyes, "eyes")] {
        refused(pond_with_eyes(strategy), &golden(&format!("verifier_of_{name}")));
    }
}
