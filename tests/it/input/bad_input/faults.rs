//! Faults of things that a robot has not, and at times that contradict each other.

use super::{golden, pond, refused};

/// The pond with these faults and a compass.
fn faulty(faults: &str) -> String {
    let estimator = "estimator: DeadReckoning(),";
    let with = format!("sensors: (compass: ()),\n            {estimator}\n{faults}");
    pond(estimator, &with)
}

#[test]
fn faults_that_nothing_can_have() {
    for (faults, name) in [
        (
            "            faults: [
                (at_s: 0.5, until_s: 0.4, what: Compass(Stuck)),
                (at_s: 1, what: Fluorometer(Silent)),
                (at_s: 1, what: Drive(link: \"ruder\", how: Dead)),
                (at_s: 0, until_s: 1, what: Rudder(Stuck)),
                (at_s: 0.9, what: Drive(link: \"rudder\", how: StuckAt(100))),
            ],",
            "faults_that_do_not_fit",
        ),
        (
            "            faults: [
                (at_s: -1, what: Compass(Stuck)),
                (at_s: 1, what: Compass(StuckAt(10))),
                (at_s: 1, what: Gyroscope(Silent)),
                (at_s: 1, what: Propeller(Weak(1.5))),
                (at_s: 1, what: Compass(Biased(200))),
                (at_s: 1, what: Depth),
            ],",
            "faults_that_make_no_sense",
        ),
    ] {
        refused(faulty(faults), &golden(name));
    }
}
