//! The switching diagram and the layers are two ways to combine the same behaviours: with Pang's parameters both do
//! the same for the same observations, and a cage abort ends both wherever they are.

use super::{GoHomeSpec, LayerSpec, MaintainSpec, Subsumption, SubsumptionSpec};
use crate::behave::{FindSpec, ReacquireSpec};
use crate::declare::DeclareSpec;
use crate::handoff::testing::{fixed, seen, smelling};
use crate::handoff::{Behaviour, Outcome};
use crate::memory::FixMove;
use crate::strategy::testing::{Blind, Ticked, setting};
use crate::strategy::{Amp, AmpSpec};
use nalgebra::Vector2;
use proptest::prelude::*;
use proptest::strategy::Strategy as Drawn;
use world::seeds::Stream;

/// What happens in a tick.
#[derive(Clone, Copy, Debug)]
enum Event {
    Quiet,
    Smell,
    /// The guidance has reached the goal.
    Arrive,
    /// Longer than λ without a detection.
    Silence,
    /// The flow turns, by so many degrees.
    Turn(f64),
    /// A fix moves the vehicle east.
    Fix(f64),
}

fn event() -> impl Drawn<Value = Event> {
    prop_oneof![
        3 => Just(Event::Quiet),
        4 => Just(Event::Smell),
        3 => Just(Event::Arrive),
        4 => Just(Event::Silence),
        1 => (-180.0..180.0f64).prop_map(Event::Turn),
        1 => (-9.0..9.0f64).prop_map(Event::Fix),
    ]
}

struct Both {
    amp: Amp,
    layers: Subsumption,
    /// Goals last given.
    goals: [u32; 2],
    rngs: [Stream; 2],
}

impl Both {
    fn new(fixes: FixMove) -> Self {
        let amp = AmpSpec { fixes, ..AmpSpec::default() };
        let mut spec = SubsumptionSpec::with_layers(vec![
            LayerSpec::Find(FindSpec::default()),
            LayerSpec::Maintain(MaintainSpec::default()),
            LayerSpec::Reacquire(ReacquireSpec::default()),
            LayerSpec::Declare(DeclareSpec::default()),
            LayerSpec::GoHome(GoHomeSpec::default()),
        ]);
        spec.fixes = fixes;
        Self {
            amp: Amp::new(&amp, &Blind).expect("defaults are legal"),
            layers: Subsumption::new(&spec, &setting(8.0, false)).expect("Tian's order"),
            goals: [0; 2],
            rngs: [1, 1].map(|s| Stream::new(s, "auv0", "strategy")),
        }
    }

    fn step(&mut self, o: &crate::handoff::Observation, arrived: bool) -> [Ticked; 2] {
        let [mut a, mut b] = [o.clone(), o.clone()];
        (a.guidance.goal_id, a.guidance.done) = (self.goals[0], arrived);
        (b.guidance.goal_id, b.guidance.done) = (self.goals[1], arrived);
        let [ra, rb] = &mut self.rngs;
        let both = [Ticked::step(&mut self.amp, &a, ra), Ticked::step(&mut self.layers, &b, rb)];
        self.goals = both.each_ref().map(|d| d.goal.id);
        both
    }
}

proptest! {
    #![proptest_config(fixed(200))]

    #[test]
    fn the_same_observations_make_both_do_the_same(
        events in proptest::collection::vec((event(), -3.0..3.0f64, -2.0..4.0f64, 0.0..360.0f64), 1..250),
        whole in proptest::bool::ANY,
    ) {
        let mut both = Both::new(if whole { FixMove::Whole } else { FixMove::Stay });
        let (mut t_s, mut p, mut flow_deg) = (0.0, Vector2::zeros(), 180.0f64);
        let (mut just_declared, mut over) = (false, false);
        for (event, east, north, nose) in events {
            t_s += if matches!(event, Event::Silence) { 5.1 } else { 0.1 };
            p += Vector2::new(east, north);
            let mut jump = Vector2::zeros();
            match event {
                Event::Turn(deg) => flow_deg = (flow_deg + deg).rem_euclid(360.0),
                Event::Fix(m) => jump.x = m,
                _ => {}
            }
            p += jump;
            let flow = world::units::Heading::from_deg(flow_deg).unit() * 0.2;
            let mut o = smelling(seen(t_s, p, nose, Some(flow)), matches!(event, Event::Smell));
            o.estimate.fix_jump = jump;
            // The layers set out for home in the tick after the declaration: the diagram is a tick ahead.
            let arrived = matches!(event, Event::Arrive) && !just_declared;
            let [a, b] = both.step(&o, arrived);
            prop_assert_eq!(a.declared, b.declared);
            // Compared as sets: Reacquire sorts them again in the tick of the declaration.
            let sorted = |d: &Ticked| {
                let mut points = d.shown.lost_points.clone();
                points.sort_by(|p, q| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)));
                points
            };
            prop_assert_eq!(sorted(&a), sorted(&b));
            prop_assert_eq!(a.outcome, b.outcome);
            over = a.outcome.is_some();
            if over {
                break;
            }
            just_declared = a.declared.is_some();
            if !just_declared {
                prop_assert_eq!(a.behaviour, b.behaviour);
                prop_assert_eq!(a.goal.manoeuvre, b.goal.manoeuvre);
            } else {
                prop_assert_eq!(a.behaviour, Behaviour::GoHome);
            }
        }
        let mut aborted = smelling(seen(t_s + 0.1, p, 0.0, None), true);
        aborted.guidance.aborted = true;
        for d in both.step(&aborted, false) {
            let end = if over { Outcome::Completed } else { Outcome::Aborted };
            prop_assert_eq!((d.behaviour, d.outcome), (Behaviour::Done, Some(end)));
        }
    }
}

/// The property above is not empty: its events reach every behaviour and the declaration.
#[test]
fn a_walk_through_all_behaviours() {
    let mut both = Both::new(FixMove::Stay);
    let (mut t_s, mut done) = (0.0, Vec::new());
    for (north, smells, silence_s, arrived) in [
        (0.0, false, 0.1, false),
        (0.0, true, 0.1, false),
        (9.0, false, 5.1, false),
        (20.0, false, 0.1, true),
        (1.0, true, 0.1, false),
        (9.0, false, 5.1, false),
        (2.0, true, 0.1, false),
        (9.0, false, 5.1, false),
        (20.0, false, 0.1, true),
        (20.0, false, 0.1, false),
        (-250.0, false, 0.1, true),
    ] {
        t_s += silence_s;
        let at = Vector2::new(0.0, north);
        let o = smelling(seen(t_s, at, 350.0, Some(Vector2::new(0.0, -0.2))), smells);
        let [a, b] = both.step(&o, arrived);
        assert_eq!(a.declared, b.declared);
        done.push(b.behaviour);
    }
    use Behaviour::{Done, Find, GoHome, Reacquire, TrackIn, TrackOut};
    let want = [Find, TrackIn, TrackOut, Reacquire, TrackIn, TrackOut, TrackIn, TrackOut, TrackOut, GoHome, Done];
    assert_eq!(done, want);
}
