//! Which obstacles turn the water aside, before anything is solved.

use world::area::Area;
use world::obstacles::Obstacles;
use world::terrain::Terrain;

use super::cells::Cells;
use super::spec::BlockageSpec;
use crate::error::PlumeError;
use crate::flow::ground::Ground;

impl BlockageSpec {
    /// Whether the cells can be made, without solving anything; the numbers of the obstacles that hold no cell's middle, so that
    /// the water goes through them.
    ///
    /// # Errors
    /// Names the field at fault and what would be legal.
    pub fn unfelt(
        &self,
        area: &Area,
        terrain: &Terrain,
        obstacles: &Obstacles,
        walled: bool,
    ) -> Result<Vec<usize>, PlumeError> {
        let cells = Cells::new(self, area, &Ground::new(terrain), obstacles, walled)?;
        let felt = cells.felt.iter().enumerate();
        Ok(felt.filter(|(_, f)| !**f).map(|(n, _)| n).collect())
    }
}
