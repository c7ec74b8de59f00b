//! The catalogue with other hulls: which pairs run, and why the others are refused.

use crate::common;
use rheotaxis::scenario::{CATALOG, load};
use rheotaxis::trial::Trial;
use robots::vehicles::{SHIPPED, VehicleSpec};
use world::ranges::{NonNegative, Positive};

/// The pairs that are refused: scenario, hull and reason, as `docs/vehicles.md` sums them up.
const REFUSED: &str = "tests/golden/hulls_refused.txt";
/// The hulls of which every pair that is not refused runs for some seconds; of the others it is only checked.
const RUN: [&str; 2] = ["bluerov2_heavy", "lauv"];

/// Every scenario of the catalogue with a REMUS and each shipped hull in its place: it is refused exactly where the
/// table says so, with the reason that stands there, and runs everywhere else.
#[test]
fn the_catalogue_runs_with_other_hulls() {
    let mut refused = String::new();
    for template in CATALOG.iter().filter(|t| t.text.contains("Remus100(")) {
        for hull in SHIPPED.iter().map(|s| s.folder) {
            let mut loaded = load(template.name.as_ref()).expect("a scenario of the catalogue").edit(|scenario| {
                for robot in &mut scenario.robots {
                    if matches!(robot.vehicle, VehicleSpec::Remus100(_)) {
                        robot.vehicle = VehicleSpec::Shipped(hull.to_string());
                    }
                }
            });
            if let Err(why) = loaded.check() {
                for line in why.lines() {
                    // Without file, line and column: a comment in a scenario moves them.
                    let (_, reason) = line.split_once(": ").expect("a place");
                    refused += &format!("{} {hull}: {reason}\n", template.name);
                }
                continue;
            }
            if !RUN.contains(&hull) {
                continue;
            }
            let time = &mut loaded.scenario.time;
            time.spin_up_s = NonNegative::new(time.spin_up_s.get().min(10.0));
            time.limit_s = Positive::new(10.0);
            let ended = Trial::assemble(&loaded, 1).expect("a run").finish_quietly();
            assert!(ended.steps > 0, "{} with {hull}", template.name);
        }
    }
    let known = std::fs::read_to_string(common::root().join(REFUSED)).unwrap_or_default();
    assert_eq!(refused, known, "what is refused is no longer what {REFUSED} holds; it is now\n{refused}");
}
