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
//! within reach of any other wall are not in leaves; see the file `image`.

use crate::simd::dispatch::InstructionSet;

/// Reach of the kernel in standard deviations.
pub const CUT_SIGMAS: f32 = 4.0;

/// Part of the mass within the cut: erf(4/√2) − √(2/π)·4·e⁻⁸.
const WITHIN_CUT: f64 = 0.998_865_98;

/// Most quanta in a filament's peak: with its images it has less than 2⁵¹. Only in water less deep than two filaments
/// are high could there be more.
pub(super) const MOST: f32 = 281_474_976_710_656.0;

/// Filaments in a packet.
pub(super) const PACKET_64: usize = 32;

/// Filaments that are worked out at a time.
pub(super) const LANES: usize = 8;

/// The first places of the eights in which so many filaments are. The compiler sees that all eight are in the packet.
#[inline(always)]
pub(super) fn eights(count: usize) -> impl Iterator<Item = usize> {
    (0..count.div_ceil(LANES).min(PACKET_64 / LANES)).map(|n| LANES * n)
}

/// Concentration at the centre of a filament of `kg` with horizontal and vertical sizes (m), kg/m³.
pub(super) fn peak(kg: f64, [horizontal, vertical]: [f64; 2]) -> f64 {
    let tau = std::f64::consts::TAU;
    kg / (WITHIN_CUT * tau * tau.sqrt() * horizontal * horizontal * vertical)
}

/// Neighbouring filaments in arrays of fixed length; empty places have no mass.
#[derive(Clone, Debug)]
pub(super) struct Packet64 {
    pub(super) x: [f32; PACKET_64],
    pub(super) y: [f32; PACKET_64],
    pub(super) z: [f32; PACKET_64],
    pub(super) bed: [f32; PACKET_64],
    /// 1 / (16 σ²), horizontal and vertical, because exponents are computed as eighths. Until it is sealed: the sizes.
    pub(super) h: [f32; PACKET_64],
    pub(super) v: [f32; PACKET_64],
    /// Concentration at the centre, in quanta.
    pub(super) peak: [f32; PACKET_64],
    pub(super) count: usize,
    /// Greatest vertical reach, m; highest bed, m; least depth, m.
    reach: f32,
    highest_bed: f32,
}

impl Default for Packet64 {
    fn default() -> Self {
        Self {
            x: [0.0; PACKET_64],
            y: [0.0; PACKET_64],
            z: [0.0; PACKET_64],
            bed: [-1.0; PACKET_64],
            h: [1.0; PACKET_64],
            v: [1.0; PACKET_64],
            peak: [0.0; PACKET_64],
            count: 0,
            reach: 0.0,
            highest_bed: f32::MIN,
        }
    }
}

