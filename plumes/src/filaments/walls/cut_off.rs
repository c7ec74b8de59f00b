//! Sources that blocked water does not reach: in a closed cell, or separated from their cell's centre by a thin wall.

use super::domain::Domain;
use super::solids::Solids;
use crate::error::PlumeError;
use crate::filaments::water::lookup::Lookup;
use crate::flow::blockage::Cells;
use crate::flow::grid::FlowGrid;
use crate::flow::ground::Ground;
use crate::flow::{BlockageSpec, WaterSpec};
use crate::release::{Source, SourceSpec, place};
use std::sync::Arc;
use world::area::Area;
use world::obstacles::Obstacles;
use world::terrain::Terrain;

/// What is wrong with each source that no water reaches, without solving any flow. Sources that cannot be placed at all
/// are left out.
///
/// # Errors
/// If the cells cannot be made.
pub fn cut_off(
    specs: &[SourceSpec],
    water: &WaterSpec,
    area: &Area,
    terrain: &Terrain,
    obstacles: &Obstacles,
) -> Result<Vec<PlumeError>, PlumeError> {
    let Some(blockage) = &water.blockage else {
        return Ok(Vec::new());
    };
    let walled = water.is_walled();
    let cells = Cells::new(blockage, area, &Ground::new(terrain), obstacles, walled)?;
    let grid = FlowGrid::new(area, terrain, BlockageSpec::grid_shape(blockage));
    let (mut room, lookup) = (Domain::new(&grid), Lookup::new(&grid));
    room.solids = Solids::new(obstacles.clone(), grid.datum);
    room.lead_round(Arc::new(cells));
    let placed = specs.iter().enumerate().filter_map(|(n, spec)| {
        let mut placed = place(std::slice::from_ref(spec), area, terrain).ok()?;
        Some((n, placed.pop()?))
    });
    Ok(placed
        .filter(|(_, source)| obstacles.containing(&source.p_W).is_none())
        .filter_map(|(n, source)| problem(&grid, &room, &lookup, n, &source))
        .collect())
}

/// What is wrong with the n-th source, if anything is.
pub(crate) fn problem(
    grid: &FlowGrid,
    room: &Domain,
    lookup: &Lookup,
    n: usize,
    source: &Source,
) -> Option<PlumeError> {
    let at = room.place(lookup, grid.local(&source.p_W))?;
    let free = room.open(lookup, &at, true);
    if free.is_some_and(|free| free.q == at.q) {
        return None;
    }
    let cure = free.map_or("bring it into open water".to_owned(), |free| {
        let p = (grid.datum + room.horizontal(free.q)).push(free.z());
        format!(
            "take a smaller water.blockage.cell_m, or bring it to open water, say east {:.2} m, north {:.2} m, depth {:.2} m",
            p[0], p[1], -p[2]
        )
    });
    let problem = format!(
        "source \"{}\" lies in a cell of the blocked water that an obstacle closes or cuts off: no water comes by; {cure}",
        source.id
    );
    Some(PlumeError::new(format!("sources[{n}]"), problem))
}
