//! Construct-Plume-Map: the likeliest source of the robot's map as a place from which to search.
//!
//! *Source*: Tian et al. 2013, section 2, Construct-Plume-Map, with Farrell, Pang & Li 2003, IEEE Trans. SMC-B 33(6),
//! 850 (the hidden Markov map). Both say how the map is made (the robot's own, `map: Hmm()`), not what the layer
//! commands.
//!
//! *Parameters*: the map counts once 95 % of its probability lie in at most `most_share` of it, 0.25. The destination
//! lies `down_m` down-flow of the likeliest cell, 30 m (the distance over which a plume from the bed rises to the
//! vehicle is not known; two leaves of a reacquisition). The vehicle does not go again to a place nearer than
//! `again_m`, 40 m, to the last one.
//!
//! *Deviations*: what follows is ours. The layer feeds Find. When only Find asks for the vehicle, a detection has
//! gone into the map, and the map is sharp enough, its command replaces that of Find and leads to the likeliest
//! place, once; from there Find continues. It does not command against Maintain or Reacquire. Although Tian lists it
//! above Avoid-Obstacle, its command passes through that layer as Find's would.

use crate::handoff::{Manoeuvre, Observation};
use crate::memory::PlumeMemory;
use crate::places::{MARGIN_M, inside};
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use world::ranges::{Fraction, NonNegative, Positive};

/// Parameters of the layer.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PlumeMapSpec {
    /// The map counts once 95 % of its probability lie in this share of its cells.
    #[default(Fraction::new(0.25))]
    pub most_share: Fraction,
    /// Down-flow of the likeliest cell, m.
    #[default(NonNegative::new(30.0))]
    pub down_m: NonNegative,
    /// The vehicle does not go again to a place nearer than this to the last one, m.
    #[default(Positive::new(40.0))]
    pub again_m: Positive,
}

/// State of the layer.
#[derive(Clone, Debug)]
pub(super) struct PlumeMap {
    params: PlumeMapSpec,
    /// The likeliest place, and the destination for it, as long as the vehicle goes there.
    target: Option<(Vector2<f64>, Vector2<f64>)>,
    visited: Option<Vector2<f64>>,
}

impl PlumeMap {
    pub(super) fn new(spec: &PlumeMapSpec) -> Self {
        Self { params: spec.clone(), target: None, visited: None }
    }

    /// After a detection: what the map knows is new.
    pub(super) fn renew(&mut self) {
        self.visited = None;
    }

    /// Where to go instead of searching from here, and whether that is a new goal.
    pub(super) fn step(
        &mut self,
        seen: &Observation,
        arrived: bool,
        memory: &PlumeMemory,
    ) -> Option<(Manoeuvre, bool)> {
        let again_m = self.params.again_m.get();
        let apart = |a: Option<Vector2<f64>>, b: Vector2<f64>| a.is_none_or(|a| (a - b).norm() >= again_m);
        if arrived && let Some((place, _)) = self.target.take() {
            self.visited = Some(place);
        }
        let best = self.likeliest(seen).filter(|b| apart(self.visited, *b));
        let Some(best) = best else {
            self.target = None;
            return None;
        };
        let known = self.target.filter(|(place, _)| !apart(Some(*place), best));
        let (place, point) = known.unwrap_or_else(|| {
            let down = memory.up_flow_or_nose(seen).opposite().unit();
            let aim = best + down * self.params.down_m.get();
            (best, inside(&seen.area, aim, MARGIN_M))
        });
        self.target = Some((place, point));
        let radius_m = None;
        Some((Manoeuvre::GoToPoint { point, radius_m }, known.is_none()))
    }

    /// The search is interrupted: the target will be chosen anew.
    pub(super) fn drop_target(&mut self) {
        self.target = None;
    }

    /// The likeliest place (east, north), m, if the map knows something.
    fn likeliest(&self, seen: &Observation) -> Option<Vector2<f64>> {
        let belief = seen.belief.as_ref().filter(|b| b.informed)?;
        let cell: f64 = if belief.grid.n[2] == 1 {
            belief.grid.cell_m[..2].iter().product()
        } else {
            belief.grid.cell_m.iter().product()
        };
        let share = belief.credible_95 / (cell * belief.grid.len() as f64);
        (share <= self.params.most_share.get()).then(|| belief.grid.centre(belief.best).xy())
    }
}
