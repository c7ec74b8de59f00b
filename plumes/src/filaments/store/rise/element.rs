//! A piece of a buoyant thread: how it rises, shares its momentum and grows.
//!
//! *Source*: a Lagrangian element of a plume in a cross-flow (Lee & Cheung 1990, J. Environ. Eng. 116, 1085), top-hat,
//! with the entrainment of Hoult, Fay & Forney 1969, J. Air Pollut. Control Assoc. 19, 585: α by its motion along
//! itself, β by its motion across. Without cross-flow it is the plume of Morton, Taylor & Turner 1956, Proc. R. Soc. A
//! 234, 1; bent over it is the line thermal of Briggs 1969, Plume Rise: z = 1.6 F^⅓ x^⅔/U. Turbulence around shares the
//! momentum with more water: dr/dt = c (εr)^⅓ (Richardson 1926, Proc. R. Soc. A 110, 709), with [`SHARED`].
//!
//! *Parameters*: [`ALONG`] α, [`ACROSS`] β, [`SHARED`] c.
//!
//! *Deviations*: it has the horizontal velocity of the water from the start. All turbulence that grows the radius also
//! counts as dilution. Surface and bed take up its momentum. Elements of one thread do not act on each other.

use crate::release::Curve;

/// Entrainment α of a plume without cross-flow, top-hat: √2 · 0.083 (Lee & Cheung 1990; 0.116 of Papanicolaou & List 1988,
/// J. Fluid Mech. 195, 341).
pub(crate) const ALONG: f64 = 0.117;
/// Entrainment β of a thread that moves across itself (Briggs 1969; Hoult, Fay & Forney 1969).
pub(crate) const ACROSS: f64 = 0.6;
/// Growth of a radius by turbulence: a cloud whose pairs follow r² = g ε t³ with g = 0.55 (Salazar & Collins 2009, Annu.
/// Rev. Fluid Mech. 41, 405: 0.5 to 0.6) has a standard deviation of √(gεt³/6) a direction, half the radius of a disc of the
/// same variance: dr/dt = 1.5 · (2g/3)^⅓ (εr)^⅓.
pub(crate) const SHARED: f64 = 1.073_6;

/// The water that an element meets.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Around {
    /// Horizontal speed, m/s.
    pub(crate) speed_m_s: f64,
    /// Dissipation ε, m²/s³.
    pub(crate) dissipation_m2_s3: f64,
    /// Square of the buoyancy frequency, 1/s².
    pub(crate) n2_per_s2: f64,
    /// Radius of the largest eddies, m: half the depth.
    pub(crate) largest_m: f64,
}

/// A thread of elements that a source releases.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Thread {
    /// Volume of an element at its release, m³.
    pub(crate) volume_m3: f64,
    /// Elements a second.
    pub(crate) rate_hz: f64,
    /// Least speed at which the thread is drawn out, m/s: that at which it leaves the source.
    pub(crate) least_m_s: f64,
    /// Buoyancy of the released volume by dilution.
    pub(crate) curve: Curve,
}

/// An element: one filament's part of the thread.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Element {
    /// Volume that shares its momentum, m³.
    pub(crate) shared_m3: f64,
    /// Volume that it has entrained by its own motion, with its first, m³.
    pub(crate) own_m3: f64,
    /// Vertical momentum over the density of water, m⁴/s.
    pub(crate) momentum_m4_s: f64,
    /// What the stratification of the water that it has passed adds to its buoyancy, m⁴/s².
    pub(crate) passed_m4_s2: f64,
}

impl Thread {
    /// An element at its release.
    pub(crate) fn released(&self) -> Element {
        Element { shared_m3: self.volume_m3, own_m3: self.volume_m3, ..Element::default() }
    }

    /// Speed at which the thread is drawn out, m/s.
    #[inline(always)]
    pub(crate) fn drawn_m_s(&self, speed_m_s: f64, rise_m_s: f64) -> f64 {
        (speed_m_s * speed_m_s + rise_m_s * rise_m_s).sqrt().max(self.least_m_s)
    }

    /// Variance by which the element's own entrainment has widened it, m² in each direction.
    pub(crate) fn grown_m2(&self, e: &Element, around: &Around) -> f64 {
        let drawn = self.drawn_m_s(around.speed_m_s, e.momentum_m4_s / e.shared_m3);
        // A disc of radius r has the variance r²/4.
        (e.own_m3 - self.volume_m3) * self.rate_hz / (4.0 * std::f64::consts::PI * drawn)
    }
}
