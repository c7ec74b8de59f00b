//! The adaptive mission planner with a survey after its declaration, tick by tick.

use crate::StandardEyes;
use crate::testing::{seen, smelling};
use nalgebra::{Vector2, Vector3};
use robots::handoff::{Behaviour, Decision, Manoeuvre, SidescanPing, Verdict, Vertical};
use robots::strategy::{AfterDeclaration, Amp, AmpSpec, Strategy};
use world::seeds::Stream;
use world::units::Heading;

struct Desk {
    amp: Amp,
    rng: Stream,
    t_s: f64,
    goal_id: u32,
}

impl Desk {
    fn new() -> Self {
        let spec = AmpSpec { after_declaration: AfterDeclaration::Survey(Box::default()), ..AmpSpec::default() };
        Self {
            amp: Amp::new(&spec, &StandardEyes).unwrap(),
            rng: Stream::new(1, "a", "strategy"),
            t_s: 0.0,
            goal_id: 0,
        }
    }

    /// A tick at a place, on a heading; the sidescan hears a bare bed.
    fn tick(&mut self, p: Vector2<f64>, heading: Heading, smells: bool, arrived: bool) -> Decision {
        self.t_s += 0.1;
        let mut o = smelling(seen(self.t_s, p, heading.deg(), Some(Vector2::new(0.0, -0.2))), smells);
        o.guidance.goal_id = self.goal_id;
        o.guidance.done = arrived;
        let level: std::sync::Arc<[f32]> = vec![20.0; 400].into();
        o.sidescan =
            Some(SidescanPing { p_BS: Vector3::zeros(), max_m: 20.0, port_db: level.clone(), starboard_db: level });
        let d = self.amp.step(&o, &mut self.rng);
        self.goal_id = d.goal.id;
        d
    }

    /// Three points within 4 m along the flow, lost one after the other; returns the decision at the end of the last
    /// Track-Out.
    fn declare(&mut self) -> Decision {
        let north = Heading::from_deg(350.0);
        for k in 0..3 {
            let p = Vector2::new(0.0, f64::from(k));
            self.tick(p, north, true, false);
            self.t_s += 6.0;
            let d = self.tick(p, north, false, false);
            assert_eq!(d.behaviour, Behaviour::TrackOut);
        }
        self.tick(Vector2::new(0.0, 20.0), north, false, true)
    }

    /// Flies the lines of the survey until it ends.
    fn survey(&mut self, mut d: Decision) -> Decision {
        for _ in 0..2 {
            let Manoeuvre::FollowLine { from, to } = d.goal.manoeuvre else {
                panic!("a survey follows lines: {d:?}");
            };
            assert_eq!(d.goal.vertical, Vertical::Altitude(3.0));
            let heading = Heading::from_vector(to - from);
            for k in 1..50 {
                let p = from + (to - from) * (f64::from(k) / 50.0);
                // Detections count nothing here.
                d = self.tick(p, heading, true, false);
                assert_eq!((d.behaviour, d.declared), (Behaviour::Survey, None));
            }
            d = self.tick(to, heading, false, true);
        }
        d
    }
}

#[test]
fn a_declaration_is_surveyed_and_rejected_where_there_is_nothing() {
    let mut desk = Desk::new();
    let first = desk.declare();
    assert_eq!(first.behaviour, Behaviour::Survey);
    let declared = first.declared.unwrap();
    assert_eq!((declared.number, declared.verdict), (0, Verdict::Unchecked));
    let end = desk.survey(first);
    let again = end.declared.unwrap();
    assert_eq!((again.number, again.verdict, again.surveyed), (0, Verdict::Rejected, None));
    assert_eq!(again.position, declared.position);
    // The points are forgotten, and the search continues at the mission's own height.
    assert_eq!((end.behaviour, end.outcome), (Behaviour::Find, None));
    assert!(desk.amp.shown().lost_points.is_empty());
    assert_eq!(end.goal.vertical, Vertical::Altitude(2.0));
    // The next one is another.
    let second = desk.declare();
    assert_eq!(second.declared.unwrap().number, 1);
}
