//! What a mission is told before it begins: the area, the chart, what the robot carries.

use world::area::Area;
use world::obstacles::Obstacles;
use world::terrain::Terrain;

/// The setting of a mission, known to the searcher beforehand: nothing in it is sensed, nothing secret.
#[derive(Clone, Debug)]
pub struct Setting {
    /// The operating area.
    pub area: Area,
    /// The bed as charted.
    pub bed: Terrain,
    /// The solids on the robot's chart; what else stands in the water it must find.
    pub chart: Obstacles,
    /// The robot keeps a map of where the source may be.
    pub maps: bool,
}
