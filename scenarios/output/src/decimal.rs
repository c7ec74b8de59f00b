//! Numbers with a fixed number of decimals, written quickly: tables and figures have millions of them.

use std::fmt::Write as _;

/// Powers of ten by number of decimals.
const TENS: [f64; 7] = [1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6];
/// Below this the scaled number is exact to a thousandth, so only ties need the long way.
const SMALL: f64 = 1e12;
/// What scaling may have changed, of a number below [`SMALL`].
const UNSURE: f64 = 1e-3;

/// Adds what `{v:.places$}` would add.
pub(crate) fn push_decimal(out: &mut String, v: f64, places: usize) {
    let scaled = TENS.get(places).map_or(f64::NAN, |ten| v.abs() * ten);
    let whole = scaled.floor();
    let rest = scaled - whole;
    // Also for NaN.
    if !(scaled < SMALL && (rest - 0.5).abs() > UNSURE) {
        write!(out, "{v:.places$}").expect("writing to a String succeeds");
        return;
    }
    let mut n = whole as u64 + u64::from(rest > 0.5);
    // From the last digit to the first: 13 digits, a point and zeros before it at most.
    let mut digits = [0_u8; 24];
    let mut at = digits.len();
    let mut written = 0;
    while n > 0 || written <= places {
        if places > 0 && written == places {
            at -= 1;
            digits[at] = b'.';
        }
        at -= 1;
        digits[at] = b'0' + (n % 10) as u8;
        n /= 10;
        written += 1;
    }
    if v.is_sign_negative() {
        out.push('-');
    }
    out.extend(digits[at..].iter().map(|d| char::from(*d)));
}

#[cfg(test)]
mod tests {
    use super::*;
    use world::seeds::Stream;

    #[test]
    fn it_writes_what_the_standard_library_writes() {
        let mut rng = Stream::new(1, "test", "decimals");
        let odd =
            [0.0, -0.0, 0.5, 1.5, -2.5, 0.05, 0.000_499_9, 999.9996, -1e-9, 1e15, -3e300, f64::NAN, f64::INFINITY];
        let drawn = (0..20_000).map(|n| rng.normal() * 10_f64.powi(n % 14 - 6));
        let ties = (0..4000).map(|n| f64::from(n) / 2000.0);
        for v in odd.into_iter().chain(drawn).chain(ties) {
            for places in 0..9 {
                let mut text = String::new();
                push_decimal(&mut text, v, places);
                assert_eq!(text, format!("{v:.places$}"), "{v:e}, {places} places");
            }
        }
    }
}
