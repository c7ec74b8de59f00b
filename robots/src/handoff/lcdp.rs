//! A last chemical detection point (LCDP): where the vehicle last smelled the plume before it lost it.
//!
//! *Source*: Tian et al. 2013, section 3 and eq. 1.
//!
//! *Parameters*: none.
//!
//! *Deviations*: eq. 1 turns the points by f_dir + 180° and calls the smallest x_flow the most up-flow one. The sign
//! of its rotation leaves open whether that is so. Here x_flow grows down-flow and y_flow grows to the left of
//! down-flow, so that the smallest x_flow is the most up-flow. The origin of the frame is that of the area: another
//! origin would change no order.

use super::Observation;
use nalgebra::Vector2;
use world::units::Heading;

/// A last chemical detection point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lcdp {
    /// When chemical was last detected there, s.
    pub t_s: f64,
    /// Place, as the vehicle believes (east, north), m.
    pub position: Vector2<f64>,
    /// The reading at that time, as a share of the sensor's full scale.
    pub of_full_scale: f64,
    /// Flow at that place and time (east, north), m/s; `None` if none had been measured.
    pub flow: Option<Vector2<f64>>,
}

impl Lcdp {
    /// A point of which only time and place matter.
    pub fn new_at(t_s: f64, position: Vector2<f64>) -> Self {
        Self { t_s, position, of_full_scale: 0.0, flow: None }
    }

    /// The vehicle's present place, with the reading and the believed flow.
    pub fn here(seen: &Observation) -> Self {
        Self {
            t_s: seen.t_s,
            position: seen.estimate.position,
            of_full_scale: seen.chemical.map_or(0.0, |c| c.of_full_scale),
            flow: seen.estimate.flow.map(|f| f.velocity),
        }
    }

    /// (x_flow, y_flow), m: down-flow, and left of down-flow.
    pub fn in_flow(&self, up_flow: Heading) -> Vector2<f64> {
        let down = -up_flow.unit();
        Vector2::new(down.dot(&self.position), down.perp(&self.position))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn flow_frame_by_hand() {
        let p = Lcdp::new_at(0.0, Vector2::new(3.0, 4.0));
        // Water to the east: x_flow is east, y_flow north.
        let east = p.in_flow(Heading::from_deg(270.0));
        assert!((east - Vector2::new(3.0, 4.0)).norm() < 1e-12);
        // Water to the south: x_flow is south, y_flow east.
        let south = p.in_flow(Heading::from_deg(0.0));
        assert!((south - Vector2::new(-4.0, 3.0)).norm() < 1e-12);
    }
}
