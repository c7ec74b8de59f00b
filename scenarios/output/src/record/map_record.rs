//! Maps of where the source may be, in the recording: when they are recorded, and in which form.
//!
//! They are `PointCloud2` with one point for each cell and its `probability`. Foxglove's 3D panel, Lichtblick and Rerun
//! colour points by a field, in the plane and in space. They show small probabilities, which an `OccupancyGrid` of
//! whole per cents would lose. Cells below a millionth of the largest are omitted.

use nalgebra::Vector2;
use robots::handoff::Belief;

/// Cells below this share of the largest are omitted.
const LEAST_SHARE: f64 = 1e-6;

/// Names of a point's values.
pub(super) const FIELDS: [&str; 5] = ["x", "y", "z", "probability", "share_of_largest"];

/// One point for each cell: place (east and north of the centre of the area, up; m), probability, and probability as a
/// share of the largest.
pub(super) fn points(b: &Belief, centre: Vector2<f64>) -> Vec<[f32; 5]> {
    let most = b.p[b.best];
    let kept = b.p.iter().enumerate().filter(|(_, p)| **p >= LEAST_SHARE * most);
    kept.map(|(i, p)| {
        let c = b.grid.centre(i);
        [c.x - centre.x, c.y - centre.y, c.z, *p, p / most].map(|v| v as f32)
    })
    .collect()
}

/// Which maps of a robot are recorded: the first, then one per period if it is new, and the last.
#[derive(Clone, Debug, Default)]
pub(super) struct MapTimes {
    next_s: Option<f64>,
    written: Option<u64>,
    waiting: Option<Belief>,
}

impl MapTimes {
    /// The map, if it is to be recorded now.
    pub(super) fn due(&mut self, t_s: f64, period_s: f64, belief: &Belief) -> Option<Belief> {
        if self.written == Some(belief.updates) {
            return None;
        }
        if self.next_s.is_some_and(|next| t_s < next) {
            self.waiting = Some(belief.clone());
            return None;
        }
        self.next_s = Some(t_s + period_s);
        self.written = Some(belief.updates);
        self.waiting = None;
        Some(belief.clone())
    }

    /// The last map, if it has not been recorded.
    pub(super) fn last(&mut self) -> Option<Belief> {
        self.waiting.take()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::belief;

    #[test]
    fn one_a_period_and_the_last() {
        let mut times = MapTimes::default();
        let mut b = belief(0.0);
        let mut recorded = Vec::new();
        for t in 0..25 {
            b.updates = t;
            recorded.extend(times.due(t as f64, 10.0, &b).map(|b| b.updates));
        }
        recorded.extend(times.last().map(|b| b.updates));
        assert_eq!(recorded, [0, 10, 20, 24]);
        assert!(times.last().is_none());
    }

    #[test]
    fn points_carry_the_probability_of_their_cell() {
        let b = belief(50.0);
        let points = points(&b, Vector2::zeros());
        let most = points.iter().max_by(|a, b| a[3].total_cmp(&b[3])).unwrap();
        let c = b.grid.centre(b.best);
        assert_eq!(most[..3], [c.x as f32, c.y as f32, c.z as f32]);
        assert_eq!(most[4], 1.0);
        let kept: f64 = points.iter().map(|p| f64::from(p[3])).sum();
        assert!((kept - 1.0).abs() < 1e-3 && points.len() < b.p.len());
    }
}
