//! Concentration at a point from a few neighbouring filaments.
//!
//! *Source*: Gaussian kernel with mirror images at bed and surface (Csanady 1973, Turbulent Diffusion in the
//! Environment, ch. 3; any text on plumes); the kernel's form is that of `size.rs`.
//!
//! *Parameters*: [`CUT_SIGMAS`]: the kernel is zero beyond this many standard deviations.
//!
//! *Deviations*: the kernel is cut at 4σ, where it has fallen to 3.4e-4 of its peak, and divided by the 0.998866 of its
//! mass that lies within, so that it integrates to 1. Inside the cut every value is therefore 0.11 % higher than that
//! of the uncut kernel. The bed counts as level under each filament, at its height there. There is one image at each
//! boundary and, where the kernel reaches it, one more of each; vertical sizes of at most half the depth need no
//! others. The exponential is a polynomial of degree 5 to the eighth power, within 1e-5 of the function. Filaments
//! within reach of any other wall are not in packets; see the file `image`. An image at the surface or at the bed is
//! worked out only if one of a packet may be felt.

use crate::simd::dispatch::InstructionSet;

/// Reach of the kernel in standard deviations.
pub const CUT_SIGMAS: f32 = 4.0;

/// Part of the mass within the cut: erf(4/√2) − √(2/π)·4·e⁻⁸.
const WITHIN_CUT: f64 = 0.998_865_98;

/// Most quanta in a filament's peak: with its images it has less than 2⁵¹. Only in water less deep than two filaments
/// are high could there be more.
pub(crate) const MOST: f32 = 281_474_976_710_656.0;

/// Filaments in a packet.
pub(crate) const PACKET: usize = 16;

/// Contributions that are added at a time.
const LANES: usize = 8;

/// Concentration at the centre of a filament of `kg` with horizontal and vertical sizes (m), kg/m³.
pub(crate) fn peak(kg: f64, [horizontal, vertical]: [f64; 2]) -> f64 {
    let tau = std::f64::consts::TAU;
    kg / (WITHIN_CUT * tau * tau.sqrt() * horizontal * horizontal * vertical)
}

/// Neighbouring filaments in arrays of fixed length, of which no vector lies across two lines of the processor's cache.
/// Empty places have no mass once it is sealed.
#[derive(Clone, Debug)]
#[repr(align(64))]
pub(crate) struct Packet {
    pub(crate) x: [f32; PACKET],
    pub(crate) y: [f32; PACKET],
    pub(crate) z: [f32; PACKET],
    pub(crate) bed: [f32; PACKET],
    /// 1 / (16 σ²), horizontal and vertical, because exponents are computed as eighths. Until it is sealed: the sizes.
    pub(crate) h: [f32; PACKET],
    pub(crate) v: [f32; PACKET],
    /// Concentration at the centre, in quanta.
    pub(crate) peak: [f32; PACKET],
    pub(crate) count: usize,
    images: Images,
}

/// Where images of a packet's filaments may be felt.
#[derive(Clone, Copy, Debug)]
struct Images {
    /// Those at the surface: not deeper than this, m.
    surface: f32,
    /// Those at the bed: not higher than this, m.
    bed: f32,
    /// Greatest vertical reach, m; highest bed, m.
    reach: f32,
    highest_bed: f32,
}

impl Default for Packet {
    fn default() -> Self {
        Self {
            x: [0.0; PACKET],
            y: [0.0; PACKET],
            z: [0.0; PACKET],
            bed: [-1.0; PACKET],
            h: [1.0; PACKET],
            v: [1.0; PACKET],
            peak: [0.0; PACKET],
            count: 0,
            images: Images { surface: f32::MIN, bed: f32::MIN, reach: 0.0, highest_bed: f32::MIN },
        }
    }
}

impl Packet {
    /// Keeps the filaments of which `keep` says so, given place and sizes (m), in their order.
    pub(crate) fn retain(&mut self, mut keep: impl FnMut([f32; 3], [f32; 2]) -> bool) {
        let mut to = 0;
        for n in 0..self.count {
            if keep([self.x[n], self.y[n], self.z[n]], [self.h[n], self.v[n]]) {
                let all = [&mut self.x, &mut self.y, &mut self.z, &mut self.bed];
                for v in all.into_iter().chain([&mut self.h, &mut self.v]) {
                    v[to] = v[n];
                }
                to += 1;
            }
        }
        self.count = to;
    }

    /// Works out what follows from the sizes, which `h` and `v` hold until then, of filaments of `kg` each, in which the
    /// unit of mass is that of a quantum in a m³.
    pub(crate) fn seal(&mut self, path: InstructionSet, kg: f64) {
        path.run(
            #[inline(always)]
            || seal(self, kg),
        );
    }

    /// Concentration at a point in the water, in quanta.
    #[inline]
    pub(crate) fn concentration(&self, path: InstructionSet, p: [f32; 3]) -> i64 {
        let mut total = Whole::default();
        path.run(
            #[inline(always)]
            || self.add(p, &mut total),
        );
        total.sum()
    }

    /// Adds what they contribute at a point; for vector code that calls it.
    #[inline(always)]
    pub(crate) fn add(&self, p: [f32; 3], total: &mut Whole) {
        let Images { surface, bed, reach, highest_bed } = self.images;
        match (reach > -highest_bed, -p[2] <= surface, p[2] <= bed) {
            (true, ..) => self.add_with::<true, true, true>(p, total),
            (_, true, true) => self.add_with::<true, true, false>(p, total),
            (_, true, false) => self.add_with::<true, false, false>(p, total),
            (_, false, true) => self.add_with::<false, true, false>(p, total),
            _ => self.add_with::<false, false, false>(p, total),
        }
    }

