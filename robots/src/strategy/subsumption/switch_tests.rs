//! Which layer controls the vehicle, and which ones that silences, with observations written by hand.

use super::testing::{all, avoid, declare, desk, find, go_home, maintain, reacquire, said};
use super::{LayerSpec, MaintainSpec, Subsumption, SubsumptionSpec};
use crate::handoff::{Behaviour, Manoeuvre, Outcome};
use crate::memory::FixMove;
use crate::strategy::testing::{Desk, setting};
use nalgebra::Vector2;

#[test]
fn find_holds_until_a_detection_and_maintain_from_then_on() {
    let mut d = desk(all());
    let names: Vec<_> = d.quiet(0.0).shown.layers.iter().map(|l| l.name).collect();
    let want = ["find", "maintain", "reacquire", "declare", "avoid", "plume_map", "go_home"];
    assert_eq!(names, want);
    let first = d.quiet(0.0);
    assert_eq!((said(&first).as_str(), first.behaviour), ("H......", Behaviour::Find));
    let tracked = d.smell(1.0);
    assert_eq!((said(&tracked).as_str(), tracked.behaviour), ("sH.....", Behaviour::TrackIn));
    assert_eq!(tracked.goal.id, first.goal.id + 1);
    // The course changes under one id.
    assert_eq!(d.smell(2.0).goal.id, tracked.goal.id);
}

#[test]
fn a_detection_interrupts_the_reacquisition_and_its_end_gives_the_search_back() {
    let mut d = desk(all());
    assert_eq!(said(&d.point(0.0)), "sH.....");
    assert_eq!(said(&d.arrive(20.0)), "s.H....");
    assert_eq!(said(&d.smell(21.0)), "sH.....");
    d.t_s += 5.0;
    d.quiet(30.0);
    assert_eq!(said(&d.arrive(40.0)), "s.H....");
    // Two points, two bowties each, two lines each.
    for line in 1..8 {
        assert_eq!(said(&d.arrive(40.0)), "s.H....", "line {line}");
    }
    let again = d.arrive(40.0);
    assert_eq!((said(&again).as_str(), again.behaviour), ("H......", Behaviour::Find));
    assert!(again.shown.lost_points.is_empty());
}

#[test]
fn without_a_track_out_the_silence_is_it() {
    let silent = MaintainSpec { track_out: None, ..MaintainSpec::default() };
    let mut d = desk(vec![find(), LayerSpec::Maintain(silent), reacquire(), declare()]);
    assert_eq!(d.smell(0.0).behaviour, Behaviour::TrackIn);
    // Tian's Fig. 4a: without detections the vehicle is in Track-Out, on the same course.
    let silence = d.quiet(1.0);
    assert_eq!((said(&silence).as_str(), silence.behaviour), ("sH..", Behaviour::TrackOut));
    assert_eq!(d.smell(2.0).behaviour, Behaviour::TrackIn);
    d.t_s += 5.0;
    let lost = d.quiet(12.0);
    assert_eq!((said(&lost).as_str(), lost.shown.lost_points.len()), ("s.H.", 1));
}

#[test]
fn declare_beats_reacquire_and_go_home_inhibits_all() {
    let mut d = desk(all());
    d.near_the_source(0.0);
    assert_eq!(d.quiet(15.0).declared, None, "it waits for Track-Out's end");
    let end = d.arrive(20.0);
    assert_eq!(said(&end), "s.sH...");
    let declared = end.declared.expect("three points within 2.5 m");
    assert_eq!((declared.position, declared.rule), (Vector2::new(0.0, 2.5), "AlongFlow"));
    for smells in [false, true] {
        d.obstacle = smells;
        let home = d.tick(20.0, smells, false, false);
        assert_eq!((said(&home).as_str(), home.behaviour), ("iiiiiiH", Behaviour::GoHome));
        assert_eq!((home.declared, home.outcome), (None, None));
        assert!(matches!(home.goal.manoeuvre, Manoeuvre::GoToPoint { .. }));
    }
    let done = d.arrive(-250.0);
    assert_eq!((done.behaviour, done.outcome), (Behaviour::Done, Some(Outcome::Completed)));
    assert_eq!(said(&d.smell(-250.0)), ".......");
}

