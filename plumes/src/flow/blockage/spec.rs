//! Blockage as a scenario asks for it.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::area::Area;
use world::cost::{Cost, Part, Times};
use world::ranges::{Fraction, NonNegative, Positive};

use crate::error::PlumeError;
use crate::flow::grid::GridShape;

/// Obstacles and bed turn the water aside; without this block currents pass through obstacles as if they were not there.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct BlockageSpec {
    /// Horizontal size of a cell, m: a few to the narrowest obstacle or gap; made to fit, never larger.
    pub cell_m: Positive,
    /// Surfaces from bed to surface between which the cells lie.
    pub levels: u32,
    /// 0 spaces them evenly; 0.9 puts ten times as many near the bed.
    pub stretch: Fraction,
    /// How far the cells reach beyond the area, m: past it the water is as it would be without obstacles.
    pub margin_m: NonNegative,
    /// The currents are worked out again at multiples of this, s, and go straight from one to the next in between: short against meander and
    /// waves. Steady currents are worked out once.
    pub period_s: Positive,
}

impl Default for BlockageSpec {
    fn default() -> Self {
        Self {
            cell_m: Positive::new(2.5),
            levels: 21,
            stretch: Fraction::new(0.5),
            margin_m: NonNegative::new(50.0),
            period_s: Positive::new(30.0),
        }
    }
}

/// Shortest period, s: questions may come a second after the latest advance, and must find a field on both sides.
const SHORTEST_S: f64 = 2.0;
/// Longest period, s: in an hour the tide turns by 30 degrees.
const LONGEST_S: f64 = 3600.0;
/// Memory of a cell while it is solved, bytes, and time, s.
const CELL_BYTES: f64 = 250.0;
/// See above.
const CELL_S: f64 = 2.4e-6;
/// Most cells.
pub(super) const MOST_CELLS: f64 = 4e6;
/// Legal counts of levels.
const LEVELS: (u32, u32) = (2, 201);

impl BlockageSpec {
    /// The grid for the plume's flow whose nodes are the corners of these cells.
    pub fn grid_shape(&self) -> GridShape {
        GridShape {
            cell_m: self.cell_m.get(),
            levels: self.levels as usize,
            stretch: self.stretch.get(),
            margin_m: self.margin_m.get(),
        }
    }

    /// What it takes to lead the water round: in steady water once.
    pub fn cost(&self, area: &Area, steady: bool, times: &Times) -> Cost {
        let [along, across, levels] = self.grid_shape().nodes(area);
        let cells = (along - 1.0) * (across - 1.0) * levels;
        let times_solved = if steady { 1.0 } else { 3.0 + times.whole_s() / self.period_s.get() };
        let part = Part::new("cell_m", format!("{cells:.1e} cells round obstacles"))
            .holds(cells * CELL_BYTES)
            .takes(cells * CELL_S * times_solved)
            .by(self.cell_m.get(), -2.0);
        Cost::single(part)
    }

    pub(super) fn check(&self) -> Result<(), PlumeError> {
        let wrong = |field: &str, problem: String| PlumeError::new(format!("water.blockage.{field}"), problem);
        if !(LEVELS.0..=LEVELS.1).contains(&self.levels) {
            return Err(wrong("levels", format!("must be from {} to {}, got {}", LEVELS.0, LEVELS.1, self.levels)));
        }
        if self.stretch.get() >= 0.99 {
            return Err(wrong("stretch", format!("must be from 0 to 0.99, got {}", self.stretch.get())));
        }
        if self.period_s.get() < SHORTEST_S {
            return Err(wrong("period_s", format!("must be at least {SHORTEST_S} s, got {}", self.period_s.get())));
        }
        if self.period_s.get() > LONGEST_S {
            return Err(wrong("period_s", format!("must be at most {LONGEST_S} s, got {}", self.period_s.get())));
        }
        Ok(())
    }
}
