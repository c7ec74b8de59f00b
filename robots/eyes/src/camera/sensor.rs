//! From light to numbers: exposure, photon and reading noise, white balance, 8 bits.
//!
//! *Source:* photon transfer of image sensors (Janesick 2001, Scientific Charge-Coupled Devices, ch. 2; EMVA Standard
//! 1288); light on the sensor π/4 L/N² cos⁴ (any text on optics); transfer curve of IEC 61966-2-1 (sRGB).
//!
//! *Parameters:* `exposure_s` fixed, s, or automatic: the mean of the picture becomes `target` 0.2 of full scale,
//! first with at most `max_exposure_s` 1/30 s and then with at most `max_gain` 16; `f_number` N 2;
//! `electrons_per_lux_s` 10 000, `full_well_e` 10 000 and `read_noise_e` 5 electrons: a pixel of some 4 µm;
//! `white_balance` 4: red and blue are multiplied to reach the mean of green, by at most this factor; 1 leaves
//! daylight white: grey world with the limit of libcamera's software pipeline (`ipa/simple/algorithms/awb.cpp`:
//! "Clamp max gain at 4.0"); `saturation` 1.7: a colour's distance from grey is multiplied by this factor to undo the
//! overlap of the sensitivities of `bands.rs`. It is the least-squares factor, 1.74, between white-balanced responses
//! and linear sRGB for 2000 smooth reflectances in D65; the full matrix of a camera does more (libcamera's
//! `imx219.json` at 5858 K: 2.32, 2.58, 1.83 on the diagonal).
//!
//! *Deviations:* every pixel has all colours, without the mosaic. Noise is the sum of four uniform numbers: its mean
//! and variance are right, it is bounded by 3.46 standard deviations, and for fewer than some ten electrons it is not
//! yet Poisson's.

use super::bands::Rgb;
use robots::sense::SensorSpec;
use std::f64::consts::PI;
use world::math;

/// A sensor set for one picture.
pub(super) struct ExposedSensor {
    /// Electrons for 1 cd/m².
    electrons: f64,
    /// Share of full scale for one electron, by colour.
    scale: Rgb,
    /// Reading noise, squared.
    read2: f64,
    saturation: f64,
    key: u64,
    curve: Vec<u8>,
}

/// Steps of the transfer curve's table.
const STEPS: usize = 4096;

impl ExposedSensor {
    /// Sets exposure, gain and white balance for a picture of the mean radiance `mean` (cd/m²).
    pub(super) fn new(spec: &SensorSpec, mean: Rgb, key: u64) -> Self {
        let n = spec.f_number.get();
        let rate = 0.25 * PI / (n * n) * spec.electrons_per_lux_s.get();
        let full = spec.full_well_e.get();
        let level = grey(&mean);
        // In the dark, exposure and gain reach their limits.
        let wanted = full * spec.target.get() / (rate * level).max(f64::MIN_POSITIVE);
        let (exposure, gain) = match spec.exposure_s {
            Some(fixed) => (fixed.get(), 1.0),
            None => {
                let longest = spec.max_exposure_s.get();
                let most = spec.max_gain.get().max(1.0);
                (wanted.min(longest), (wanted / longest).clamp(1.0, most))
            }
        };
        let most = spec.white_balance.get().max(1.0);
        let scale = [0, 1, 2].map(|i| {
            let off = if mean[i] > 0.0 { mean[1] / mean[i] } else { 1.0 };
            gain / full * off.clamp(1.0 / most, most)
        });
        let curve = (0..=STEPS).map(|k| transfer(k as f64 / STEPS as f64)).collect();
        let read = spec.read_noise_e.get();
        Self { electrons: rate * exposure, scale, read2: read * read, saturation: spec.saturation.get(), key, curve }
    }

    /// The three bytes of pixel number `n` for its radiance (cd/m²).
    pub(super) fn pixel(&self, n: u64, radiance: Rgb) -> [u8; 3] {
        let shares = [0, 1, 2].map(|i: usize| {
            let e = radiance[i] * self.electrons;
            let noisy = e + (e + self.read2).sqrt() * noise(self.key, 3 * n + i as u64);
            noisy * self.scale[i]
        });
        let grey = grey(&shares);
        shares.map(|share| {
            let share = (grey + self.saturation * (share - grey)).clamp(0.0, 1.0);
            self.curve[(share * STEPS as f64 + 0.5) as usize]
        })
    }
}

