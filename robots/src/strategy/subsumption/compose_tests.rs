//! Which compositions are refused, and how the map takes part.

use super::testing::{all, declare, desk, find, go_home, maintain, plume_map, reacquire, said};
use super::{LayerSpec, Subsumption, SubsumptionSpec};
use crate::behave::AvoidParams;
use crate::handoff::Behaviour;
use crate::strategy::testing::{point_of, setting};
use nalgebra::Vector2;

#[test]
fn the_map_leads_the_search_once_and_nothing_but_the_search() {
    let mut d = desk(all());
    d.map = Some(Vector2::new(50.0, 100.0));
    let led = d.quiet(0.0);
    assert_eq!((said(&led).as_str(), led.behaviour), ("s....H.", Behaviour::FollowPath));
    let point = point_of(&led);
    // 30 m down-flow, to the south, of the middle of a cell of 10 m.
    assert!((point - Vector2::new(50.0, 70.0)).norm() < 10.0, "{point:?}");
    // The obstacle has priority over the map, although its layer is lower.
    d.obstacle = true;
    assert_eq!(said(&d.quiet(0.0)), "s...Hs.");
    d.obstacle = false;
    d.t_s += 20.0;
    assert_eq!(said(&d.quiet(0.0)), "s....H.");
    let there = d.arrive(70.0);
    assert_eq!((said(&there).as_str(), there.behaviour), ("H......", Behaviour::Find));
    // The same place again is nothing new; another place is, and so is the same place after a detection.
    assert_eq!(said(&d.quiet(71.0)), "H......");
    d.map = Some(Vector2::new(50.0, 200.0));
    assert_eq!(said(&d.quiet(72.0)), "s....H.");
    assert_eq!(said(&d.smell(73.0)), "sH.....");
    d.t_s += 5.0;
    assert_eq!(said(&d.quiet(80.0)), "sH.....");
    assert_eq!(said(&d.arrive(90.0)), "s.H....");
    for _ in 0..3 {
        assert_eq!(said(&d.arrive(90.0)), "s.H....");
    }
    assert_eq!(said(&d.arrive(90.0)), "s....H.");
}

#[test]
fn compositions_that_make_no_sense_are_refused() {
    let refused = |layers: Vec<LayerSpec>, maps| {
        Subsumption::new(&SubsumptionSpec::with_layers(layers), &setting(8.0, maps))
            .expect_err("makes no sense")
            .to_string()
    };
    for (layers, says) in [
        (vec![], "layers: there is no Find"),
        (vec![find()], "layers: there is no Maintain"),
        (vec![find(), maintain(), find()], "layers[2]: there already is a Find, layers[0]"),
        (vec![maintain(), find()], "layers[0]: Maintain must be above (after) Find, layers[1]"),
        (vec![find(), reacquire(), maintain()], "layers[1]: Reacquire must be above"),
        (vec![find(), maintain(), declare(), reacquire()], "layers[2]: Declare must be above"),
        (vec![find(), maintain(), go_home()], "layers[2]: GoHome waits for a declaration"),
        (vec![find(), maintain(), go_home(), declare()], "layers[2]: GoHome must be above"),
    ] {
        let got = refused(layers, true);
        assert!(got.starts_with(&format!("strategy.Subsumption.{says}")), "{got}");
    }
    let got = refused(vec![find(), maintain(), plume_map()], false);
    assert!(got.starts_with("strategy.Subsumption.layers[2]: needs a source map"), "{got}");
    let wrong = AvoidParams { near_m: world::ranges::Positive::new(40.0), ..AvoidParams::default() };
    let got = refused(vec![find(), maintain(), LayerSpec::Avoid(wrong)], false);
    assert_eq!(got, "strategy.Subsumption.layers[2].near_m: must be less than heed_m, 35, got 40");
}
