//! A fin: lift and drag of a small wing in the local water, with stall.
//!
//! *Source:* lift slope and induced drag of low-aspect-ratio wings: Hoerner & Borst, "Fluid-Dynamic Lift", 1985,
//! chapter 3; a plate across the stream beyond the stall: Hoerner, "Fluid-Dynamic Drag", 1965, section 3-7.
//!
//! *Parameters:* [`FinSpec`](super::FinSpec): area A, slope a, C_D0 `drag_0`, α_s `stall_deg`, C_N `plate`.
//!
//! ```text
//! α = δ + incidence of the local water      below α_s: C_L = a sin α cos α, C_D = C_D0 + a sin²α
//! beyond: C_L = C_N sin α cos α, C_D = C_D0 + C_N sin²α, blended over 5 degrees
//! ```
//!
//! *Deviations:* the force below the stall is a slope times sin α across the chord, so its drag is that of the tilted
//! lift; no wake of the hull; water from behind acts on the fin as from ahead with the angle from its trailing edge.
//! The local water is that at the fin's place, turning and the water's change along the hull included.

use super::thruster::wet;
use crate::vehicles::dynamics::Relative;
use nalgebra::Vector3;
use world::math;

/// Width of the blend round the stall, rad.
const BLEND_RAD: f64 = 5.0 * std::f64::consts::PI / 180.0;

/// A fin, FRD.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::vehicles) struct Fin {
    /// Centre of pressure, m.
    pub(in crate::vehicles) r: Vector3<f64>,
    /// Chord at zero angle, forwards.
    pub(in crate::vehicles) chord: Vector3<f64>,
    /// Direction in which it lifts: chord cross hinge.
    pub(in crate::vehicles) lift: Vector3<f64>,
    /// m².
    pub(in crate::vehicles) area_m2: f64,
    /// 1/rad.
    pub(in crate::vehicles) slope: f64,
    /// Drag coefficient without incidence.
    pub(in crate::vehicles) drag_0: f64,
    /// rad.
    pub(in crate::vehicles) stall_rad: f64,
    /// Force coefficient across a plate.
    pub(in crate::vehicles) plate: f64,
    /// Greatest deflection, rad.
    pub(in crate::vehicles) limit_rad: f64,
}

impl Fin {
    /// Force of a deflection, rad, positive about its hinge: the leading edge goes down (against the lift).
    pub(super) fn force(&self, angle_rad: f64, at: &Relative) -> (Vector3<f64>, Vector3<f64>) {
        let local = at.v + at.w.cross(&self.r) - at.along * self.r.x;
        let (ahead, across) = (local.dot(&self.chord), local.dot(&self.lift));
        let squared = ahead * ahead + across * across;
        if squared == 0.0 {
            return (Vector3::zeros(), Vector3::zeros());
        }
        // Unit vector of the plate's normal and chord, turned.
        let (sin, cos) = math::sin_cos(angle_rad);
        let normal = self.lift * cos + self.chord * sin;
        let speed = squared.sqrt();
        // Sine of the angle between the stream and the plate: positive if the water comes from the lift's back.
        let sin_alpha = -(across * cos + ahead * sin) / speed;
        let k = 0.5 * at.rho * squared * self.area_m2 * wet(at, &self.r);
        let stalled = ((math::asin(sin_alpha.abs().min(1.0)) - self.stall_rad) / BLEND_RAD + 0.5).clamp(0.0, 1.0);
        let c_n = self.slope + (self.plate - self.slope) * stalled;
        let stream = (self.chord * ahead + self.lift * across) / speed;
        let force = normal * (k * c_n * sin_alpha) - stream * (k * self.drag_0);
        (force, self.r.cross(&force))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stern_plane() -> Fin {
        Fin {
            r: Vector3::new(-0.4, 0.0, 0.0),
            chord: Vector3::x(),
            // The link's z axis is up: -z in FRD.
            lift: -Vector3::z(),
            area_m2: 0.0064,
            slope: 3.0,
            drag_0: 0.01,
            stall_rad: 0.35,
            plate: 1.98,
            limit_rad: 0.35,
        }
    }

    fn at(v: Vector3<f64>, w: Vector3<f64>) -> Relative {
        Relative { v_ground: v, v, w, along: Vector3::zeros(), rho: 1025.0, down: Vector3::z(), z_m: -10.0, wet: 1.0 }
    }

    #[test]
    fn a_small_angle_lifts_by_the_slope() {
        let ahead = at(Vector3::new(1.5, 0.0, 0.0), Vector3::zeros());
        let (force, moment) = stern_plane().force(-0.1, &ahead);
        let linear = 0.5 * 1025.0 * 2.25 * 0.0064 * 3.0 * 0.1;
        // A positive angle turns the leading edge down, so a negative one lifts the stern (-z), and the nose dips.
        assert!((force.z / -linear - 1.0).abs() < 0.02, "{force}");
        assert!(force.x < 0.0);
        assert!(moment.y < 0.0, "{moment}");
    }

    #[test]
    fn it_damps_what_moves_it_and_stalls() {
        let fin = stern_plane();
        let sinking = at(Vector3::new(1.5, 0.0, 0.2), Vector3::zeros());
        assert!(fin.force(0.0, &sinking).0.z < 0.0);
        let pitching = at(Vector3::new(1.5, 0.0, 0.0), Vector3::new(0.0, 0.3, 0.0));
        assert!(fin.force(0.0, &pitching).1.y < 0.0);
        let ahead = at(Vector3::new(1.0, 0.0, 0.0), Vector3::zeros());
        let lift = |angle: f64| -fin.force(-angle, &ahead).0.z;
        assert!(lift(0.3) > lift(0.42), "{} {}", lift(0.3), lift(0.42));
        assert!(fin.force(0.3, &at(Vector3::zeros(), Vector3::zeros())).0 == Vector3::zeros());
    }
}
