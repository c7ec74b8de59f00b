//! A gantry's path in a run, from the end of the first sweep to its stop.
//!
//! *Source*: the figures of Webster, Volyanskyy & Weissburg 2012, section 5 and Fig. 11: time, speed, NGDR, and speed
//! and distance from the centreline 100-50 cm and 50-0 cm from the source.
//!
//! *Deviations*: the paper's path begins at "the initial tracker position"; ours begins with the first step up-stream,
//! because with a metre of sweep in the path, the reported NGDR of 0.7 would be impossible.

use super::{DeclarationSummary, SourceTruth};
use nalgebra::Vector2;
use rheotaxis::gantry::GantryFrame;
use rheotaxis::score::{Consultations, SearcherScore};
use robots::handoff::Behaviour;
use serde::Serialize;

/// Ranges of distance to the source along the stream that Fig. 11 compares, m.
const FAR_M: [f64; 2] = [0.5, 1.0];
const NEAR_M: [f64; 2] = [0.0, 0.5];

/// A path being followed.
#[derive(Clone, Debug, Default)]
pub struct GantryPath {
    id: String,
    forward: Vector2<f64>,
    /// Time and true place of the head (east, north), from the first step up-stream to the stop.
    track: Vec<(f64, Vector2<f64>)>,
    last: Vector2<f64>,
    swept: bool,
    sweep_s: Option<f64>,
    steps: u32,
    casts: u32,
    sweeps: u32,
    latest: u32,
    blocked: bool,
    stopped: Option<bool>,
}

/// The results of a gantry.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct GantrySummary {
    /// Its id in the scenario.
    pub id: String,
    /// How it ended: true if it declared a source, false if it gave up, `None` if it did neither.
    pub stopped: Option<bool>,
    /// How often it asked a searcher outside the program; `None` if it never did.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub consulted: Option<Consultations>,
    /// Its declaration.
    pub declaration: Option<DeclarationSummary>,
    /// End of its first sweep, s.
    pub sweep_s: Option<f64>,
    /// Time of the first spike, s.
    pub first_spike_s: Option<f64>,
    /// Number of scans with a spike on any probe.
    pub spikes: u64,
    /// Number of steps up-stream, casts and full sweeps.
    pub moves: [u32; 3],
    /// Whether a drive gave up against an obstacle.
    pub blocked: bool,
    /// Length of the whole path, m.
    pub travelled_m: f64,
    /// Length of the path from the first step up-stream, m.
    pub tracked_m: Option<f64>,
    /// Speed along that path, m/s.
    pub speed_m_s: Option<f64>,
    /// Straight distance divided by path length, from the first step up-stream.
    pub ngdr: Option<f64>,
    /// Speed at 1 to 0.5 m, and at 0.5 to 0 m, from the source along the stream, m/s.
    pub speed_far_near_m_s: [Option<f64>; 2],
    /// Mean distance from the line along the stream through the source, in the same ranges, m.
    pub offset_far_near_m: [Option<f64>; 2],
}

impl GantryPath {
    /// Begins with the first frame.
    pub fn new(g: &GantryFrame) -> Self {
        Self { id: g.id.clone(), forward: g.forward, last: g.head_W.xy(), ..Self::default() }
    }

    /// Adds the next frame.
    pub fn observe(&mut self, t_s: f64, g: &GantryFrame) {
        let head = g.head_W.xy();
        self.last = head;
        if g.goal.id != self.latest {
            self.latest = g.goal.id;
            match g.behaviour {
                Behaviour::StepUp => self.steps += 1,
                Behaviour::Cast => self.casts += 1,
                Behaviour::Sweep => self.sweeps += 1,
                _ => {}
            }
        }
        match g.behaviour {
            Behaviour::Sweep => self.swept = true,
            Behaviour::Idle => {}
            _ if self.swept => {
                self.sweep_s.get_or_insert(t_s);
            }
            _ => {}
        }
        let tracking = matches!(g.behaviour, Behaviour::StepUp | Behaviour::Cast);
        if self.stopped.is_none() && (tracking || !self.track.is_empty()) {
            self.track.push((t_s, head));
        }
        self.blocked |= g.readings.blocked;
        self.stopped = self.stopped.or(g.stopped());
    }

    /// Its id in the scenario.
    pub fn id(&self) -> &str {
        &self.id
    }

