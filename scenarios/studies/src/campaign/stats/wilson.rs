//! Interval of a share from counts.
//!
//! *Source*: Wilson, J. Am. Stat. Assoc. 22 (1927) 209-212; recommended for all n by Brown, Cai & DasGupta,
//! Stat. Sci. 16 (2001) 101-133, eq. (4).
//! *Parameters*: z, [`Z95`] = 1.96, two-sided 95 %.
//! *Deviations*: none; no correction for continuity. Without trials nothing is known: 0 to 1.
//! *Written here*: crates of statistics (statrs) have no interval of a share.

use super::Interval;

/// 97.5 % quantile of the standard normal.
pub const Z95: f64 = 1.959_963_984_540_054;

/// 95 % score interval of the true share, given `successes` of `n`.
pub fn wilson(successes: u64, n: u64) -> Interval {
    assert!(successes <= n, "{successes} successes of {n} trials: count again");
    if n == 0 {
        return Interval { low: 0.0, high: 1.0 };
    }
    let (k, n_f, z2) = (successes as f64, n as f64, Z95 * Z95);
    let p = k / n_f;
    let centre = (k + z2 / 2.0) / (n_f + z2);
    let half = Z95 * (n_f * p * (1.0 - p) + z2 / 4.0).sqrt() / (n_f + z2);
    // At the ends the formula gives 0 and 1 up to rounding.
    Interval {
        low: if successes == 0 { 0.0 } else { centre - half },
        high: if successes == n { 1.0 } else { centre + half },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Newcombe, Stat. Med. 17 (1998) 857-872, Table I, method 3: 81/263, 15/148, 0/20, 1/29; the others by hand.
    #[test]
    fn gives_the_published_intervals() {
        for (k, n, low, high) in [
            (81, 263, 0.2553, 0.3662),
            (15, 148, 0.0624, 0.1605),
            (0, 20, 0.0, 0.1611),
            (1, 29, 0.0061, 0.1718),
            (7, 8, 0.5291, 0.9776),
            (35, 43, 0.6737, 0.9028),
            (1, 1, 0.2065, 1.0),
        ] {
            let got = wilson(k, n);
            let close = (got.low - low).abs() < 5e-4 && (got.high - high).abs() < 5e-4;
            assert!(close, "{k} of {n}: {got:?} against {low} to {high}");
        }
        // Ends stay ends, and when nothing is known everything is possible.
        assert_eq!(wilson(0, 0), Interval { low: 0.0, high: 1.0 });
        assert_eq!((wilson(0, 7).low, wilson(7, 7).high), (0.0, 1.0));
    }

    #[test]
    fn failures_mirror_successes() {
        for k in 0..=11 {
            let (a, b) = (wilson(k, 11), wilson(11 - k, 11));
            assert!((a.low - (1.0 - b.high)).abs() < 1e-15, "{a:?} {b:?}");
        }
    }
}