/// Brightness of a colour.
fn grey(c: &Rgb) -> f64 {
    0.25 * c[0] + 0.5 * c[1] + 0.25 * c[2]
}

/// sRGB's transfer curve, rounded to 8 bits.
fn transfer(share: f64) -> u8 {
    let bent = if share <= 0.003_130_8 { 12.92 * share } else { 1.055 * math::powf(share, 1.0 / 2.4) - 0.055 };
    (255.0 * bent + 0.5) as u8
}

/// A well-mixed 64-bit number for a counter under a key (the finaliser of splitmix64: Steele, Lea & Flood 2014,
/// OOPSLA, 453).
pub(super) fn hash(key: u64, counter: u64) -> u64 {
    let mut z = key.wrapping_add(counter.wrapping_add(1).wrapping_mul(0x9e37_79b9_7f4a_7c15));
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Noise of mean 0 and variance 1.
fn noise(key: u64, counter: u64) -> f64 {
    let h = hash(key, counter);
    let sum = (h & 0xffff) + ((h >> 16) & 0xffff) + ((h >> 32) & 0xffff) + (h >> 48);
    // Four numbers uniform over 65536 values: mean 4 · 32767.5, variance 4 · (65536² - 1)/12.
    (sum as f64 - 131_070.0) / 37_837.227
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::ranges::{NonNegative, Positive};

    #[test]
    fn noise_has_mean_zero_and_variance_one() {
        let n = 400_000;
        let (mut m, mut v) = (0.0, 0.0);
        for k in 0..n {
            let z = noise(7, k);
            m += z;
            v += z * z;
        }
        let n = n as f64;
        // 5 standard errors; the kurtosis of four uniform numbers is 2.7, so the variance's error is √(1.7/n).
        assert!((m / n).abs() < 5.0 / n.sqrt());
        assert!((v / n - 1.0).abs() < 5.0 * (1.7 / n).sqrt());
    }

    #[test]
    fn photon_noise_grows_as_the_root_of_the_light() {
        let spec = SensorSpec {
            exposure_s: Some(Positive::new(0.01)),
            saturation: NonNegative::new(1.0),
            ..SensorSpec::default()
        };
        let exposed = ExposedSensor::new(&spec, [1.0; 3], 3);
        // Electrons for L: π/16 · 1e4 · 0.01 · L; bytes are converted back with the curve's inverse.
        for radiance in [50.0, 150.0, 300.0] {
            let electrons = PI / 16.0 * 100.0 * radiance;
            let (n, mut m, mut v) = (40_000, 0.0, 0.0);
            for k in 0..n {
                let byte = f64::from(exposed.pixel(k, [radiance; 3])[1]) / 255.0;
                let e = 1e4 * math::powf((byte + 0.055) / 1.055, 2.4);
                m += e;
                v += e * e;
            }
            let (m, n) = (m / n as f64, n as f64);
            let (v, want) = (v / n - m * m, electrons + 25.0);
            // A byte is 1/255 of the curved scale: it adds step²/12 to the variance, with the slope of the curve
            // there.
            let step = 1e4 / 255.0 * 2.4 / 1.055 * math::powf(electrons / 1e4, 1.4 / 2.4);
            let want = want + step * step / 12.0;
            assert!((m - electrons).abs() < 5.0 * (want / n).sqrt() + 0.05 * step, "{m} {electrons}");
            assert!((v / want - 1.0).abs() < 0.08, "{v} {want}");
        }
    }

    #[test]
    fn the_curve_runs_from_black_to_white() {
        assert_eq!([0.0, 1.0].map(transfer), [0, 255]);
        // sRGB: middle grey of 0.2140 is 127.5.
        assert_eq!(transfer(0.2159), 128);
    }

    #[test]
    fn automatic_exposure_brings_the_mean_to_its_target_as_far_as_it_can() {
        let spec = SensorSpec::default();
        let level = |l: f64| {
            let e = ExposedSensor::new(&spec, [l; 3], 0);
            l * e.electrons * e.scale[1]
        };
        assert!((level(100.0) - 0.2).abs() < 1e-12 && (level(5.0) - 0.2).abs() < 1e-12);
        // 1/30 s at gain 16: 0.01 cd/m² stays dark.
        assert!(level(0.01) < 0.02);
    }
}
