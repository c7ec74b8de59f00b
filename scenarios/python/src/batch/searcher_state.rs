//! One searcher of one environment: its newest observation, and the order that an action means for it.

use super::Rules;
use super::agent::{Agent, Machine};
use nalgebra::Vector2;
use rheotaxis::control::{Question, QuestionContent, ReadingsSince};
use rheotaxis::trial::Trial;
use robots::handoff::{
    Behaviour, Declaration, GantryLayout, GantryObservation, HeadOrder, Manoeuvre, MotionOrder, MoveOrder, Observation,
    Outcome, Reply, Vertical,
};

/// Time since a hit after which it does not matter how long it was, s.
const LONG_AGO_S: f64 = 600.0;
/// A vehicle is not asked to go nearer to the bed than this, m.
const LEAST_ALTITUDE_M: f64 = 0.5;

/// The truth about a searcher, for rewards and scores.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TruthOf {
    /// Place (ENU), m; of a gantry that of its head.
    pub(crate) p_W: [f64; 3],
    /// Heading, rad; of a gantry that of its base.
    pub(crate) heading_rad: f64,
    /// Horizontal distance to the nearest source, m.
    pub(crate) distance_m: f64,
    /// The least such distance in this episode, m.
    pub(crate) closest_m: f64,
}

/// A searcher.
#[derive(Clone, Debug)]
pub(crate) struct SearcherState {
    /// Its newest observation.
    pub(crate) features: Vec<f32>,
    /// The truth at that time.
    pub(crate) truth: TruthOf,
    /// Whether it has asked and was not answered.
    pub(crate) asks: bool,
    seen: Option<QuestionContent>,
    t_s: f64,
    /// Depth or altitude that it is to keep, m.
    height_m: Option<f64>,
}

impl SearcherState {
    /// Before its first question.
    pub(crate) fn new(agent: &Agent) -> Self {
        Self {
            features: vec![0.0; agent.features.len()],
            truth: TruthOf { closest_m: f64::INFINITY, distance_m: f64::INFINITY, ..TruthOf::default() },
            asks: false,
            seen: None,
            t_s: 0.0,
            height_m: None,
        }
    }

    /// Takes a question; `began_s` is when its episode began.
    pub(crate) fn see(&mut self, rules: &Rules, agent: &Agent, question: Question, began_s: f64) {
        self.asks = true;
        self.t_s = question.t_s;
        let time = ((question.t_s - began_s) / rules.limit_s).clamp(0.0, 1.0);
        match (&question.seen, &agent.machine) {
            (QuestionContent::Robot(seen, gathered), _) => self.see_robot(seen, gathered, time),
            (QuestionContent::Gantry(seen, gathered), Machine::Gantry { layout, .. }) => {
                self.see_gantry(seen, gathered, layout, time);
            }
            _ => unreachable!("a robot asks as a robot"),
        }
        for (value, bound) in self.features.iter_mut().zip(&agent.features) {
            *value = value.clamp(bound.low, bound.high);
        }
        self.seen = Some(question.seen);
    }

    fn see_robot(&mut self, seen: &Observation, gathered: &ReadingsSince, time: f64) {
        let e = &seen.estimate;
        let heading = e.attitude.heading;
        let left = heading.turned(-std::f64::consts::FRAC_PI_2).unit();
        let share = |n: f64| n / f64::from(gathered.readings.max(1));
        let newest = gathered.chemical.map(|c| c.of_full_scale);
        let since = gathered.detected_s.map_or(LONG_AGO_S, |then| self.t_s - then);
        let flow = e.flow.map(|f| f.velocity);
        let along = |v: Vector2<f64>| [v.dot(&heading.unit()), v.dot(&left)];
        let [forward, aside] = flow.map_or([0.0; 2], along);
        let away = (e.position - seen.home) / (0.5 * seen.area.length_m);
        let nose = heading.unit();
        let numbers = [
            newest.unwrap_or(f64::from(self.features[0])),
            share(gathered.sum),
            gathered.highest,
            share(f64::from(gathered.detections)),
            since / LONG_AGO_S,
            forward,
            aside,
            f64::from(u8::from(flow.is_some())),
            nose.x,
            nose.y,
            e.v_ground_body.x,
            e.v_ground_body.y,
            e.altitude_m.unwrap_or(0.0) / 10.0,
            e.depth_m / 10.0,
            away.x,
            away.y,
            time,
        ];
        self.features = numbers.map(|v| v as f32).to_vec();
    }

