use super::*;
use crate::handoff::testing::{area, seen, steered};
use crate::handoff::{Setpoint, Vertical};
use proptest::prelude::*;

const DT_S: f64 = 0.1;

fn goal(id: u32, manoeuvre: Manoeuvre) -> Goal {
    Goal { id, manoeuvre, vertical: Vertical::Altitude(2.0), speed_m_s: 1.5 }
}

/// A point vehicle that follows commands at once, in a steady flow that it knows.
struct Boat {
    guidance: Guidance,
    est: Estimate,
    flow: Vector2<f64>,
}

impl Boat {
    fn new(position: Vector2<f64>, heading_deg: f64, flow: Vector2<f64>) -> Self {
        let mut boat = Self {
            guidance: Guidance::new(&GuidanceSpec::default()),
            est: seen(0.0, position, heading_deg, Some(flow)).estimate,
            flow,
        };
        boat.moves(Heading::from_deg(heading_deg), 1.5, 0.0);
        boat
    }

    fn moves(&mut self, heading: Heading, water_speed_m_s: f64, dt_s: f64) {
        let set = Setpoint { heading, water_speed_m_s, vertical: Vertical::Altitude(2.0) };
        let v = steered(&mut self.est, &set, self.flow);
        self.est.position += v * dt_s;
        self.est.t_s += dt_s;
    }

    fn step(&mut self, goal: &Goal) -> GuidanceStatus {
        let (command, status) = self.guidance.step(&self.est, goal, &area(), DT_S);
        let Command::Steer(set) = command else {
            panic!("only direct goals bypass the autopilot");
        };
        let turn = self.est.attitude.heading.turn_to(set.heading).abs();
        assert!(turn <= 10f64.to_radians() * DT_S + 1e-9, "rate {turn}");
        assert!(set.water_speed_m_s <= 2.0 + 1e-9);
        assert_eq!(set.vertical, goal.vertical);
        self.moves(set.heading, set.water_speed_m_s, DT_S);
        status
    }

    fn run(&mut self, goal: &Goal, limit_s: f64) -> bool {
        let steps = (limit_s / DT_S) as usize;
        (0..steps).any(|_| self.step(goal).done)
    }
}

#[test]
fn a_course_is_made_good_over_ground_in_a_cross_flow() {
    let mut b = Boat::new(Vector2::zeros(), 40.0, Vector2::new(0.3, 0.1));
    let g = goal(1, Manoeuvre::Course { course: Heading::from_deg(350.0) });
    for _ in 0..200 {
        assert!(!b.step(&g).done);
    }
    let v = b.est.v_ground();
    assert!(Heading::from_vector(v).turn_to(Heading::from_deg(350.0)).abs() < 1e-6);
    assert!((v.norm() - 1.5).abs() < 1e-6);
}

#[test]
fn a_line_is_entered_with_its_heading_and_left_at_its_end() {
    let (from, to) = (Vector2::new(20.0, 0.0), Vector2::new(20.0, 120.0));
    let g = goal(1, Manoeuvre::FollowLine { from, to });
    let mut b = Boat::new(Vector2::new(0.0, 60.0), 180.0, Vector2::new(0.2, 0.0));
    let mut on_line = 0;
    let mut done = false;
    for _ in 0..6000 {
        done = b.step(&g).done;
        if done {
            break;
        }
        let p = b.est.position;
        if matches!(b.guidance.mode, Mode::Line(_)) && p.y > 30.0 {
            assert!((p.x - 20.0).abs() < 1.0, "off the line at {p:?}");
            on_line += 1;
        }
    }
    assert!(done && on_line > 400, "{on_line}");
    assert!((b.est.position - to).norm() < 10.0);
}

/// How far to the side a way round leads, m.
fn aside(guidance: Guidance) -> f64 {
    let mut boat = Boat::new(Vector2::zeros(), 0.0, Vector2::zeros());
    boat.guidance = guidance;
    let round = Manoeuvre::GoToPointWithHeading { point: Vector2::new(0.0, -150.0), heading: Heading::from_deg(180.0) };
    let (goal, mut most) = (goal(1, round), 0.0f64);
    for _ in 0..4000 {
        if boat.step(&goal).done {
            return most;
        }
        most = most.max(boat.est.position.x.abs());
    }
    panic!("it did not arrive");
}

