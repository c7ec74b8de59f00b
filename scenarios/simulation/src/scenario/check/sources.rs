//! Checks of the sources: where they are, what they are called, and what they release.

use super::path::{names, twins};
use crate::scenario::fault::UnplacedFault;
use crate::scenario::schema::Scenario;
use plumes::error::PlumeError;
use plumes::flow::Water;
use plumes::release;
use world::area::Area;
use world::obstacles::Obstacles;
use world::terrain::Terrain;

/// What is released into the water, if the sources have places in it.
pub(super) fn releases(
    scenario: &Scenario,
    area: &Area,
    terrain: &Terrain,
    water: &Water,
    found: &mut Vec<UnplacedFault>,
) {
    let placed = release::place(&scenario.sources, area, terrain).unwrap_or_default();
    for (n, source) in placed.iter().enumerate() {
        if let Err(PlumeError::Invalid { field, problem }) = source.release.thread(n, water, &source.p_W) {
            found.push(UnplacedFault::error(field, problem));
        }
    }
}

/// Where the sources are, and what they are called.
pub(super) fn sources(
    scenario: &Scenario,
    area: &Area,
    terrain: &Terrain,
    obstacles: &Obstacles,
    found: &mut Vec<UnplacedFault>,
) {
    for PlumeError::Invalid { field, problem } in release::misplaced(&scenario.sources, area, terrain, obstacles) {
        found.push(UnplacedFault::error(field, problem));
    }
    let ids: Vec<&str> = scenario.sources.iter().map(|s| s.id.as_str()).collect();
    names("sources", &ids, found);
    twins("sources", &ids, found);
}
