//! Four standard normals for one filament in one step, from a hash instead of a stream.
//!
//! *Source*: counter-based generators, Salmon, Moraes, Dror & Shaw 2011, SC'11 ("Parallel random numbers: as easy
//! as 1, 2, 3"); the mixing function is Wellons' `lowbias32` (2018, two multiplications, bias 0.17); Box & Muller
//! 1958, Ann. Math. Stat. 29, 610.
//!
//! *Parameters*: the key, 64 bits made of the run's seed, the source's id and the number of the step; the counter,
//! which is the number of the filament.
//!
//! *Deviations*: logarithm, sine and cosine are series in f32 without branches or tables, so that the compiler can
//! compute eight filaments at once. Each is within 1e-6 of the function. The radius has 24 bits, so no value exceeds
//! 5.9. Over 10⁷ values per axis, variance and kurtosis agree with 1 and 3 within five standard errors (0.0023, 0.016;
//! tests below).

use crate::logarithm::ln;
use std::f32::consts::TAU;

/// Key of one step. Both halves differ between all steps, sources and seeds.
pub(crate) fn step_key(source_key: u64, step: u64) -> [u32; 2] {
    // SplitMix64 (Steele, Lea & Flood 2014).
    let mut z = source_key.wrapping_add(step.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^= z >> 31;
    [z as u32, (z >> 32) as u32]
}

/// Four independent standard normals of a filament in the step with this key.
#[inline(always)]
pub(crate) fn normals(number: u32, key: [u32; 2]) -> [f32; 4] {
    let h = mix(number.wrapping_mul(0x9e37_79b9) ^ key[0]);
    let a = mix(h ^ key[1]);
    let b = mix(h.wrapping_add(key[1]) ^ 0x6a09_e667);
    let c = mix(h.wrapping_sub(key[1]) ^ 0xbb67_ae85);
    // 24 bits each for two radii and one angle. Their low bytes together make the other angle.
    let rest = (a & 0xff) | ((b & 0xff) << 8) | ((c & 0xff) << 16);
    let (r1, r2) = (radius(a >> 8), radius(b >> 8));
    let (s1, c1) = sin_cos_turn(c >> 8);
    let (s2, c2) = sin_cos_turn(rest);
    [r1 * c1, r1 * s1, r2 * s2, r2 * c2]
}

/// The first two of these, alone.
#[inline(always)]
pub(crate) fn level_normals(number: u32, key: [u32; 2]) -> [f32; 2] {
    let h = mix(number.wrapping_mul(0x9e37_79b9) ^ key[0]);
    let r = radius(mix(h ^ key[1]) >> 8);
    let (s, c) = sin_cos_turn(mix(h.wrapping_sub(key[1]) ^ 0xbb67_ae85) >> 8);
    [r * c, r * s]
}

/// The last two, which kick it upwards.
pub(crate) fn upward_normals(number: u32, key: [u32; 2]) -> [f32; 2] {
    let [_, _, a, b] = normals(number, key);
    [a, b]
}

#[inline(always)]
fn mix(mut x: u32) -> u32 {
    x ^= x >> 16;
    x = x.wrapping_mul(0x7feb_352d);
    x ^= x >> 15;
    x = x.wrapping_mul(0x846c_a68b);
    x ^ (x >> 16)
}

/// √(−2 ln u), u = (bits + ½)·2⁻²⁴.
#[inline(always)]
fn radius(bits: u32) -> f32 {
    let u = bits as i32 as f32 + 0.5;
    (-2.0 * ln(u, 24)).max(0.0).sqrt()
}

/// Sine and cosine of an angle that is uniform over the circle: 23 bits of half a turn, and one bit for the other half.
#[inline(always)]
fn sin_cos_turn(bits: u32) -> (f32, f32) {
    let half = (bits & 0x7f_ffff) as i32 - 0x40_0000;
    let x = (half as f32 + 0.5) * (TAU / 16_777_216.0);
    let q = x * x;
    // Taylor series; |x| ≤ π/2, so the first omitted term is below 6e-8 (sine) and 5e-7 (cosine).
    let s = x
        * (1.0
            + q * (-1.0 / 6.0
                + q * (1.0 / 120.0 + q * (-1.0 / 5040.0 + q * (1.0 / 362_880.0 - q * (1.0 / 39_916_800.0))))));
    let c = 1.0 + q * (-0.5 + q * (1.0 / 24.0 + q * (-1.0 / 720.0 + q * (1.0 / 40_320.0 - q * (1.0 / 3_628_800.0)))));
    let sign = (bits & 0x80_0000) << 8;
    (f32::from_bits(s.to_bits() ^ sign), f32::from_bits(c.to_bits() ^ sign))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_those_of_independent_normals() {
        // 1000 steps of 10⁴ filaments. Standard errors with n = 10⁷: mean 1/√n = 3.2e-4, variance √(2/n) = 4.5e-4,
        // third moment √(15/n) = 1.2e-3, fourth √(96/n) = 3.1e-3, products 1/√n. Five of each.
        let n = 1e7;
        let (mut m, mut last) = ([[0.0_f64; 4]; 4], vec![[0.0_f64; 4]; 10_000]);
        let (mut cross, mut serial, mut neighbour) = ([0.0; 4], [0.0; 4], [0.0; 4]);
        // Of one pair, 2 and 3: product of squares, 1 with standard error √(8/n).
        let mut squares = 0.0;
        for step in 0..1000 {
            let key = step_key(7, step);
            let mut before = [0.0; 4];
            for (number, last) in last.iter_mut().enumerate() {
                let z = normals(number as u32, key).map(f64::from);
                for d in 0..4 {
                    let q = z[d] * z[d];
                    m[d][0] += z[d];
                    m[d][1] += q;
                    m[d][2] += q * z[d];
                    m[d][3] += q * q;
                    cross[d] += z[d] * z[(d + 1) % 4];
                    serial[d] += z[d] * last[d];
                    neighbour[d] += z[d] * before[d];
                }
                squares += z[2] * z[2] * z[3] * z[3];
                *last = z;
                before = z;
            }
        }
        assert!((squares / n - 1.0).abs() < 4.5e-3, "squares: {}", squares / n);
        for d in 0..4 {
            assert!((m[d][0] / n).abs() < 1.6e-3, "mean {d}: {}", m[d][0] / n);
            assert!((m[d][1] / n - 1.0).abs() < 2.3e-3, "variance {d}: {}", m[d][1] / n);
            assert!((m[d][2] / n).abs() < 6.2e-3, "third {d}: {}", m[d][2] / n);
            assert!((m[d][3] / n - 3.0).abs() < 1.6e-2, "fourth {d}: {}", m[d][3] / n);
            for r in [cross[d], serial[d], neighbour[d]] {
                assert!((r / n).abs() < 1.6e-3, "correlation {d}: {}", r / n);
            }
        }
    }

    #[test]
    fn level_normals_are_the_first_two() {
        for step in 0..100 {
            let key = step_key(11, step);
            for number in 0..1000 {
                let [a, b, ..] = normals(number, key);
                assert_eq!(level_normals(number, key), [a, b]);
            }
        }
    }

    #[test]
    fn series_are_close_to_the_functions() {
        for k in 0..200_000_u32 {
            let bits = k.wrapping_mul(0x9e37_79b9) >> 8;
            let u = (f64::from(bits) + 0.5) / 16_777_216.0;
            let r = (-2.0 * world::math::ln(u)).sqrt();
            // Near u = 1 the half is rounded away in f32: u has an error of up to 2⁻²⁵, the radius one of half that
            // over r.
            assert!((f64::from(radius(bits)) - r).abs() < 1e-6 * r + 6e-8 / r, "{u}");
            let (s, c) = sin_cos_turn(bits);
            let half = f64::from((bits & 0x7f_ffff) as i32 - 0x40_0000) + 0.5;
            let turn = half / 16_777_216.0 + if bits & 0x80_0000 == 0 { 0.0 } else { 0.5 };
            let (ts, tc) = world::math::sin_cos(turn * std::f64::consts::TAU);
            assert!((f64::from(s) - ts).abs() < 1e-6 && (f64::from(c) - tc).abs() < 1e-6);
        }
    }
}
