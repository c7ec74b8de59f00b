//! A piece of a buoyant thread: how it rises, shares its momentum and grows.
//!
//! *Source*: a Lagrangian element of a jet and plume in a cross-flow (Lee & Cheung 1990, J. Environ. Eng. 116, 1085),
//! top-hat, with the entrainment of Hoult, Fay & Forney 1969, J. Air Pollut. Control Assoc. 19, 585: by its motion along
//! itself, as a jet and as a plume, and by its motion across. Its speed beyond the water's is shared by what it entrains,
//! so a jet slows down. Without cross-flow it is the plume of Morton, Taylor & Turner 1956, Proc. R. Soc. A 234, 1; bent
//! over it is the line thermal of Briggs 1969, Plume Rise: z = 1.6 F^⅓ x^⅔/U.
//!
//! What gives the force, the dyed core, and what shares the momentum are two volumes. Viscosity and the turbulence around
//! share the momentum with more water: dr/dt = c (εr)^⅓ (Richardson 1926, Proc. R. Soc. A 110, 709) or, within the
//! finest eddies, r (ε/15ν)^½ (Taylor 1935, Proc. R. Soc. A 151, 421), and 4ν/r. The force is in the core, so momentum
//! that is fresh is there too: the mean speed of the core is that of a laminar thread, f/8πν · ln(1 + 8νt/r²) (the
//! Green's function of diffusion in a plane, summed over the time of a steady force).
//!
//! A composition lifts as it is mixed molecule by molecule. Strain thins the dye to sheets at γ = 0.3 (ε/ν)^½ (Batchelor
//! 1959, J. Fluid Mech. 5, 113; 0.3: Girimaji & Pope 1990, J. Fluid Mech. 220, 427), which diffuse: see `curve`.
//!
//! *Parameters*: [`JET`], [`ALONG`], [`ACROSS`], [`SHARED`], [`LAMINAR`], [`STRAIN`], [`DIFFUSIVITY_M2_S`].
//!
//! *Deviations*: a filament has the horizontal velocity of the water from the start. All turbulence that grows the core
//! also counts as dilution. Surface and bed take up its momentum. Elements of one thread do not act on each other.

use crate::release::Curve;
pub(crate) use crate::release::VISCOSITY_M2_S;

/// Entrainment of a jet, top-hat: √2 · 0.057 (Lee & Cheung 1990; 0.0535 of Fischer et al. 1979, Mixing in Inland and
/// Coastal Waters).
pub(crate) const JET: f64 = 0.080_6;
/// Entrainment α of a plume without cross-flow, top-hat: √2 · 0.083 (Lee & Cheung 1990; 0.116 of Papanicolaou & List 1988,
/// J. Fluid Mech. 195, 341).
pub(crate) const ALONG: f64 = 0.117;
/// Entrainment β of a thread that moves across itself (Briggs 1969; Hoult, Fay & Forney 1969).
pub(crate) const ACROSS: f64 = 0.6;
/// Growth of a radius by turbulence: a cloud whose pairs follow r² = g ε t³ with g = 0.55 (Salazar & Collins 2009, Annu.
/// Rev. Fluid Mech. 41, 405: 0.5 to 0.6) has a standard deviation of √(gεt³/6) a direction, half the radius of a disc of the
/// same variance: dr/dt = 1.5 · (2g/3)^⅓ (εr)^⅓.
pub(crate) const SHARED: f64 = 1.073_6;
/// Reynolds number w r/ν of the core below which its own motion is laminar and entrains nothing; from twice this on it is
/// turbulent. Threads of plumes and jets become so between 100 and 200 (Turner 1973, Buoyancy Effects in Fluids, 6.1.4).
pub(crate) const LAMINAR: f64 = 100.0;
/// Mean rate of strain of a material surface, times (ν/ε)^½.
pub(crate) const STRAIN: f64 = 0.3;
/// Between those of salt, 1.5e-9, and 2-propanol, 1.0e-9 (Cussler 2009, Diffusion, table 5.2-1).
pub(crate) const DIFFUSIVITY_M2_S: f64 = 1.2e-9;
/// How far beyond the core the momentum of a steady force reaches: its volume over the core's is 1 + this · ln of the
/// shared volume over the core's. Fitted to the laminar thread, whose speed then is right to 5 %.
pub(crate) const REACH: f64 = 1.18;

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
    /// Speed at which it leaves the source, m/s.
    pub(crate) outflow_m_s: f64,
    /// Buoyancy of the released volume by mixing.
    pub(crate) curve: Curve,
    /// Whether anyone needs to know how far its sheets are mixed.
    pub(crate) mixes: bool,
}

