//! Draws a place of the source from the belief, goes there, and draws another one.
//!
//! *Source*: Thompson 1933 (Biometrika 25, 285).
//!
//! *Parameters*: number of choices for which a drawn place is kept, `keep`, 10.
//!
//! *Deviations*: a place is also drawn anew on arrival within half a way.

use super::choice::{Policy, PolicyParams};
use super::prospect::Prospect;
use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use smart_default::SmartDefault;
use std::num::NonZeroU32;
use world::catalogue::Entry;
use world::registry::Listed;
use world::seeds::Stream;

/// Parameters of the policy.
#[derive(Clone, Debug, SmartDefault, PartialEq, Serialize, Deserialize, JsonSchema)]
#[schemars(rename = "ThompsonParams")]
#[serde(deny_unknown_fields, default)]
pub struct Params {
    /// Choices for which a drawn place is kept.
    #[default(NonZeroU32::new(10).expect("10 is not zero"))]
    pub keep: NonZeroU32,
}

impl Listed for Params {
    const ENTRY: Entry = Entry {
        name: "Thompson",
        what: "towards a place drawn from the belief, for ten choices or until it is reached",
        source: "Thompson 1933, Biometrika 25, 285",
    };
}

impl PolicyParams for Params {
    fn build(&self) -> Box<dyn Policy> {
        Box::new(Thompson { keep: self.keep.get(), drawn: None })
    }
}

/// State of the policy: the drawn place, and for how many choices it has been kept.
#[derive(Debug)]
struct Thompson {
    keep: u32,
    drawn: Option<(Vector2<f64>, u32)>,
}

impl Policy for Thompson {
    fn choose(&mut self, prospect: &Prospect<'_>, rng: &mut Stream) -> usize {
        let place = match self.drawn {
            Some((place, kept)) if kept < self.keep => {
                self.drawn = Some((place, kept + 1));
                place
            }
            _ => {
                let place = prospect.drawn(rng.uniform());
                self.drawn = Some((place, 1));
                place
            }
        };
        let way = prospect.towards(place);
        if prospect.steps(prospect.ways()[way].end, place) <= 0.5 {
            self.drawn = None;
        }
        way
    }
}
