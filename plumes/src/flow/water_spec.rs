//! The water as a scenario asks for it, and how its currents join.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::area::Area;
use world::obstacles::Obstacles;
use world::ranges::Positive;
use world::seeds::Seed;
use world::terrain::Terrain;

use crate::error::PlumeError;
use crate::flow::bed::BedSpec;
use crate::flow::blockage::{BlockageSpec, ObstacleFlow};
use crate::flow::catalogue::CurrentSpec;
use crate::flow::current::CurrentSlot;
use crate::flow::free_water::FreeWater;
use crate::flow::grid::GridShape;
use crate::flow::ground::Ground;
use crate::flow::mixing::MixingSpec;
use crate::flow::water::Water;

/// The water of a scenario; still by default.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct WaterSpec {
    /// Currents that add up; without any, the water is still.
    pub currents: Vec<CurrentSpec>,
    /// Bed friction; if absent, the currents slip.
    pub bed: Option<BedSpec>,
    /// Diffusivities.
    pub mixing: MixingSpec,
    /// Density where no layers set it, kg/m³.
    #[serde(with = "world::limits::density_kg_m3")]
    pub density_kg_m3: Positive,
    /// Obstacles and bed divert the currents; if absent, currents pass through obstacles.
    pub blockage: Option<BlockageSpec>,
}

impl Default for WaterSpec {
    fn default() -> Self {
        Self {
            currents: Vec::new(),
            bed: None,
            mixing: MixingSpec::default(),
            density_kg_m3: Positive::new(1026.0),
            blockage: None,
        }
    }
}

impl WaterSpec {
    /// Whether the area's sides are the walls of a channel.
    pub fn is_walled(&self) -> bool {
        self.currents.iter().any(|c| c.is_walled())
    }

    /// Whether the currents never change; passing waves do not count.
    pub(super) fn is_steady(&self) -> bool {
        self.currents.iter().all(|c| c.is_steady())
    }

    /// The grid on which the plume sees the water, at most `depth_m` deep: one that shows the waves and interfaces of
    /// its currents or, round obstacles, the corners of the water's cells.
    pub fn grid_shape(&self, area: &Area, depth_m: f64) -> GridShape {
        let blockage = self.blockage.as_ref().map(BlockageSpec::grid_shape);
        blockage.unwrap_or_else(|| {
            let scales = self.currents.iter().map(|c| c.scales());
            scales.fold(GridShape::fitting(area), |shape, s| shape.resolving(&s, area, depth_m))
        })
    }

    /// The water round obstacles, if [`Self::blockage`] asks for it; otherwise as [`Self::build`] returns it.
    ///
    /// # Errors
    /// Names the field at fault and what would be legal.
    pub fn build_round(
        &self,
        area: &Area,
        terrain: &Terrain,
        obstacles: &Obstacles,
        seed: impl Into<Seed>,
    ) -> Result<Water, PlumeError> {
        let free = self.free(area, terrain, seed.into())?;
        let blocked = (self.blockage.as_ref()).map(|spec| ObstacleFlow::new(spec, area, obstacles, free.clone()));
        Ok(Water { free, blocked: blocked.transpose()? })
    }

    /// The water over a terrain as it would be without obstacles, checked.
    ///
    /// # Errors
    /// Names the field at fault and what would be legal.
    pub fn build(&self, area: &Area, terrain: &Terrain, seed: impl Into<Seed>) -> Result<Water, PlumeError> {
        Ok(Water { free: self.free(area, terrain, seed.into())?, blocked: None })
    }

    fn free(&self, area: &Area, terrain: &Terrain, seed: Seed) -> Result<FreeWater, PlumeError> {
        let bed = (self.bed.as_ref()).map(|b| b.build("water.bed")).transpose()?;
        let mut water = FreeWater {
            ground: Ground::new(terrain),
            currents: Vec::new(),
            layers: None,
            bed,
            mixing: self.mixing.clone(),
            density: self.density_kg_m3.get(),
            flume: None,
            waves: None,
            steady: self.is_steady(),
        };
        // Those last that the mean of the others carries, wherever they stand in the list.
        for carried in [false, true] {
            let carrier = water.depth_mean(area.centre);
            for (i, current) in self.currents.iter().enumerate().filter(|(_, c)| c.is_carried() == carried) {
                let field = format!("water.currents[{i}]");
                let before = water.currents.len();
                current.join(&mut water, &CurrentSlot { field: &field, area, terrain, seed, carrier })?;
                for entry in &mut water.currents[before..] {
                    (entry.name, entry.is_own) = (current.name(), current.is_own());
                }
            }
            if let Some(problem) = water.fault(area.centre, 0.0) {
                return Err(PlumeError::new("water.currents", problem));
            }
        }
        water.advance(0.0);
        Ok(water)
    }
}
