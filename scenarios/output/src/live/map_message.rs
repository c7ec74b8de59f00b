//! A belief as a message: packed probabilities, made coarser if the message would be too large. Also how often it is
//! sent.

use super::message::Message;
use rheotaxis::frame::{Frame, RobotFrame};
use rheotaxis::topic::chunk;
use rheotaxis::topic::run::{DTYPE, MapMessage};
use robots::handoff::Belief;
use std::collections::BTreeMap;
use std::time::{Duration, Instant};
use world::units::Heading;

/// No map message has more cells, so that it stays below 1 MB.
const MOST_CELLS: usize = 200_000;

/// A robot's map.
fn map(id: &str, b: &Belief) -> Message {
    let (cells, times, p) = coarsened(b);
    let grid = &b.grid;
    let cell_m = [0, 1, 2].map(|a| grid.cell_m[a] * times[a] as f64);
    let header = MapMessage {
        t_s: b.t_s,
        updates: b.updates,
        informed: b.informed,
        cells,
        cell_m,
        corner_m: grid.corner.into(),
        axis_heading_rad: Heading::from_vector(grid.axes[0]).rad(),
        best_m: grid.centre(b.best).into(),
        entropy_nat: b.entropy_nat,
        credible_95: b.credible_95,
        dtype: DTYPE,
    };
    let key = format!("map/{}", chunk(id));
    Message::numbers(key, p.iter().map(|v| *v as f32), &header)
}

/// Number of cells, how many of the map's own cells form one of them along each axis, and the probability of each.
/// Cells are merged in pairs along their finest axis until they fit.
fn coarsened(b: &Belief) -> ([usize; 3], [usize; 3], Vec<f64>) {
    let n = b.grid.n;
    let mut times = [1; 3];
    let count = |times: [usize; 3]| [0, 1, 2].map(|a| n[a].div_ceil(times[a]));
    while count(times).iter().product::<usize>() > MOST_CELLS {
        let most = count(times);
        let axis = (0..3).fold(0, |m, a| if most[a] > most[m] { a } else { m });
        times[axis] *= 2;
    }
    let cells = count(times);
    let mut p = vec![0.0; cells.iter().product()];
    for (i, v) in b.p.iter().enumerate() {
        let place = b.grid.place(i);
        let [x, y, z] = [0, 1, 2].map(|a| place[a] / times[a]);
        p[(z * cells[1] + y) * cells[0] + x] += v;
    }
    (cells, times, p)
}

/// Lets a map pass if it is new and the last one is old enough.
#[derive(Debug)]
pub(super) struct MapGate {
    period: Duration,
    due: Option<Instant>,
    sent: BTreeMap<String, u64>,
}

impl MapGate {
    pub(super) fn new(period: Duration) -> Self {
        Self { period, due: None, sent: BTreeMap::new() }
    }

    /// The maps of a state that are to be sent now; at the `end`, all that are new.
    #[expect(
        clippy::disallowed_methods,
        reason = "the rate is one of wall time, and what publishes cannot reach the run"
    )]
    pub(super) fn due(&mut self, frame: &Frame, end: bool) -> Vec<Message> {
        let now = Instant::now();
        if !end && self.due.is_some_and(|due| now < due) {
            return Vec::new();
        }
        let fresh = |r: &RobotFrame, b: &Belief| self.sent.get(&r.id) != Some(&b.updates);
        let maps: Vec<_> =
            (frame.robots.iter()).filter_map(|r| Some((r, r.belief.as_ref()?))).filter(|(r, b)| fresh(r, b)).collect();
        if maps.is_empty() {
            return Vec::new();
        }
        self.due = Some(now + self.period);
        for (r, b) in &maps {
            self.sent.insert(r.id.clone(), b.updates);
        }
        maps.into_iter().map(|(r, b)| map(&r.id, b)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::message::tests::frame;
    use super::*;
    use robots::handoff::BeliefGrid;
    use serde_json::{Value, json};
    use std::sync::Arc;
    use world::area::Area;

    fn belief(n: [usize; 3]) -> Belief {
        let area = Area {
            centre: nalgebra::Vector2::new(50.0, 50.0),
            length_m: 100.0,
            width_m: 80.0,
            axis: Heading::from_deg(90.0),
        };
        let grid = BeliefGrid::over(&area, 0.0, 10.0, n);
        let total = (grid.len() * (grid.len() + 1) / 2) as f64;
        Belief {
            t_s: 3.0,
            updates: 7,
            informed: true,
            p: Arc::new((1..=grid.len()).map(|i| i as f64 / total).collect()),
            best: grid.len() - 1,
            entropy_nat: 1.0,
            credible_95: 100.0,
            odour: None,
            outlook: None,
            grid: Arc::new(grid),
        }
    }

    #[test]
    fn a_map_is_packed_with_the_first_axis_fastest() {
        let b = belief([4, 2, 1]);
        let m = map("auv0", &b);
        assert_eq!(m.key, "map/auv0");
        let header: Value = serde_json::from_slice(&m.attachment.unwrap()).unwrap();
        assert_eq!(header["cells"], json!([4, 2, 1]));
        assert_eq!(header["cell_m"], json!([25.0, 40.0, 10.0]));
        assert_eq!(header["best_m"], json!([87.5, 70.0, -5.0]));
        let third = f32::from_le_bytes(m.payload[8..12].try_into().unwrap());
        assert_eq!((m.payload.len(), third), (32, 3.0 / 36.0));
    }

    #[test]
    fn a_map_too_large_for_a_message_is_coarsened_and_loses_nothing() {
        let b = belief([201, 151, 21]);
        let m = map("auv0", &b);
        assert!(m.payload.len() <= 4 * MOST_CELLS, "{}", m.payload.len());
        let total: f64 =
            (m.payload.chunks_exact(4)).map(|c| f64::from(f32::from_le_bytes(c.try_into().unwrap()))).sum();
        // 2e5 numbers rounded to f32.
        assert!((total - 1.0).abs() < 1e-6, "{total}");
    }

    #[test]
    fn a_map_is_sent_when_new_and_always_at_the_end() {
        let mut state = frame(0);
        let mut gate = MapGate::new(Duration::from_secs(3600));
        assert!(gate.due(&state, false).is_empty());
        state.robots[0].belief = Some(belief([4, 2, 1]));
        assert_eq!(gate.due(&state, false).len(), 1);
        state.robots[0].belief.as_mut().unwrap().updates = 8;
        assert!(gate.due(&state, false).is_empty());
        assert_eq!(gate.due(&state, true).len(), 1);
        assert!(gate.due(&state, true).is_empty());
    }
}