/// An element: one filament's part of the thread.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Element {
    /// Volume that shares its momentum, m³.
    pub(crate) shared_m3: f64,
    /// Volume within which the released volume lies, m³.
    pub(crate) core_m3: f64,
    /// Volume that it has entrained by its own motion, with its first, m³.
    pub(crate) own_m3: f64,
    /// Vertical momentum over the density of water, m⁴/s.
    pub(crate) momentum_m4_s: f64,
    /// What the stratification of the water that it has passed adds to its buoyancy, m⁴/s².
    pub(crate) passed_m4_s2: f64,
    /// Square of the thickness of its sheets over that at release.
    pub(crate) thinned: f64,
    /// The sheets' own time: diffusivity over squared thickness, integrated.
    pub(crate) mixed: f64,
}

impl Element {
    /// How many numbers it consists of.
    pub(crate) const NUMBERS: usize = 7;

    /// Its numbers in order.
    #[inline(always)]
    pub(crate) fn numbers(&self) -> [f64; Self::NUMBERS] {
        let Self { shared_m3, core_m3, own_m3, momentum_m4_s, passed_m4_s2, thinned, mixed } = *self;
        [shared_m3, core_m3, own_m3, momentum_m4_s, passed_m4_s2, thinned, mixed]
    }

    /// The element of such numbers.
    #[inline(always)]
    pub(crate) fn from_numbers(numbers: [f64; Self::NUMBERS]) -> Self {
        let [shared_m3, core_m3, own_m3, momentum_m4_s, passed_m4_s2, thinned, mixed] = numbers;
        Self { shared_m3, core_m3, own_m3, momentum_m4_s, passed_m4_s2, thinned, mixed }
    }
}

impl Thread {
    /// An element at its release.
    pub(crate) fn released(&self) -> Element {
        let v = self.volume_m3;
        Element { shared_m3: v, core_m3: v, own_m3: v, thinned: 1.0, ..Element::default() }
    }

    /// How much faster than the water the element is, m/s, and the speed at which the thread is drawn out, m/s.
    #[inline(always)]
    pub(crate) fn ahead_and_drawn_m_s(&self, shared_m3: f64, speed_m_s: f64, rise_m_s: f64) -> (f64, f64) {
        let ahead = (self.outflow_m_s - speed_m_s).max(0.0) * self.volume_m3 / shared_m3;
        let along = speed_m_s + ahead;
        // What neither flows nor rises is not drawn out to nothing.
        (ahead, (along * along + rise_m_s * rise_m_s).sqrt().max(1e-3))
    }

    /// Variance by which the element's own motion has widened it, m² in each direction: by entraining, and by slowing
    /// down from the speed at which it was released.
    pub(crate) fn grown_m2(&self, e: &Element, around: &Around) -> f64 {
        let rise = e.momentum_m4_s / e.shared_m3;
        let (_, drawn) = self.ahead_and_drawn_m_s(e.shared_m3, around.speed_m_s, rise);
        let section_m2 = self.rate_hz * (e.own_m3 / drawn - self.volume_m3 / self.outflow_m_s);
        // A disc of radius r has the variance r²/4.
        section_m2.max(0.0) / (4.0 * std::f64::consts::PI)
    }

    /// Square of the thickness of the dye at its release, m²: the opening's diameter.
    #[inline(always)]
    pub(crate) fn sheet_m2(&self) -> f64 {
        4.0 * self.volume_m3 * self.rate_hz / (std::f64::consts::PI * self.outflow_m_s)
    }
}