impl Packet64 {
    /// Keeps the filaments of which `keep` says so, given place and sizes (m), in their order.
    pub(super) fn retain(&mut self, mut keep: impl FnMut([f32; 3], [f32; 2]) -> bool) {
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
    pub(super) fn seal(&mut self, path: InstructionSet, kg: f64) {
        path.run(
            #[inline(always)]
            || seal(self, kg),
        );
    }

    /// Concentration at a point in the water, in quanta.
    #[inline]
    pub(super) fn concentration(&self, path: InstructionSet, p: [f32; 3]) -> i64 {
        let images = [-p[2] <= self.reach, p[2] - self.highest_bed <= self.reach, self.reach > -self.highest_bed];
        path.run(
            #[inline(always)]
            || sum(self, images, p),
        )
    }
}

/// Replaces sizes by factors of exponents, sets peaks, and finds the reach and the highest bed.
#[inline(always)]
fn seal(packet: &mut Packet64, kg: f64) {
    let peak_of_one = peak(kg, [1.0; 2]) as f32;
    let (mut tallest, mut highest) = ([0.0_f32; LANES], [f32::MIN; LANES]);
    for from in eights(packet.count) {
        for l in 0..LANES {
            let n = from + l;
            let used = n < packet.count;
            let sh = if used { packet.h[n] } else { 1.0 };
            let sv = if used { packet.v[n] } else { 1.0 };
            let tall = if used { sv } else { 0.0 };
            let bed = if used { packet.bed[n] } else { f32::MIN };
            tallest[l] = if tall > tallest[l] { tall } else { tallest[l] };
            highest[l] = if bed > highest[l] { bed } else { highest[l] };
            packet.h[n] = 1.0 / (16.0 * sh * sh);
            packet.v[n] = 1.0 / (16.0 * sv * sv);
            let peak = peak_of_one / (sh * sh * sv);
            let peak = if peak < MOST { peak } else { MOST };
            packet.peak[n] = if used { peak } else { 0.0 };
        }
    }
    packet.reach = CUT_SIGMAS * tallest.into_iter().fold(0.0, f32::max);
    packet.highest_bed = highest.into_iter().fold(f32::MIN, f32::max);
}

#[inline(always)]
fn sum(packet: &Packet64, images: [bool; 3], p: [f32; 3]) -> i64 {
    match images {
        [_, _, true] => sum_with::<true, true, true>(packet, p),
        [true, true, _] => sum_with::<true, true, false>(packet, p),
        [true, false, _] => sum_with::<true, false, false>(packet, p),
        [false, true, _] => sum_with::<false, true, false>(packet, p),
        [false, false, _] => sum_with::<false, false, false>(packet, p),
    }
}

#[inline(always)]
#[expect(clippy::needless_range_loop, reason = "one index into many arrays is what becomes vector code")]
fn sum_with<const SURFACE: bool, const BED: bool, const AGAIN: bool>(packet: &Packet64, p: [f32; 3]) -> i64 {
    let mut felt = [0.0; PACKET_64];
    let used = packet.count.next_multiple_of(LANES).min(PACKET_64);
    for n in 0..used {
        let at = [packet.x[n], packet.y[n], packet.z[n], packet.bed[n]];
        felt[n] = felt_by::<SURFACE, BED, AGAIN>(at, [packet.h[n], packet.v[n], packet.peak[n]], p);
    }
    let mut whole = Whole::default();
    for from in eights(packet.count) {
        whole.add(&felt, from);
    }
    whole.sum()
}

/// What one filament contributes at a point, in quanta, given its place and bed, and its sealed sizes and peak. An
/// image that is not felt adds a zero; so where none is felt, the bits are those without it.
#[inline(always)]
pub(super) fn felt_by<const SURFACE: bool, const BED: bool, const AGAIN: bool>(
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
pub(super) struct Whole {
    /// Sums of the bits of [`Self::NUMBER`] and the contributions, wrapped, and how many are in each.
    bits: [u64; LANES],
    count: u64,
}

impl Whole {
    /// Added to a number below 2⁵¹, it leaves the nearest whole number in the last bits of the sum.
    const NUMBER: f64 = 6_755_399_441_055_744.0;

    /// Adds the eight contributions from a place on, apart from where they are worked out: there, vector code works on
    /// eight numbers of 32 bits at a time, here on four of 64 bits.
    #[inline(always)]
    pub(super) fn add<const N: usize>(&mut self, felt: &[f32; N], from: usize) {
        for l in 0..LANES {
            let whole = f64::from(felt[from + l]) + Self::NUMBER;
            self.bits[l] = self.bits[l].wrapping_add(whole.to_bits());
        }
        self.count += 1;
    }

    #[inline(always)]
    pub(super) fn sum(self) -> i64 {
        let numbers = (self.count * LANES as u64).wrapping_mul(Self::NUMBER.to_bits());
        let bits = self.bits.into_iter().fold(0, u64::wrapping_add);
        bits.wrapping_sub(numbers).cast_signed()
    }
}

/// exp(−8w) for w ≤ 1, zero beyond.
#[inline(always)]
pub(super) fn falling(w: f32) -> f32 {
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

    #[test]
    fn all_versions_give_the_same_bits() {
        let mut packet = Packet64::default();
        for n in 0..30 {
            let a = n as f32;
            (packet.x[n], packet.y[n], packet.z[n]) = (0.1 * a, -0.07 * a, -1.0 - 0.05 * a);
            packet.bed[n] = -4.0 + 0.01 * a;
            (packet.h[n], packet.v[n]) = (0.5 + 0.1 * a, 0.3 + 0.04 * a);
        }
        packet.count = 30;
        let open = packet.clone();
        packet.seal(InstructionSet::Portable, 1e6);
        for path in InstructionSet::all() {
            let mut sealed = open.clone();
            sealed.seal(path, 1e6);
            assert_eq!(format!("{sealed:?}"), format!("{packet:?}"), "{path:?}");
        }
        for n in 0..1000 {
            let a = n as f32 * 0.01;
            let p = [a - 3.0, 2.0 - a, -0.004 * a];
            let portable = packet.concentration(InstructionSet::Portable, p);
            for path in InstructionSet::all() {
                assert_eq!(packet.concentration(path, p), portable, "{path:?}");
            }
        }
        assert!(packet.concentration(InstructionSet::Portable, [1.0, -1.0, -1.5]) > 1000);
    }
}
