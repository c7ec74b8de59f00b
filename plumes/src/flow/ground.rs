//! The bed for the water: height and slope under a place, without trigonometry in each question.
//!
//! *Source*: the terrain's own definition; the slope by central differences over 1 m where no closed form is known
//! here.
//!
//! *Parameters*: none.
//!
//! *Deviations*: at least a centimetre of water everywhere, so that a dry corner does not divide by zero.

use crate::flow::number::{Number, along, still};
use nalgebra::Vector2;
use world::terrain::Terrain;

const SHALLOWEST_M: f64 = 0.01;

/// The bed under a place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor<N = f64> {
    /// Height, m (negative).
    pub z: N,
    /// Slope (east, north).
    pub slope: Vector2<N>,
}

/// A terrain prepared for fast evaluation.
#[derive(Clone, Debug)]
pub(crate) enum Ground {
    Level(f64),
    Plane {
        // Position along the slope at the datum, as a part of its run, and its gradient.
        part: f64,
        gradient: Vector2<f64>,
        z: [f64; 2],
    },
    Other(Terrain),
}

impl Ground {
    pub(crate) fn new(terrain: &Terrain) -> Self {
        if let Terrain::Level { depth_m } = *terrain {
            Self::Level(-depth_m)
        } else if let Terrain::Slope {
            middle,
            shoreward,
            shallow_m,
            deep_m,
            run_m,
        } = *terrain
        {
            let gradient = shoreward / run_m;
            Self::Plane {
                part: 0.5 - middle.dot(&gradient),
                gradient,
                z: [-deep_m, -shallow_m],
            }
        } else {
            Self::Other(terrain.clone())
        }
    }

    pub(crate) fn floor<N: Number>(&self, p: Vector2<N>) -> Floor<N> {
        let (z, slope) = match self {
            Self::Level(z) => (N::from(*z), still(Vector2::zeros())),
            Self::Plane { part, gradient, z } => {
                let s = along(*gradient, p) + *part;
                let rise = z[1] - z[0];
                let on_slope = s.value() > 0.0 && s.value() < 1.0;
                let on_slope = if on_slope { rise } else { 0.0 };
                (
                    s.within(N::from(0.0), N::from(1.0)) * rise + z[0],
                    still(gradient * on_slope),
                )
            }
            Self::Other(terrain) => {
                let (x, y) = (p.x.value(), p.y.value());
                let n = terrain.normal(x, y);
                let slope = Vector2::new(-n.x / n.z, -n.y / n.z);
                let z = N::known(terrain.bed_z(x, y), [p.x, p.y], || slope.into());
                (z, still(slope))
            }
        };
        Floor {
            z: z.least(N::from(-SHALLOWEST_M)),
            slope,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::units::Heading;

    #[test]
    fn same_bed_as_the_terrain() {
        let terrain = Terrain::Slope {
            middle: Vector2::new(10.0, -40.0),
            shoreward: Heading::from_deg(250.0).unit(),
            shallow_m: 4.0,
            deep_m: 8.0,
            run_m: 100.0,
        };
        let (quick, plain) = (Ground::new(&terrain), Ground::Other(terrain.clone()));
        for (x, y) in [(0.0, 0.0), (30.0, -60.0), (-200.0, 5.0), (300.0, 0.0)] {
            let p = Vector2::new(x, y);
            let (a, b) = (quick.floor(p), plain.floor(p));
            assert!((a.z - b.z).abs() < 1e-12 && (a.z - terrain.bed_z(x, y)).abs() < 1e-12);
            assert!((a.slope - b.slope).norm() < 1e-12);
        }
    }
}
