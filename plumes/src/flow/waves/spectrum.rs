//! A wind sea as a number of waves of equal energy, drawn from a spectrum with directions.
//!
//! *Source*: JONSWAP, Hasselmann et al. 1973, Dtsch. Hydrogr. Z. Suppl. A8(12): S(f) ∝ f⁻⁵ exp(−1.25 (f_p/f)⁴) γ^b,
//! b = exp(−(f/f_p − 1)²/2σ²), σ = 0.07 below f_p and 0.09 above; γ = 1 is Pierson & Moskowitz 1964, J. Geophys. Res. 69, 5181. Directions
//! ∝ cos^(2s)(θ/2), Longuet-Higgins, Cartwright & Smith 1963; s = 10 for wind waves, Goda 2010, Random Seas, section 2.3.
//!
//! *Parameters*: `significant_height_m` H_s (m), `peak_period_s` 1/f_p (s), `heading_deg` where they travel, `peakedness` γ 3.3,
//! `spreading` s 10, `components` n 32.
//!
//! *Deviations*: frequencies from half to four times the peak's, scaled to the whole variance H_s²/16 (beyond lies half a percent).
//! n bins of equal energy, each a wave of amplitude H_s/√(8n) at its bin's mean frequency: the variance and the mean frequency are the
//! spectrum's exactly, the heights Gaussian as n grows; unequal bins keep it from repeating. Bins take the directions' quantiles in golden steps from
//! a drawn one, phases are drawn. s is the same at all frequencies.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};
use world::math;
use world::ranges::{HeadingDeg, NonNegative, Positive};
use world::seeds::Stream;

/// A sea raised by the wind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpectrumSpec {
    /// Four standard deviations of the surface, m.
    #[serde(with = "world::limits::wave_m")]
    pub significant_height_m: Positive,
    /// Period of the spectrum's peak, s.
    #[serde(with = "world::limits::wave_s")]
    pub peak_period_s: Positive,
    /// Where the waves travel, degrees clockwise from north.
    pub heading_deg: HeadingDeg,
    /// γ: 3.3 a growing sea, 1 a fully grown one.
    #[serde(default = "jonswap", with = "world::limits::peakedness")]
    pub peakedness: Positive,
    /// s: the greater, the longer the crests.
    #[serde(default = "wind_waves", with = "world::limits::spreading")]
    pub spreading: NonNegative,
    /// How many waves stand for it, from 1 to 200.
    #[serde(default = "enough")]
    pub components: u32,
}

const fn jonswap() -> Positive {
    Positive::new(3.3)
}

const fn wind_waves() -> NonNegative {
    NonNegative::new(10.0)
}

const fn enough() -> u32 {
    32
}

/// One wave of the sea.
#[derive(Clone, Copy, Debug)]
pub(super) struct SeaComponent {
    pub(super) amplitude_m: f64,
    pub(super) omega: f64,
    /// Anticlockwise from `heading_deg`, rad.
    pub(super) turned: f64,
    pub(super) phase: f64,
}

/// Frequencies over the peak's between which the spectrum is cut.
const BAND: [f64; 2] = [0.5, 4.0];
const FINE: usize = 4000;

/// Density at a frequency in units of the peak's, unnormalised.
fn density(f: f64, peakedness: f64) -> f64 {
    let f4 = f * f * f * f;
    let sigma = if f <= 1.0 { 0.07 } else { 0.09 };
    let off = (f - 1.0) / sigma;
    let peak = math::powf(peakedness, math::exp(-0.5 * off * off));
    math::exp(-1.25 / f4) / (f4 * f) * peak
}

impl SpectrumSpec {
    /// The waves, drawn.
    pub(super) fn draw(&self, rng: &mut Stream) -> Vec<SeaComponent> {
        let n = self.components as usize;
        let amplitude_m = self.significant_height_m.get() / (8.0 * n as f64).sqrt();
        let peak = TAU / self.peak_period_s.get();
        let turns = Directions::new(self.spreading.get());
        let first = rng.uniform();
        let mean = means(n, self.peakedness.get());
        mean.into_iter()
            .enumerate()
            .map(|(i, f)| SeaComponent {
                amplitude_m,
                omega: peak * f,
                turned: turns.quantile((first + i as f64 * 0.618_033_988_75).fract()),
                phase: TAU * rng.uniform(),
            })
            .collect()
    }
}