    /// The results, what it declared compared with the true sources.
    pub fn summary(&self, score: &SearcherScore, sources: &[SourceTruth]) -> GantrySummary {
        let nearest = |s: &&SourceTruth| (s.position.xy() - self.last).norm();
        let source = sources.iter().min_by(|a, b| nearest(a).total_cmp(&nearest(b)));
        let way = self.track.first().zip(self.track.last());
        let tracked_m = way.map(|_| length(self.track.windows(2)));
        let in_range = |range: [f64; 2]| -> (Option<f64>, Option<f64>) {
            source.map_or((None, None), |s| self.within(s.position.xy(), range))
        };
        let (far, near) = (in_range(FAR_M), in_range(NEAR_M));
        GantrySummary {
            id: self.id.clone(),
            stopped: self.stopped,
            consulted: score.consulted,
            declaration: (score.declarations.first()).map(|d| DeclarationSummary::compare(d, sources)),
            sweep_s: self.sweep_s,
            first_spike_s: score.first_detection_s,
            spikes: score.detections,
            moves: [self.steps, self.casts, self.sweeps],
            blocked: self.blocked,
            travelled_m: score.travelled_m,
            tracked_m,
            speed_m_s: way.zip(tracked_m).and_then(|((a, b), m)| ratio(m, b.0 - a.0)),
            ngdr: way.zip(tracked_m).and_then(|((a, b), m)| ratio((b.1 - a.1).norm(), m)),
            speed_far_near_m_s: [far.0, near.0],
            offset_far_near_m: [far.1, near.1],
        }
    }

    /// Speed, and mean distance from that line, while the distance to the source along the stream is in a range.
    fn within(&self, source: Vector2<f64>, [from, to]: [f64; 2]) -> (Option<f64>, Option<f64>) {
        let inside = |p: &Vector2<f64>| (from..to).contains(&(source - p).dot(&self.forward));
        let pieces = || self.track.windows(2).filter(|w| inside(&w[0].1) && inside(&w[1].1));
        let time: f64 = pieces().map(|w| w[1].0 - w[0].0).sum();
        let off = |p: &Vector2<f64>| (source - p).perp(&self.forward).abs();
        let area: f64 = pieces().map(|w| off(&w[0].1) * (w[1].0 - w[0].0)).sum();
        (ratio(length(pieces()), time), ratio(area, time))
    }
}

fn length<'a>(pieces: impl Iterator<Item = &'a [(f64, Vector2<f64>)]>) -> f64 {
    pieces.map(|w| (w[1].1 - w[0].1).norm()).sum()
}

fn ratio(a: f64, b: f64) -> Option<f64> {
    (b > 0.0).then(|| a / b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample_gantry as sample;
    use nalgebra::Vector3;
    use rheotaxis::score::Score;

    /// Along a dog-leg: 0.6 m up-stream 0.1 m beside the line, then 0.3 m on it at twice the speed.
    #[test]
    fn figures_of_a_path_drawn_by_hand() {
        let position = Vector3::new(0.0, 0.0, -0.162);
        let source = SourceTruth { id: "nozzle".into(), position, flow: Vector2::new(0.05, 0.0) };
        let at = |t_s: f64, x: f64, y: f64, behaviour| (t_s, sample::gantry(x, y, behaviour));
        let line = |k: f64| 0.999 - 0.03 * k;
        let mut frames = vec![
            at(0.0, 1.0, -0.4, Behaviour::Sweep),
            at(20.0, 1.0, 0.4, Behaviour::Sweep),
            at(21.0, 1.0, 0.4, Behaviour::ToBest),
        ];
        let slow = (0..20).map(f64::from).map(|k| at(30.0 + k, line(k), 0.1, Behaviour::StepUp));
        frames.extend(slow);
        let fast = (1..=5).map(f64::from).map(|k| at(49.0 + k, line(19.0) - 0.06 * k, 0.1, Behaviour::StepUp));
        frames.extend(fast);
        let mut path = GantryPath::new(&frames[0].1);
        for (t_s, g) in &frames {
            path.observe(*t_s, g);
        }
        let mut score = Score::default();
        score.join(path.id());
        let said = path.summary(&score.searchers[0], &[source]);
        assert_eq!(said.sweep_s, Some(21.0));
        let near = |a: Option<f64>, b: f64| assert!((a.unwrap() - b).abs() < 1e-9, "{a:?} {b}");
        near(said.tracked_m, 19.0 * 0.03 + 0.3);
        near(said.ngdr, 1.0);
        near(said.speed_m_s, 0.87 / 24.0);
        near(said.speed_far_near_m_s[0], 0.03);
        assert!(said.speed_far_near_m_s[1].unwrap() > 0.03);
        near(said.offset_far_near_m[0], 0.1);
    }
}
