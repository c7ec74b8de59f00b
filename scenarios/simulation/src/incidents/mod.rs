//! Abnormal events: things that go wrong in a run without ending it. A vehicle leaves its area, an instrument gets no
//! echo, something touches the bed.
//!
//! A system compares the state with what it should be in every tick and keeps an event for each time something went
//! wrong, with its place and duration. Neither the vehicle nor the digest depends on it. For another kind of event
//! add a line to [`IncidentKind`] and to the system `watch` of the searcher. The faults that a scenario injects are told
//! beside them, from their list.

mod dither;
mod faults;

pub(crate) use dither::Switches;
pub(crate) use faults::FaultLog;

use bevy_ecs::prelude::Component;
use nalgebra::Vector3;
use serde::Serialize;

/// A vehicle that is farther outside the area than this has left it, m. It needs this distance to turn at the edge (R
/// of Pang 2009, Table 4).
pub(crate) const OUTSIDE_M: f64 = 10.0;
/// An instrument without an echo for longer than this is blind, s. In turns and dives it misses a few readings.
const BLIND_S: f64 = 10.0;
/// A pause in what must last that does not interrupt it, s.
const BRIEF_S: f64 = 1.0;
/// Thrusters at their limits for longer than this no longer hold what is asked for, s; a turn or a gust takes less.
const STRAINED_S: f64 = 10.0;
/// Two episodes with a shorter pause between them are one event, s.
const CALM_S: f64 = 5.0;
/// Most events of one kind for one robot; later ones prolong the last.
const MOST: usize = 20;

/// A kind of event.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum IncidentKind {
    /// The vehicle was more than 10 m outside the area.
    LeftArea,
    /// Its Doppler log had no echo from the bed.
    NoBottomLock,
    /// Its altimeter had no echo from the bed.
    NoAltitude,
    /// Its current profiler measured no flow.
    NoFlow,
    /// It touched the bed or an obstacle.
    Touched,
    /// It touched another vehicle.
    TouchedVehicle,
    /// A thruster was at its limit: it could not give the force that was asked for.
    ThrustersSaturated,
    /// Its battery was empty.
    BatteryEmpty,
    /// Its behaviours took turns on one spot.
    Dithering,
    /// A fault of the scenario began.
    Fault,
}

impl IncidentKind {
    /// Those that are watched for; faults are known beforehand.
    pub const WATCHED: [Self; 9] = [
        Self::LeftArea,
        Self::NoBottomLock,
        Self::NoAltitude,
        Self::NoFlow,
        Self::Touched,
        Self::TouchedVehicle,
        Self::ThrustersSaturated,
        Self::BatteryEmpty,
        Self::Dithering,
    ];

    /// In words, for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::LeftArea => "left the area",
            Self::NoBottomLock => "no bottom lock",
            Self::NoAltitude => "no altitude",
            Self::NoFlow => "no flow",
            Self::Touched => "touched the bed or an obstacle",
            Self::TouchedVehicle => "touched another vehicle",
            Self::ThrustersSaturated => "thrusters saturated",
            Self::BatteryEmpty => "battery empty",
            Self::Dithering => "behaviours alternated without progress",
            Self::Fault => "fault",
        }
    }

    /// How long it must last to count, s.
    fn patience_s(self) -> f64 {
        match self {
            Self::LeftArea
            | Self::Touched
            | Self::TouchedVehicle
            | Self::BatteryEmpty
            | Self::Dithering
            | Self::Fault => 0.0,
            Self::ThrustersSaturated => STRAINED_S,
            Self::NoBottomLock | Self::NoAltitude | Self::NoFlow => BLIND_S,
        }
    }

    /// How long a pause must be that ends an episode, s; of one that counts as an event, or not yet.
    fn calm_s(self, counts: bool) -> f64 {
        match self {
            Self::ThrustersSaturated if !counts => BRIEF_S,
            _ => CALM_S,
        }
    }
}

/// Something that went wrong for some time.
#[derive(Clone, Debug, PartialEq)]
pub struct Incident {
    /// Id of the robot in the scenario.
    pub robot: String,
    /// The kind of event.
    pub what: IncidentKind,
    /// What failed and how, if it is a fault.
    pub fault: Option<String>,
    /// Beginning, s of mission time.
    pub t_s: f64,
    /// Duration so far, s.
    pub lasted_s: f64,
    /// Whether it is over.
    pub over: bool,
    /// Where it began (ENU), m.
    pub p_W: Vector3<f64>,
}

impl Incident {
    /// What is wrong, in words.
    pub fn describe(&self) -> String {
        match &self.fault {
            Some(fault) => format!("{}: {fault}", self.what.label()),
            None => self.what.label().to_string(),
        }
    }

    /// On one line, for people.
    pub fn line(&self) -> String {
        let p = &self.p_W;
        let lasted = match (self.over, self.lasted_s) {
            (true, s) => format!(", for {s:.1} s"),
            (false, s) if s >= 1.0 => format!(", for {s:.0} s and still so"),
            (false, _) => String::new(),
        };
        format!("{} at {:.1} s, {:.1} m E, {:.1} m N, {:.1} m deep{lasted}", self.describe(), self.t_s, p.x, p.y, -p.z)
    }
}

