//! Shared by several instruments: noise, and the distance along a beam to the bed.

use nalgebra::Vector3;
use world::obstacles::Obstacles;
use world::seeds::Stream;
use world::terrain::Terrain;

/// Three independent normal numbers of one standard deviation.
pub(super) fn normal3(rng: &mut Stream, std: f64) -> Vector3<f64> {
    let (x, y, z) = (rng.normal(), rng.normal(), rng.normal());
    Vector3::new(x, y, z) * std
}

/// What an echo sounder may hear.
#[derive(Clone, Copy, Debug)]
pub struct EchoTarget<'a> {
    /// The bed.
    pub terrain: &'a Terrain,
    /// Solids on the bed or above it.
    pub obstacles: &'a Obstacles,
}

/// Distance from `from` (ENU, m) along the unit vector `dir` to the bed or an obstacle before it, m; `None` if the
/// beam does not point down steeply enough (less than 60° from the vertical) to expect an echo.
pub(super) fn range_down(below: &EchoTarget, from: &Vector3<f64>, dir: &Vector3<f64>) -> Option<f64> {
    let terrain = below.terrain;
    const STEEPEST_TILT_COS: f64 = 0.5;
    if -dir.z < STEEPEST_TILT_COS {
        return None;
    }
    // Moves down to the bed below the present end of the beam: on slopes far gentler than the beam, each pass reduces
    // the error by slope × tan(tilt).
    const PASSES: usize = 8;
    let mut range = 0.0;
    for _ in 0..PASSES {
        let end = from + dir * range;
        let before = range;
        range = ((from.z - terrain.bed_z(end.x, end.y)) / -dir.z).max(0.0);
        // Then all further passes say the same.
        if range == before {
            break;
        }
    }
    Some(below.obstacles.ray(from, dir, range).unwrap_or(range))
}
