//! Searches for the plume on parallel lines across the area, from its down-flow end to its up-flow end and back.
//!
//! *Source*: complete coverage, the floor against which plume tracing is compared, as in Tholen et al. 2022 (J. Mar.
//! Sci. Eng. 10).
//!
//! *Parameters*: distance between lines, `spacing_m`, m, 24: the turning circle of a REMUS.
//!
//! *Deviations*: lines lie across that one of the area's axes which lies nearer to the flow; as long as no flow is
//! known, across the longer one.

use super::behaviour::BehaviourParams;
use super::{Behave, Stride};
use crate::error::RobotError;
use crate::handoff::{Manoeuvre, Observation};
use crate::memory::PlumeMemory;
use crate::places::MARGIN_M;
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::area::Area;
use world::catalogue::Entry;
use world::ranges::Positive;
use world::registry::Listed;
use world::seeds::Stream;
use world::units::Heading;

/// Parameters of the behaviour.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "LawnmowerParams")]
#[serde(deny_unknown_fields, default)]
pub(super) struct Params {
    /// Distance between lines, m.
    #[default(Positive::new(24.0))]
    pub spacing_m: Positive,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "Lawnmower",
        what: "find: parallel lines across the area, from its down-flow end to its up-flow end and back",
        source: "complete coverage; Tholen et al. 2022, J. Mar. Sci. Eng. 10",
    };
}

impl BehaviourParams for Params {
    fn build(&self) -> Result<Box<dyn Behave>, RobotError> {
        Ok(Box::new(Lawnmower { spacing_m: self.spacing_m.get(), corners: Vec::new(), next: 0 }))
    }
}

/// State of the behaviour: the corners of one way up-flow, and the next one, counted to and fro.
#[derive(Debug)]
struct Lawnmower {
    spacing_m: f64,
    corners: Vec<Vector2<f64>>,
    next: usize,
}

/// The ends of the lines, most down-flow first.
fn corners(area: &Area, up_flow: Option<Heading>, spacing_m: f64) -> Vec<Vector2<f64>> {
    let axis = area.axis.unit();
    let up = up_flow.map_or_else(|| if area.length_m >= area.width_m { axis } else { axis.yx() }, |u| u.unit());
    let axes = [axis, Vector2::new(-axis.y, axis.x)];
    let along = usize::from(up.dot(&axes[1]).abs() > up.dot(&axes[0]).abs());
    let half = [area.length_m, area.width_m].map(|m| (m / 2.0 - MARGIN_M).max(0.0));
    let (far, wide) = (half[along], half[1 - along]);
    let lines = (2.0 * far / spacing_m).ceil() as usize;
    let sense = if up.dot(&axes[along]) < 0.0 { -1.0 } else { 1.0 };
    let mut ends = Vec::new();
    for k in 0..=lines {
        let share = if lines == 0 { 0.5 } else { k as f64 / lines as f64 };
        let middle = area.centre + axes[along] * (sense * far * (2.0 * share - 1.0));
        let side = if k % 2 == 0 { wide } else { -wide };
        ends.extend([middle + axes[1 - along] * side, middle - axes[1 - along] * side]);
    }
    ends
}

impl Behave for Lawnmower {
    fn enter(&mut self, _: &Observation, _: &PlumeMemory) {
        self.corners.clear();
    }

    fn step(&mut self, seen: &Observation, arrived: bool, memory: &mut PlumeMemory, _: &mut Stream) -> Stride {
        if self.corners.is_empty() {
            (self.corners, self.next) = (corners(&seen.area, memory.up_flow, self.spacing_m), 0);
        } else if arrived {
            self.next = (self.next + 1) % (2 * self.corners.len());
        } else {
            return Stride::Keep;
        }
        let last = self.corners.len() - 1;
        let place = if self.next > last { 2 * last + 1 - self.next } else { self.next };
        Stride::Start(Manoeuvre::GoToPoint { point: self.corners[place], radius_m: None })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::behave::testing::{memory, point, step, v};
    use crate::handoff::testing::seen;

    fn flown(up_deg: f64, spacing_m: f64, n: usize) -> Vec<Vector2<f64>> {
        let params = Params { spacing_m: Positive::new(spacing_m) };
        let (mut b, mut m) = (params.build().expect("legal"), memory(Some(up_deg), &[]));
        let o = seen(0.0, v(0.0, 0.0), 0.0, None);
        b.enter(&o, &m);
        let mut next = |k: usize| match step(&mut *b, &o, k > 0, &mut m) {
            Stride::Start(to) => point(&to),
            other => panic!("a corner, got {other:?}"),
        };
        (0..n).map(&mut next).collect()
    }

    #[test]
    fn from_the_down_flow_end_to_the_up_flow_end_and_back() {
        // The area is 600 m from south to north and 400 m wide. Up-flow is south: the first line lies in the north.
        let way = flown(170.0, 290.0, 12);
        let norths: Vec<f64> = way.iter().map(|p| p.y).collect();
        let want = [290.0, 290.0, 0.0, 0.0, -290.0, -290.0, -290.0, -290.0, 0.0, 0.0, 290.0, 290.0];
        assert!(norths.iter().zip(want).all(|(n, w)| (n - w).abs() < 1e-9), "{norths:?}");
        assert!(way.iter().all(|p| (p.x.abs() - 190.0).abs() < 1e-9));
        assert!(way.windows(2).take(5).all(|w| (w[1] - w[0]).norm() > 1.0), "no line twice");
    }

    /// Every place of the area lies within half a spacing and the margin of a line.
    #[test]
    fn lines_cover_the_area_whatever_the_flow() {
        for up_deg in [0.0, 80.0, 200.0, 275.0] {
            let way = flown(up_deg, 24.0, 60);
            for place in [v(-195.0, -295.0), v(33.0, 21.0), v(195.0, 100.0)] {
                let near = way.windows(2).map(|w| {
                    let d = w[1] - w[0];
                    let share = ((place - w[0]).dot(&d) / d.norm_squared().max(1e-12)).clamp(0.0, 1.0);
                    (place - w[0] - d * share).norm()
                });
                assert!(near.fold(f64::INFINITY, f64::min) < 12.0 + MARGIN_M, "{up_deg}: {place:?}");
            }
        }
    }
}