#[test]
fn declare_beats_maintain_when_a_detection_ends_track_out() {
    let mut d = desk(all());
    d.near_the_source(0.0);
    let end = d.smell(15.0);
    assert_eq!((said(&end).as_str(), end.declared.is_some()), ("ss.H...", true));
}

#[test]
fn avoid_beats_declare_for_the_time_of_the_obstacle() {
    let mut d = desk(all());
    d.near_the_source(0.0);
    d.obstacle = true;
    let before = d.goal.expect("under way").id;
    let away = d.quiet(15.0);
    assert_eq!((said(&away).as_str(), away.behaviour), ("ss..H..", Behaviour::Avoid));
    assert_eq!(away.goal.id, before + 1);
    assert!(matches!(away.goal.manoeuvre, Manoeuvre::Course { .. }));
    // A detection ends Track-Out: Declare asks, and waits.
    let waits = d.smell(15.0);
    assert_eq!((said(&waits).as_str(), waits.declared), ("ss.sH..", None));
    assert_eq!(said(&d.quiet(15.0)), "ss.sH..");
    // Its echoes are forgotten after 15 s; by then the plume is lost, and the vehicle looks for it.
    d.obstacle = false;
    d.t_s += 15.0;
    let end = d.quiet(15.0);
    assert!(said(&end).ends_with("H..."), "{}", said(&end));
    assert!(end.declared.is_some());
}

#[test]
fn layers_under_avoid_go_on_watching_and_get_their_goal_back() {
    let mut d = desk(all());
    let search = d.quiet(0.0).goal.manoeuvre;
    d.obstacle = true;
    assert_eq!(said(&d.quiet(0.0)), "s...H..");
    // Nothing arrives meanwhile: the guidance has reached Avoid's goal.
    assert_eq!(said(&d.arrive(0.0)), "s...H..");
    d.obstacle = false;
    d.t_s += 20.0;
    let back = d.quiet(0.0);
    assert_eq!((said(&back).as_str(), back.goal.manoeuvre), ("H......", search));
    d.obstacle = true;
    assert_eq!(said(&d.smell(0.0)), "ss..H..");
    d.t_s += 5.0;
    assert_eq!(d.quiet(10.0).shown.lost_points, [Vector2::new(0.0, 0.0)]);
}

#[test]
fn above_go_home_avoid_is_heeded_on_the_way_home() {
    let mut d = desk(vec![find(), maintain(), declare(), go_home(), avoid()]);
    d.near_the_source(0.0);
    assert!(d.arrive(20.0).declared.is_some());
    assert_eq!(said(&d.quiet(20.0)), "iiiH.");
    d.obstacle = true;
    let away = d.quiet(20.0);
    assert_eq!((said(&away).as_str(), away.behaviour), ("iiisH", Behaviour::Avoid));
}

#[test]
fn without_go_home_the_declaration_is_the_end() {
    let mut d = desk(vec![find(), maintain(), reacquire(), declare()]);
    d.near_the_source(0.0);
    let end = d.arrive(20.0);
    assert!(end.declared.is_some());
    assert_eq!((end.behaviour, end.outcome), (Behaviour::Done, Some(Outcome::Completed)));
}

#[test]
fn lost_points_move_with_a_fix_when_told() {
    for (fixes, north) in [(FixMove::Stay, 0.0), (FixMove::Whole, 7.0)] {
        let mut spec = SubsumptionSpec::with_layers(all());
        spec.fixes = fixes;
        let mut d = Desk::new(Subsumption::new(&spec, &setting(8.0, true)).expect("these layers make sense"));
        d.point(0.0);
        d.jump = Vector2::new(0.0, 7.0);
        assert_eq!(d.quiet(20.0).shown.lost_points, [Vector2::new(0.0, north)]);
    }
}