#[test]
fn no_path_is_planned_tighter_than_the_vehicle_turns() {
    let guidance = || Guidance::new(&GuidanceSpec::default());
    // Twice the radius, from which it turns back to the line: 15 m of the guidance's own, and 40 m.
    let usual = aside(guidance());
    assert!((25.0..35.0).contains(&usual), "{usual}");
    assert_eq!(aside(guidance().turning(8.0)), usual, "it can turn tighter");
    let wide = aside(guidance().turning(40.0));
    assert!((70.0..85.0).contains(&wide), "{wide}");
}

#[test]
fn a_new_id_starts_afresh_and_an_old_one_stays_done() {
    let mut b = Boat::new(Vector2::zeros(), 0.0, Vector2::zeros());
    let there = |id, north| {
        let point = Vector2::new(0.0, north);
        goal(id, Manoeuvre::GoToPoint { point, radius_m: Some(5.0) })
    };
    assert!(b.run(&there(1, 30.0), 60.0));
    let status = b.step(&there(1, 30.0));
    assert!(status.done && status.goal_id == 1);
    let status = b.step(&there(2, 200.0));
    assert!(!status.done && status.goal_id == 2);
}

#[test]
fn direct_goes_straight_through() {
    let mut g = Guidance::new(&GuidanceSpec::default());
    // Far outside: nothing stands between table and actuators.
    let est = seen(0.0, Vector2::new(900.0, 0.0), 0.0, None).estimate;
    let direct = Manoeuvre::Direct { rudder_rad: 0.1, stern_rad: -0.2, rpm: 1500.0 };
    let (command, status) = g.step(&est, &goal(3, direct), &area(), DT_S);
    let want = ActuatorCommand { rudder_rad: 0.1, stern_rad: -0.2, rpm: 1500.0 };
    assert_eq!(command, Command::Direct(want));
    assert_eq!(status, GuidanceStatus { goal_id: 3, done: false, aborted: false });
}

#[test]
fn aborted_far_outside_and_for_good() {
    let mut g = Guidance::new(&GuidanceSpec::default());
    let course = goal(1, Manoeuvre::Course { course: Heading::from_deg(90.0) });
    let mut at = |east: f64| {
        let est = seen(0.0, Vector2::new(east, 0.0), 90.0, None).estimate;
        g.step(&est, &course, &area(), DT_S).1.aborted
    };
    assert!(!at(229.0));
    assert!(at(231.0));
    assert!(at(0.0));
}

proptest! {
    #![proptest_config(crate::handoff::testing::fixed(64))]

    // For any command: through the water the turning radius is r = (1.5 + 0.32) m/s at 10 deg/s = 10.4 m; turning
    // about in a corner, entered at 45 degrees, takes (1 + sin 45) r = 17.8 m, and the 18 s that it lasts add a drift
    // of 0.32 m/s. Less than the 30 m of the abort.
    #[test]
    fn the_cage_holds(course in 0.0..360.0, east in -190.0..190.0, north in -290.0..290.0, flow in -0.3..0.3) {
        let mut b = Boat::new(Vector2::new(east, north), course, Vector2::new(flow, 0.1));
        let g = goal(1, Manoeuvre::Course { course: Heading::from_deg(course) });
        for _ in 0..6000 {
            prop_assert!(!b.step(&g).aborted);
            let p = b.est.position;
            prop_assert!(area().sides().edges(p).iter().all(|(d, _)| *d > -23.6), "{p:?}");
        }
    }

    #[test]
    fn poses_are_reached_in_flow(
        east in -80.0..80.0, north in -80.0..80.0, heading in 0.0..360.0, e in -0.3..0.3, n in -0.3..0.3,
    ) {
        let mut b = Boat::new(Vector2::zeros(), 0.0, Vector2::new(e, n));
        let point = Vector2::new(east, north);
        let heading = Heading::from_deg(heading);
        let g = goal(1, Manoeuvre::GoToPointWithHeading { point, heading });
        prop_assert!(b.run(&g, 400.0));
        prop_assert!((b.est.position - point).norm() < 5.0, "{:?} for {point:?}", b.est.position);
        prop_assert!(Heading::from_vector(b.est.v_ground()).turn_to(heading).abs() < 15f64.to_radians());
    }
}