/// The present event of one kind for one robot.
#[derive(Clone, Copy, Debug, Default)]
struct Episode {
    /// When and where it began.
    began: Option<(f64, Vector3<f64>)>,
    last_s: f64,
    /// Its index among all events, once it lasted long enough to count.
    event: Option<usize>,
    count: usize,
}

/// The present events of a robot. In one place, because runs that share a world exchange it.
#[derive(Component, Clone, Debug, Default)]
pub struct IncidentMonitor {
    episodes: Box<[Episode; IncidentKind::WATCHED.len()]>,
    pub(crate) switches: Switches,
}

impl IncidentMonitor {
    /// Notes whether something is wrong now; `None` if this tick has no reading.
    pub(crate) fn see(
        &mut self,
        what: IncidentKind,
        wrong: Option<bool>,
        robot: &str,
        t_s: f64,
        p_W: Vector3<f64>,
        events: &mut Vec<Incident>,
    ) {
        let episode = &mut self.episodes[what as usize];
        // As a rule nothing is wrong, and nothing was.
        if wrong != Some(true) && episode.began.is_none() {
            return;
        }
        match wrong {
            Some(true) => {
                let (began_s, place) = *episode.began.get_or_insert((t_s, p_W));
                episode.last_s = t_s;
                let lasted_s = t_s - began_s;
                if let Some(event) = episode.event {
                    events[event].lasted_s = t_s - events[event].t_s;
                    events[event].over = false;
                } else if lasted_s >= what.patience_s() {
                    episode.event = Some(events.len());
                    episode.count += 1;
                    events.push(Incident {
                        robot: robot.to_string(),
                        what,
                        fault: None,
                        t_s: began_s,
                        lasted_s,
                        over: false,
                        p_W: place,
                    });
                }
            }
            Some(false) if episode.began.is_some() && t_s - episode.last_s >= what.calm_s(episode.event.is_some()) => {
                episode.began = None;
                if let Some(event) = episode.event {
                    events[event].over = true;
                }
                if episode.count < MOST {
                    episode.event = None;
                }
            }
            Some(false) | None => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The events of one kind, seen once a second.
    fn events(what: IncidentKind, wrong: impl Fn(u32) -> Option<bool>, until_s: u32) -> Vec<(f64, f64, bool)> {
        let (mut lookout, mut events) = (IncidentMonitor::default(), Vec::new());
        for t in 0..until_s {
            let p = Vector3::new(f64::from(t), 0.0, -1.0);
            lookout.see(what, wrong(t), "auv0", f64::from(t), p, &mut events);
        }
        assert!(events.iter().all(|e| e.p_W.x == e.t_s), "where it began");
        events.iter().map(|e| (e.t_s, e.lasted_s, e.over)).collect()
    }

    #[test]
    fn an_event_has_a_beginning_and_a_duration() {
        let between = |from: u32, to: u32| move |t: u32| Some((from..=to).contains(&t));
        let left = IncidentKind::LeftArea;
        assert_eq!(events(left, between(3, 40), 100), [(3.0, 37.0, true)]);
        assert_eq!(events(left, between(90, 200), 100), [(90.0, 9.0, false)]);
        assert_eq!(events(left, |_| Some(false), 100), []);
    }

    #[test]
    fn blindness_counts_only_when_it_lasts_and_from_its_beginning() {
        let lost = IncidentKind::NoBottomLock;
        assert_eq!(events(lost, |t| Some((3..=9).contains(&t)), 100), []);
        assert_eq!(events(lost, |t| Some((3..=20).contains(&t)), 100), [(3.0, 17.0, true)]);
        // Readings that are not due say nothing.
        let seldom = |t: u32| t.is_multiple_of(4).then_some(t >= 8);
        assert_eq!(events(lost, seldom, 41), [(8.0, 32.0, false)]);
    }

    #[test]
    fn thrusters_count_as_saturated_only_if_they_stay_so() {
        let strained = IncidentKind::ThrustersSaturated;
        assert_eq!(events(strained, |t| Some(!t.is_multiple_of(4)), 100), []);
        assert_eq!(events(strained, |t| Some((3..=20).contains(&t)), 100), [(3.0, 17.0, true)]);
        // Once it counts, what comes and goes is still the same event.
        let first = |t: u32| Some(t < 12 || (t < 40 && t.is_multiple_of(3)));
        assert_eq!(events(strained, first, 100), [(0.0, 39.0, true)]);
    }

    #[test]
    fn what_comes_and_goes_is_one_event_and_much_of_it_a_few() {
        let touched = IncidentKind::Touched;
        assert_eq!(events(touched, |t| Some(t < 40 && t % 3 == 0), 100), [(0.0, 39.0, true)]);
        let often = events(touched, |t| Some(t % 20 == 0), 10_000);
        assert_eq!(often.len(), MOST);
        assert_eq!(often[MOST - 1].0, 380.0);
        assert_eq!(often[MOST - 1].0 + often[MOST - 1].1, 9_980.0);
    }
}
