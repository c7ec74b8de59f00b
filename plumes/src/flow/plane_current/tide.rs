//! Tidal current: ellipses that the water follows with the periods of the tide's constituents.
//!
//! *Source*: current ellipses, Pugh 1987, Tides, Surges and Mean Sea-Level, section 6:4; sign of the minor axis as in
//! Foreman 1978, Manual for Tidal Currents Analysis and Prediction (positive turns anticlockwise): u(t) = Σ A cos(ωt −
//! φ) e + B sin(ωt − φ) e⊥, e the major axis, e⊥ to its left.
//!
//! *Parameters*: `constituents`, each with `period_h` 2π/ω (h; M2 12.4206, S2 12, K1 23.9345, O1 25.8193), `major_m_s`
//! A, `minor_m_s` B (m/s; 0 is rectilinear), `heading_deg` of e, `phase_deg` φ: A is reached φ/360 of a period after
//! time zero, which is the beginning of the spin-up.
//!
//! *Deviations*: the current is the same at all places of the area, which is small compared with the tide's wave of
//! some hundred kilometres. Over depth, the bed slows it (`bed`, the logarithmic law) in step with the current above,
//! because the boundary layer settles in less than an hour. The surface does not rise and sink. A meander is carried by
//! the tide as it is at time zero.

use nalgebra::Vector2;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use world::catalogue::Entry;
use world::ranges::{Finite, HeadingDeg, NonNegative, Positive};
use world::registry::Listed;

use crate::error::PlumeError;
use crate::flow::current::{CurrentParams, CurrentSlot};
use crate::flow::free_water::FreeWater;
use crate::flow::number::{Jet, Number, still, times};
use crate::flow::plane_current::PlaneCurrent;

/// The tide's current: a sum of constituents.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TideSpec {
    /// At least one.
    pub constituents: Vec<ConstituentSpec>,
}

/// One constituent.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ConstituentSpec {
    /// Period, h.
    #[serde(default = "m2", with = "world::limits::tide_h")]
    pub period_h: Positive,
    /// Greatest speed, m/s.
    #[serde(with = "world::limits::stream_m_s")]
    pub major_m_s: NonNegative,
    /// Speed a quarter of a period later, to the left of the major axis, m/s; negative means to the right.
    #[serde(default = "none", with = "world::limits::component_m_s")]
    pub minor_m_s: Finite,
    /// Where the water goes at the greatest speed, degrees clockwise from north.
    pub heading_deg: HeadingDeg,
    /// Time of the greatest speed: degrees of a period after time zero.
    #[serde(default = "none")]
    pub phase_deg: Finite,
}

const fn m2() -> Positive {
    Positive::new(12.420_601_2)
}

const fn none() -> Finite {
    Finite::new(0.0)
}

#[derive(Clone, Copy, Debug)]
struct Constituent {
    major: Vector2<f64>,
    minor: Vector2<f64>,
    omega_rad_s: f64,
    phase_rad: f64,
}

/// The tide's current, ready to use.
#[derive(Clone, Debug)]
pub struct Tide {
    constituents: Vec<Constituent>,
}

impl TideSpec {
    /// The current, checked.
    ///
    /// # Errors
    /// Names the field: no constituent, or a minor axis longer than the major one.
    pub fn build(&self, field: &str) -> Result<Tide, PlumeError> {
        if self.constituents.is_empty() {
            return Err(PlumeError::new(format!("{field}.constituents"), "needs one at least, got none"));
        }
        let of = |(n, c): (usize, &ConstituentSpec)| {
            let (a, b) = (c.major_m_s.get(), c.minor_m_s.get());
            if b.abs() > a {
                let problem = format!("must be from -{a} to {a} (major_m_s), got {b}");
                return Err(PlumeError::new(format!("{field}.constituents[{n}].minor_m_s"), problem));
            }
            let e = c.heading_deg.heading().unit();
            Ok(Constituent {
                major: e * a,
                minor: Vector2::new(-e.y, e.x) * b,
                omega_rad_s: std::f64::consts::TAU / (3600.0 * c.period_h.get()),
                phase_rad: c.phase_deg.get().to_radians(),
            })
        };
        let constituents = self.constituents.iter().enumerate().map(of);
        Ok(Tide { constituents: constituents.collect::<Result<_, _>>()? })
    }
}

impl Listed for TideSpec {
    const ENTRY: Entry = Entry {
        name: "Tide",
        what: "Tidal current: ellipses of constituents, rotating or rectilinear",
        source: "Pugh 1987, Tides, Surges and Mean Sea-Level, section 6:4; Foreman 1978",
    };
}

impl CurrentParams for TideSpec {
    fn join(&self, water: &mut FreeWater, place: &CurrentSlot) -> Result<(), PlumeError> {
        water.add(self.build(place.field)?);
        Ok(())
    }
}

impl PlaneCurrent for Tide {
    fn velocity(&self, _: Vector2<f64>, t_s: f64) -> Vector2<f64> {
        self.at(t_s)
    }

    fn with_slopes(&self, _: Vector2<Jet>, t_s: Jet) -> Vector2<Jet> {
        self.at(t_s)
    }
}

impl Tide {
    /// (east, north) above the bed's boundary layer, m/s.
    pub fn at<N: Number>(&self, t_s: N) -> Vector2<N> {
        let of = |c: &Constituent| {
            let (sin, cos) = (t_s * c.omega_rad_s - c.phase_rad).sin_cos();
            times(c.major, cos) + times(c.minor, sin)
        };
        let parts = self.constituents.iter().map(of);
        parts.fold(still(Vector2::zeros()), |sum, u| sum + u)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::flow::tests::kit::tide_spec;

    #[test]
    fn runs_through_its_ellipse_anticlockwise() {
        let tide = tide_spec(0.1, 90.0).build("water.currents[0]").unwrap();
        let period_s = 3600.0 * 12.42;
        // The greatest speed eastward a ninth of a period after zero, then northward, then back.
        for (part, want) in [(0.0, [0.3, 0.0]), (0.25, [0.0, 0.1]), (0.5, [-0.3, 0.0]), (0.75, [0.0, -0.1])] {
            let u = tide.at((40.0 / 360.0 + part) * period_s);
            assert!((u - Vector2::from(want)).norm() < 1e-12, "{part}: {u}");
        }
        let u = tide.at(1234.0);
        assert!(((u.x / 0.3).powi(2) + (u.y / 0.1).powi(2) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn constituents_add_up() {
        let mut spec = tide_spec(0.0, 90.0);
        let alone = spec.build("t").unwrap().at(500.0);
        spec.constituents.push(ConstituentSpec {
            period_h: Positive::new(12.0),
            heading_deg: HeadingDeg::new(0.0),
            ..spec.constituents[0].clone()
        });
        let both = spec.build("t").unwrap().at(500.0);
        assert!((both.x - alone.x).abs() < 1e-15 && both.y > 0.1);
    }
}
