//! What a mission knows before it begins: the area, the chart, what the robot carries.

use super::survey::Eyes;
use std::sync::Arc;
use world::area::Area;
use world::obstacles::Obstacles;
use world::terrain::Terrain;

/// The setting of a mission. The searcher knows it beforehand: it holds nothing sensed and nothing secret.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The operating area.
    pub area: Area,
    /// The bed as charted.
    pub bed: Terrain,
    /// The solids on the robot's chart; the searcher must find all others itself.
    pub chart: Obstacles,
    /// The robot keeps a map of where the source may be.
    pub maps: bool,
    /// That map says what it expects on ways ahead.
    pub outlook: bool,
    /// What looks at its pings and pictures.
    pub eyes: Arc<dyn Eyes>,
}