    fn see_gantry(&mut self, seen: &GantryObservation, gathered: &ReadingsSince, layout: &GantryLayout, time: f64) {
        let joints = &seen.readings.joints;
        let share = |axis: usize| {
            let [low, high] = layout.travel_m[axis];
            2.0 * (joints.position_m[axis] - low) / (high - low) - 1.0
        };
        let [low_v, high_v] = layout.range_v;
        let of_full = |volts: f64| ((volts - low_v) / (high_v - low_v)) as f32;
        let probes = layout.probes.len();
        let fixed =
            [share(0), share(1), f64::from(u8::from(joints.arrived)), f64::from(u8::from(joints.blocked)), time];
        let kept = self.features.split_off(fixed.len());
        self.features = fixed.map(|v| v as f32).to_vec();
        let newest = gathered.scans.last();
        for (n, before) in kept.iter().enumerate().take(probes) {
            (self.features).push(newest.map_or(*before, |s| of_full(s.volts[n])));
        }
        for n in 0..probes {
            let all = gathered.scans.iter().map(|s| of_full(s.volts[n]));
            self.features.push(all.fold(0.0, f32::max));
        }
    }

    /// The answer that an action means: numbers from −1 to 1, of which the last declares if the rules say so.
    pub(crate) fn answer(&mut self, rules: &Rules, agent: &Agent, action: &[f64]) -> Reply {
        self.asks = false;
        let declares = rules.declare && action.last().is_some_and(|d| *d > 0.5);
        let moved = action.iter().map(|a| a.clamp(-1.0, 1.0));
        let moved: Vec<f64> = moved.collect();
        let Some(seen) = self.seen.take() else {
            return Reply::default();
        };
        match (&seen, &agent.machine) {
            (QuestionContent::Robot(seen, _), Machine::Robot { altitude }) => {
                if declares {
                    let position = seen.estimate.position;
                    return Reply {
                        declared: Some(Declaration::first(self.t_s, position, "external")),
                        outcome: Some(Outcome::Completed),
                        ..Reply::default()
                    };
                }
                let order = self.move_order(rules, seen, *altitude, &moved);
                Reply { order: Some(MotionOrder::Move(order)), ..Reply::default() }
            }
            (QuestionContent::Gantry(seen, _), Machine::Gantry { layout, .. }) => {
                let reach = |axis: usize| moved[axis] * layout.max_speed_m_s[axis] * rules.period_s;
                let here = seen.readings.joints.position_m;
                Reply {
                    order: (!declares).then_some(MotionOrder::Head(HeadOrder {
                        id: None,
                        target_m: here + Vector2::new(reach(0), reach(1)),
                        speed_m_s: None,
                        behaviour: Behaviour::StepUp,
                    })),
                    outcome: declares.then_some(Outcome::Completed),
                    ..Reply::default()
                }
            }
            _ => Reply::default(),
        }
    }

    fn move_order(&mut self, rules: &Rules, seen: &Observation, altitude: bool, action: &[f64]) -> MoveOrder {
        let e = &seen.estimate;
        let [low, high] = (rules.speed_m_s).unwrap_or([seen.able.least_speed_m_s, seen.able.top_speed_m_s]);
        // The set-point follows the actions, not the vehicle's lag; it does not run away from the vehicle.
        let here = if altitude { e.altitude_m } else { Some(e.depth_m) };
        let least = if altitude { LEAST_ALTITUDE_M } else { 0.0 };
        let near = 3.0 * rules.climb_m;
        if let Some(here) = here {
            let wanted = self.height_m.unwrap_or(here) + action[1] * rules.climb_m;
            self.height_m = Some(wanted.clamp(here - near, here + near).max(least));
        }
        let set = |m: f64| {
            if altitude { Vertical::Altitude(m) } else { Vertical::Depth(m) }
        };
        MoveOrder {
            id: None,
            manoeuvre: Manoeuvre::Steer { heading: e.attitude.heading.turned(action[0] * rules.turn_rad) },
            vertical: self.height_m.filter(|_| seen.able.dives).map(set),
            speed_m_s: Some(low + 0.5 * (action[2] + 1.0) * (high - low)),
        }
    }

    /// Looks at the truth.
    pub(crate) fn look(&mut self, agent: &Agent, trial: &Trial) {
        let (place, heading) = match (&agent.machine, &self.seen) {
            (Machine::Gantry { base, .. }, Some(QuestionContent::Gantry(seen, _))) => {
                let joints = seen.readings.joints.position_m;
                (Agent::head_W(base, joints.into()), base.heading())
            }
            (Machine::Robot { .. }, _) => match trial.truth(&agent.id) {
                Some(truth) => (truth.pose.p_WB, truth.pose.heading()),
                None => return,
            },
            _ => return,
        };
        let sources = trial.simulation.ocean().sources();
        let away = sources.iter().map(|s| (s - place).xy().norm());
        let score = trial.score().searchers.iter().find(|s| s.id == agent.id);
        let scored_m = score.map_or(f64::INFINITY, |s| s.closest_m);
        let distance_m = away.fold(f64::INFINITY, f64::min);
        self.truth = TruthOf {
            p_W: place.into(),
            heading_rad: heading.rad(),
            distance_m,
            closest_m: self.truth.closest_m.min(distance_m).min(scored_m),
        };
    }
}