/// Mean frequency (over the peak's) of each of `n` bins of equal energy.
fn means(n: usize, peakedness: f64) -> Vec<f64> {
    let step = (BAND[1] - BAND[0]) / FINE as f64;
    let cells: Vec<[f64; 2]> = (0..FINE)
        .map(|i| {
            let f = BAND[0] + (i as f64 + 0.5) * step;
            [f, density(f, peakedness)]
        })
        .collect();
    let whole: f64 = cells.iter().map(|c| c[1]).sum();
    let (mut mean, mut bin) = (vec![0.0; n], 0);
    let mut room = whole / n as f64;
    for [f, energy] in cells {
        let mut left = energy;
        // A cell may end one bin and begin the next, or fill several.
        while left > room && bin + 1 < n {
            mean[bin] += f * room;
            left -= room;
            room = whole / n as f64;
            bin += 1;
        }
        mean[bin] += f * left;
        room -= left;
    }
    mean.iter().map(|m| m * n as f64 / whole).collect()
}

/// Distribution of directions about the mean one.
struct Directions {
    // Cumulative, at even angles from −π to π.
    sum: Vec<f64>,
}

impl Directions {
    fn new(s: f64) -> Self {
        const N: usize = 720;
        let mut sum = vec![0.0];
        for i in 0..N {
            let angle = -PI + TAU * (i as f64 + 0.5) / N as f64;
            sum.push(sum[i] + math::powf(math::cos(0.5 * angle), 2.0 * s));
        }
        Self { sum }
    }

    fn quantile(&self, q: f64) -> f64 {
        let n = self.sum.len() - 1;
        let wanted = q * self.sum[n];
        let i = self.sum.partition_point(|s| *s <= wanted).clamp(1, n);
        let part = (wanted - self.sum[i - 1]) / (self.sum[i] - self.sum[i - 1]);
        -PI + TAU * ((i - 1) as f64 + part) / n as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spec(components: u32) -> SpectrumSpec {
        SpectrumSpec {
            significant_height_m: Positive::new(0.5),
            peak_period_s: Positive::new(4.0),
            heading_deg: HeadingDeg::new(0.0),
            peakedness: jonswap(),
            spreading: wind_waves(),
            components,
        }
    }

    fn drawn(components: u32) -> Vec<SeaComponent> {
        spec(components).draw(&mut Stream::new(3, "test", "sea"))
    }

    /// Mean period of a JONSWAP sea with γ = 3.3 is 0.834 of the peak's (Goda 2010, section 2.3), of a Pierson-Moskowitz one 0.772.
    #[test]
    fn mean_frequency_is_the_spectrums() {
        for (peakedness, want) in [(3.3, 0.834), (1.0, 0.772)] {
            for n in [1, 32] {
                let mean = means(n, peakedness).iter().sum::<f64>() / n as f64;
                // The published factors have three figures; the cut at four times the peak leaves out under 1 %.
                assert!((1.0 / mean / want - 1.0).abs() < 0.02, "{peakedness} {mean}");
            }
        }
        let bins = means(32, 3.3);
        assert!(bins.windows(2).all(|w| w[0] < w[1]) && bins[0] > 0.7);
    }

    /// Mean of cos θ under cos^(2s)(θ/2) is s/(s + 1).
    #[test]
    fn directions_spread_as_they_should() {
        let d = Directions::new(10.0);
        let n = 10_000;
        let mean: f64 =
            (0..n).map(|i| math::cos(d.quantile((f64::from(i) + 0.5) / f64::from(n)))).sum::<f64>() / f64::from(n);
        assert!((mean - 10.0 / 11.0).abs() < 1e-4, "{mean}");
        assert!(d.quantile(0.5).abs() < 1e-9);
        // Thirty-two of them in golden steps are close to it, whatever the first.
        let few: f64 = drawn(32).iter().map(|w| math::cos(w.turned)).sum::<f64>() / 32.0;
        assert!((few - 10.0 / 11.0).abs() < 0.02, "{few}");
    }

    #[test]
    fn phases_follow_from_the_seed() {
        let again = drawn(32);
        assert!((drawn(32).iter().zip(&again)).all(|(a, b)| a.phase == b.phase));
        let other = spec(32).draw(&mut Stream::new(4, "test", "sea"));
        assert!(other[0].phase != again[0].phase && other[0].omega == again[0].omega);
    }
}
