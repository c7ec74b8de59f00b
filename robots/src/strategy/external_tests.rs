use super::*;
use crate::handoff::MoveOrder;
use crate::handoff::testing::seen;
use crate::strategy::testing::setting;
use nalgebra::Vector2;
use world::units::Heading;

fn external(on_late: OnLate) -> Result<Box<dyn Strategy>, RobotError> {
    let spec = ExternalSpec { on_late, ..ExternalSpec::default() };
    spec.build(&setting(8.0, false))
}

fn route() -> StrategySpec {
    let spec = crate::strategy::RouteSpec {
        points: vec![(world::ranges::Finite::new(50.0), world::ranges::Finite::new(60.0))],
        speed_m_s: Positive::new(1.0),
        vertical: None,
        stay_s: world::ranges::NonNegative::new(0.0),
    };
    StrategySpec::new(spec)
}

fn at(t_s: f64, told: Option<ReplyOutcome>) -> Observation {
    Observation { told, ..seen(t_s, Vector2::zeros(), 30.0, None) }
}

fn steer(deg: f64, id: Option<u32>) -> Option<ReplyOutcome> {
    order(deg, id, Some(1.2))
}

fn order(deg: f64, id: Option<u32>, speed_m_s: Option<f64>) -> Option<ReplyOutcome> {
    Some(ReplyOutcome::Answer(Box::new(Reply {
        order: Some(MotionOrder::Move(MoveOrder {
            id,
            manoeuvre: Manoeuvre::Steer { heading: Heading::from_deg(deg) },
            vertical: None,
            speed_m_s,
        })),
        behaviour: Some(Behaviour::Other("surge")),
        ..Reply::default()
    })))
}

#[test]
fn the_last_order_holds_between_answers_and_without_one() {
    let mut s = external(OnLate::Hold).expect("legal");
    let mut rng = Stream::new(1, "auv0", "strategy");
    let first = s.step(&at(0.0, None), &mut rng);
    assert_eq!(first.goal.speed_m_s, 2.0, "as it set out");
    assert_eq!(first.goal.vertical, Vertical::Depth(3.0));
    let told = s.step(&at(1.0, steer(90.0, None)), &mut rng);
    assert_eq!((told.goal.id, told.goal.speed_m_s), (1, 1.2));
    assert_eq!(told.goal.vertical, Vertical::Depth(3.0));
    assert_eq!(told.behaviour.name(), "surge");
    for told_again in [None, Some(ReplyOutcome::Nothing)] {
        let held = s.step(&at(2.0, told_again), &mut rng);
        assert_eq!((held.goal, held.outcome), (told.goal, None));
    }
    let same = s.step(&at(3.0, steer(80.0, Some(1))), &mut rng);
    assert_eq!(same.goal.id, 1);
    assert_eq!(s.step(&at(4.0, steer(70.0, None)), &mut rng).goal.id, 2);
}

#[test]
fn an_order_without_a_speed_moves_a_vehicle_that_starts_at_rest() {
    let mut rng = Stream::new(1, "auv0", "strategy");
    let mut at_rest = at(0.0, order(90.0, None, None));
    at_rest.estimate.v_ground_body.x = 0.0;
    let least = at_rest.able.least_speed_m_s;
    assert!(least > 0.0);
    // One that hovers stays: it does not sink.
    for least_speed_m_s in [least, 0.0] {
        at_rest.able.least_speed_m_s = least_speed_m_s;
        let mut s = external(OnLate::Hold).expect("legal");
        assert_eq!(s.step(&at_rest, &mut rng).goal.speed_m_s, least_speed_m_s);
    }
}

#[test]
fn without_an_answer_it_can_end_its_mission() {
    let mut s = external(OnLate::Abort).expect("legal");
    let mut rng = Stream::new(1, "auv0", "strategy");
    assert_eq!(s.step(&at(0.0, steer(90.0, None)), &mut rng).outcome, None);
    let aborted = s.step(&at(1.0, Some(ReplyOutcome::Nothing)), &mut rng);
    assert_eq!(aborted.outcome, Some(Outcome::Aborted));
    let late = s.step(&at(2.0, steer(90.0, None)), &mut rng);
    assert_eq!(late.outcome, Some(Outcome::Aborted), "over is over");
}

#[test]
fn a_fallback_stands_in_with_its_own_numbers_until_the_next_answer() {
    let mut s = external(OnLate::Fallback(Box::new(route()))).expect("legal");
    let mut rng = Stream::new(1, "auv0", "strategy");
    s.step(&at(0.0, steer(90.0, Some(7))), &mut rng);
    let stood_in = s.step(&at(1.0, Some(ReplyOutcome::Nothing)), &mut rng);
    assert_eq!(stood_in.goal.id, 8);
    assert!(matches!(stood_in.goal.manoeuvre, Manoeuvre::GoToPoint { point, .. } if point.x == 50.0));
    assert_eq!(s.step(&at(2.0, None), &mut rng).goal, stood_in.goal);
    // It has arrived at the fallback's only point: the fallback is told so in its own numbers.
    let mut there = at(3.0, None);
    there.guidance = GuidanceStatus { goal_id: 8, done: true, aborted: false };
    let mut answered = external(OnLate::Fallback(Box::new(route()))).expect("legal");
    answered.step(&at(0.0, steer(90.0, Some(7))), &mut rng);
    answered.step(&at(1.0, Some(ReplyOutcome::Nothing)), &mut rng);
    let back = answered.step(&at(2.0, steer(10.0, None)), &mut rng);
    assert_eq!(back.goal.id, 9, "a new goal after the fallback's");
    let ends = [s.step(&there, &mut rng), s.step(&there, &mut rng)];
    assert!(ends.iter().any(|d| d.outcome == Some(Outcome::Completed)));
}

#[test]
fn a_searcher_outside_does_not_stand_in_for_itself() {
    let own = StrategySpec::new(ExternalSpec::default());
    let refused = external(OnLate::Fallback(Box::new(own))).err();
    let refused = refused.expect("refused").to_string();
    assert!(refused.contains("got External"), "{refused}");
}
