//! One velocity at all places and times.
//!
//! *Source*: the mean flow of Farrell et al. 2002, Environ. Fluid Mech. 2, 143.
//!
//! *Parameters*: `speed_m_s` (m/s) and `heading_deg`, where the water goes (Farrell: 1 m/s).
//!
//! *Deviations*: none.

use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::ranges::{HeadingDeg, NonNegative};
use world::registry::Listed;

use crate::error::PlumeError;
use crate::flow::current::{CurrentParams, CurrentSlot};
use crate::flow::free_water::FreeWater;
use crate::flow::number::{Jet, still};
use crate::flow::plane_current::PlaneCurrent;

/// A horizontal velocity as a speed and the direction the water goes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct UniformSpec {
    /// Speed over ground, m/s.
    pub speed_m_s: NonNegative,
    /// Where the water goes, degrees clockwise from north.
    pub heading_deg: HeadingDeg,
}

impl UniformSpec {
    /// (east, north), m/s.
    pub fn velocity(&self) -> Vector2<f64> {
        self.heading_deg.heading().unit() * self.speed_m_s.get()
    }
}

impl Listed for UniformSpec {
    const ENTRY: Entry = Entry {
        name: "Uniform",
        what: "One velocity everywhere and always",
        source: "Farrell et al. 2002, Environ. Fluid Mech. 2, 143",
    };
}

impl CurrentParams for UniformSpec {
    fn join(&self, water: &mut FreeWater, _: &CurrentSlot) -> Result<(), PlumeError> {
        water.add(Uniform(self.velocity()));
        Ok(())
    }

    fn is_steady(&self) -> bool {
        true
    }

    fn carries_m_s(&self) -> Vector2<f64> {
        self.velocity()
    }
}

/// The current, ready to use.
#[derive(Clone, Debug)]
struct Uniform(Vector2<f64>);

impl PlaneCurrent for Uniform {
    fn velocity(&self, _: Vector2<f64>, _: f64) -> Vector2<f64> {
        self.0
    }

    fn with_slopes(&self, _: Vector2<Jet>, _: Jet) -> Vector2<Jet> {
        still(self.0)
    }
}
