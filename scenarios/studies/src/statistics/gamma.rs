//! The gamma distribution fitted to a sample, and the distance of the sample from it.
//!
//! *Source*: regularised incomplete gamma function by series and continued fraction, Abramowitz & Stegun 1964, 6.5.29
//! and 6.5.31; ln Γ by Lanczos 1964, SIAM J. Numer. Anal. B 1, 86; distance of Kolmogorov and Smirnov.
//!
//! *Parameters*: shape k = mean²/variance (moments), scale mean/k.
//!
//! *Deviations*: none.

use world::math;

/// ln Γ(x), x > 0.
fn ln_gamma(x: f64) -> f64 {
    // Lanczos' g = 7 with nine terms: 1e-15.
    const C: [f64; 9] = [
        0.999_999_999_999_809_9,
        676.520_368_121_885_1,
        -1_259.139_216_722_402_8,
        771.323_428_777_653_1,
        -176.615_029_162_140_6,
        12.507_343_278_686_905,
        -0.138_571_095_265_720_12,
        9.984_369_578_019_572e-6,
        1.505_632_735_149_311_6e-7,
    ];
    if x < 0.5 {
        let pi = std::f64::consts::PI;
        return math::ln(pi / math::sin(pi * x)) - ln_gamma(1.0 - x);
    }
    let x = x - 1.0;
    let t = x + 7.5;
    let sum = (1..9).fold(C[0], |s, i| s + C[i] / (x + i as f64));
    0.5 * math::ln(std::f64::consts::TAU) + (x + 0.5) * math::ln(t) - t + math::ln(sum)
}

/// P(k, x): probability that a gamma variable of shape k and scale 1 is below x.
fn below(k: f64, x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let front = math::exp(k * math::ln(x) - x - ln_gamma(k));
    if x < k + 1.0 {
        let (mut term, mut sum, mut n) = (1.0 / k, 1.0 / k, k);
        while term > 1e-14 * sum {
            n += 1.0;
            term *= x / n;
            sum += term;
        }
        front * sum
    } else {
        // Lentz's evaluation of the continued fraction.
        let (mut b, mut c) = (x + 1.0 - k, 1e300);
        let mut d = 1.0 / b;
        let mut h = d;
        for i in 1..500 {
            let i = f64::from(i);
            let a = -i * (i - k);
            b += 2.0;
            d = 1.0 / (a * d + b);
            c = b + a / c;
            let step = c * d;
            h *= step;
            if (step - 1.0).abs() < 1e-14 {
                break;
            }
        }
        1.0 - front * h
    }
}

/// Shape from moments, and the Kolmogorov-Smirnov distance of the sample from that gamma distribution; sorts the
/// sample.
///
/// `None` for fewer than ten values, or if all values are equal.
pub(super) fn fit(sample: &mut [f64]) -> Option<(f64, f64)> {
    let n = sample.len() as f64;
    if sample.len() < 10 {
        return None;
    }
    let mean = sample.iter().sum::<f64>() / n;
    let variance = sample.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / n;
    if variance <= 0.0 {
        return None;
    }
    let shape = mean * mean / variance;
    sample.sort_unstable_by(f64::total_cmp);
    let distance = sample.iter().enumerate().map(|(i, v)| {
        let p = below(shape, v * shape / mean);
        (p - i as f64 / n)
            .abs()
            .max((p - (i as f64 + 1.0) / n).abs())
    });
    Some((shape, distance.fold(0.0, f64::max)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::seeds::Stream;

    #[test]
    fn incomplete_gamma_has_its_values() {
        // k = 1: 1 − e^(−x); k = 2: 1 − (1 + x)e^(−x); k = ½: erf √x.
        for x in [0.1, 0.9, 1.5, 2.5, 8.0] {
            assert!((below(1.0, x) - (1.0 - math::exp(-x))).abs() < 1e-12);
            assert!((below(2.0, x) - (1.0 - (1.0 + x) * math::exp(-x))).abs() < 1e-12);
            assert!((below(0.5, x) - math::erf(x.sqrt())).abs() < 1e-12);
        }
    }

    #[test]
    fn exponential_sample_has_shape_one() {
        let mut r = Stream::new(1, "test", "gamma");
        let mut sample: Vec<f64> = (0..20_000).map(|_| r.exponential(3.0)).collect();
        let (shape, distance) = fit(&mut sample).unwrap();
        // Shape = mean²/variance: standard error √(8/n)·… below 3 %; distance beyond 1.95/√n once in a thousand.
        assert!((shape - 1.0).abs() < 0.09, "{shape}");
        assert!(distance < 0.0138 + 0.01, "{distance}");
        let mut even: Vec<f64> = (0..1000).map(f64::from).collect();
        assert!(fit(&mut even).unwrap().1 > 0.05);
        assert!(fit(&mut [1.0; 20]).is_none());
    }
}
