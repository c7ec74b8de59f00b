//! Shared by the planners' tests.

use super::{FreeSpace, PathStart};
use crate::handoff::{BeliefGrid, testing};
use nalgebra::{Vector2, Vector3};
use world::obstacles::{Obstacle, Obstacles};
use world::seeds::Stream;
use world::terrain::Terrain;
use world::units::Heading;

/// Cells from the datum on, with axes east and north, on a bed 8 m deep.
pub(crate) fn lattice(n: [usize; 3], cell_m: [f64; 3]) -> BeliefGrid {
    BeliefGrid { corner: Vector3::new(0.0, 0.0, -8.0), axes: [Vector2::x(), Vector2::y()], cell_m, n }
}

/// A block on a bed 8 m down.
pub(crate) fn block(id: &str, east_m: f64, north_m: f64, size_m: [f64; 3]) -> Obstacle {
    testing::block(&Terrain::Level { depth_m: 8.0 }, id, [east_m, north_m], size_m)
}

/// A room with blocks in it.
pub(crate) fn room(n: [usize; 3], cell_m: [f64; 3], blocks: Vec<Obstacle>) -> FreeSpace {
    let mut room = FreeSpace::new(lattice(n, cell_m), 0.4, 10.0);
    let bed = Terrain::Level { depth_m: 8.0 };
    room.chart(&Obstacles(blocks), &bed, &|_, _| -4.0);
    room
}

/// A start at mid-depth.
pub(crate) fn from(x: f64, y: f64, deg: f64) -> PathStart {
    PathStart { p_W: Vector3::new(x, y, -4.0), heading: Heading::from_deg(deg), turning_radius_m: 0.0 }
}

/// A room with single cells solid at random.
pub(crate) fn speckled(n: [usize; 3], cell_m: [f64; 3], share: f64, seed: u64) -> FreeSpace {
    let mut room = FreeSpace::new(lattice(n, cell_m), 0.0, 0.0);
    let mut rng = Stream::new(seed, "room", "solid");
    for cell in 0..room.lattice().len() {
        if rng.uniform() < share {
            let p = room.lattice().centre(cell);
            room.beam(&p, &p, true);
        }
    }
    room
}
