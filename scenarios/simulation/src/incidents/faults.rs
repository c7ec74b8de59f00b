//! Tells of the faults that a scenario injects: when each began, where the robot was, and how long it lasted.

use super::{Incident, IncidentKind};
use bevy_ecs::prelude::Component;
use nalgebra::Vector3;
use robots::faults::{FaultSpec, Span};
use world::clock::Clock;

/// The faults of a robot.
#[derive(Component, Clone, Debug, Default)]
pub(crate) struct FaultLog(Vec<FaultEpisode>);

/// A fault and its event.
#[derive(Clone, Debug)]
struct FaultEpisode {
    span: Span,
    words: String,
    /// Its index among all events, once it began.
    event: Option<usize>,
}

impl FaultLog {
    /// Those of a robot; steps take `dt_s`.
    pub(crate) fn new(faults: &[FaultSpec], dt_s: f64) -> Self {
        let told =
            |fault: &FaultSpec| FaultEpisode { span: fault.span(dt_s), words: fault.what.describe(), event: None };
        Self(faults.iter().map(told).collect())
    }

    /// Notes which faults hold now, of a robot that is at `p_W`.
    pub(crate) fn see(&mut self, clock: &Clock, robot: &str, p_W: Vector3<f64>, events: &mut Vec<Incident>) {
        let t_s = clock.t_s();
        for fault in &mut self.0 {
            if fault.event.is_none() && fault.span.holds(clock) {
                fault.event = Some(events.len());
                events.push(Incident {
                    robot: robot.to_string(),
                    what: IncidentKind::Fault,
                    fault: Some(fault.words.clone()),
                    t_s,
                    lasted_s: 0.0,
                    over: false,
                    p_W,
                });
            }
            if let Some(event) = fault.event.map(|n| &mut events[n])
                && !event.over
            {
                event.lasted_s = t_s - event.t_s;
                event.over = fault.span.is_over(clock);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use robots::faults::{Faulty, HeadingFault};
    use world::ranges::{NonNegative, Positive};

    #[test]
    fn a_fault_is_told_from_its_beginning_to_its_end() {
        let spec = |at_s: f64, until_s: Option<f64>, how| FaultSpec {
            at_s: NonNegative::new(at_s),
            until_s: until_s.map(Positive::new),
            what: Faulty::Compass(how),
        };
        let faults = [
            spec(2.0, Some(5.0), HeadingFault::Stuck),
            spec(6.0, None, HeadingFault::Silent),
            spec(50.0, None, HeadingFault::Stuck),
        ];
        let (mut log, mut events) = (FaultLog::new(&faults, 0.5), Vec::new());
        let mut clock = Clock::new(0.5);
        for _ in 0..21 {
            let p_W = Vector3::new(clock.t_s(), 0.0, -1.0);
            log.see(&clock, "auv0", p_W, &mut events);
            clock.advance();
        }
        let lines: Vec<String> = events.iter().map(Incident::line).collect();
        assert_eq!(
            lines,
            [
                "fault: compass stuck at 2.0 s, 2.0 m E, 0.0 m N, 1.0 m deep, for 3.0 s",
                "fault: compass silent at 6.0 s, 6.0 m E, 0.0 m N, 1.0 m deep, for 4 s and still so",
            ]
        );
    }
}