    #[inline(always)]
    fn add_with<const SURFACE: bool, const BED: bool, const AGAIN: bool>(&self, p: [f32; 3], total: &mut Whole) {
        let mut felt = [0.0; PACKET];
        for (l, felt) in felt.iter_mut().enumerate() {
            let at = [self.x[l], self.y[l], self.z[l], self.bed[l]];
            *felt = felt_by::<SURFACE, BED, AGAIN>(at, [self.h[l], self.v[l], self.peak[l]], p);
        }
        total.add(&felt);
    }
}

/// Replaces sizes by factors of exponents, sets peaks, and finds where images are felt.
#[inline(always)]
fn seal(packet: &mut Packet, kg: f64) {
    let peak_of_one = peak(kg, [1.0; 2]) as f32;
    let [mut surface, mut low, mut highest] = [[f32::MIN; PACKET]; 3];
    let mut tallest = [0.0; PACKET];
    for n in 0..PACKET {
        let used = n < packet.count;
        let sh = if used { packet.h[n] } else { 1.0 };
        let sv = if used { packet.v[n] } else { 1.0 };
        let (z, bed, more) = (packet.z[n], packet.bed[n], CUT_SIGMAS * 1.000_1 * sv);
        surface[n] = if used { z + more } else { f32::MIN };
        low[n] = if used { 2.0 * bed - z + more } else { f32::MIN };
        tallest[n] = if used { CUT_SIGMAS * sv } else { 0.0 };
        highest[n] = if used { bed } else { f32::MIN };
        packet.h[n] = 1.0 / (16.0 * sh * sh);
        packet.v[n] = 1.0 / (16.0 * sv * sv);
        let peak = peak_of_one / (sh * sh * sv);
        let peak = if peak < MOST { peak } else { MOST };
        packet.peak[n] = if used { peak } else { 0.0 };
    }
    let most = |all: [f32; PACKET]| all.into_iter().fold(f32::MIN, f32::max);
    packet.images = Images { surface: most(surface), bed: most(low), reach: most(tallest), highest_bed: most(highest) };
}

/// What one filament contributes at a point, in quanta, given its place and bed, and its sealed sizes and peak. An
/// image that is not felt adds a zero; so where none is felt, the bits are those without it.
#[inline(always)]
fn felt_by<const SURFACE: bool, const BED: bool, const AGAIN: bool>(
    [x, y, z, bed]: [f32; 4],
    [h, v, peak]: [f32; 3],
    p: [f32; 3],
) -> f32 {
    let (dx, dy) = (p[0] - x, p[1] - y);
    let flat = (dx * dx + dy * dy) * h;
    let term = |centre: f32| {
        let dz = p[2] - centre;
        falling(flat + dz * dz * v)
    };
    let mut felt = term(z);
    match (SURFACE, BED) {
        (true, true) => felt += term(-z) + term(2.0 * bed - z),
        (true, false) => felt += term(-z),
        (false, true) => felt += term(2.0 * bed - z),
        (false, false) => {}
    }
    if AGAIN {
        felt += term(z - 2.0 * bed) + term(z + 2.0 * bed);
    }
    peak * felt
}

/// A sum of contributions, each rounded to a whole number of quanta.
#[derive(Clone, Copy, Default)]
pub(crate) struct Whole {
    /// Sums of the bits of [`Self::NUMBER`] and the contributions, wrapped, and how many there are.
    bits: [u64; LANES],
    count: u64,
}

impl Whole {
    /// Added to a number below 2⁵¹, it leaves the nearest whole number in the last bits of the sum.
    const NUMBER: f64 = 6_755_399_441_055_744.0;

    /// Adds contributions, apart from where they are worked out: there, vector code works on eight numbers of 32 bits at
    /// a time, here on four of 64 bits.
    #[inline(always)]
    fn add(&mut self, felt: &[f32; PACKET]) {
        for some in felt.as_chunks::<LANES>().0 {
            for (bits, felt) in self.bits.iter_mut().zip(some) {
                *bits = bits.wrapping_add((f64::from(*felt) + Self::NUMBER).to_bits());
            }
        }
        self.count += PACKET as u64;
    }

    #[inline(always)]
    pub(crate) fn sum(self) -> i64 {
        let numbers = self.count.wrapping_mul(Self::NUMBER.to_bits());
        let bits = self.bits.into_iter().fold(0, u64::wrapping_add);
        bits.wrapping_sub(numbers).cast_signed()
    }
}

/// exp(−8w) for w ≤ 1, zero beyond.
#[inline(always)]
pub(crate) fn falling(w: f32) -> f32 {
    // Interpolates exp(−w) at the Chebyshev points of [0, 1].
    const C: [f32; 6] = [0.999_999_5, -0.999_967_9, 0.499_620_87, -0.165_012_72, 0.038_338_923, -0.005_099_728];
    let q = C[0] + w * (C[1] + w * (C[2] + w * (C[3] + w * (C[4] + w * C[5]))));
    let (q2, inside) = (q * q, w <= 1.0);
    let q4 = q2 * q2;
    if inside { q4 * q4 } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomial_is_close_to_the_exponential() {
        for k in 0..=1000 {
            let w = f64::from(k) / 1000.0;
            let exact = world::math::exp(-8.0 * w);
            assert!((f64::from(falling(w as f32)) / exact - 1.0).abs() < 1e-5, "{w}");
        }
        assert_eq!(falling(1.001), 0.0);
    }
}
